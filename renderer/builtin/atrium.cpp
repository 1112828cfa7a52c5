#include "renderer/builtin/furnishings.h"
#include "renderer/builtin/masonry.h"
#include "renderer/builtin/scenes.h"
#include "renderer/builtin/textures.h"

#include <array>
#include <vector>

namespace obscura::builtin {

namespace {

// The plan, in metres. The court's long sides run along x; half sizes are (x, z).
constexpr glm::vec2 court{9, 4.5F};      // the lines on which the columns stand
constexpr glm::vec2 outer{12, 7.5F};     // the inner faces of the outer walls
constexpr float bay = 3, passage = 2.7F; // between columns; from the arcade's back to the wall
constexpr float arcade = 0.6F;           // thickness of the lower arcade; its middle is on `court`
constexpr float courtFloor = -0.45F, galleryFloor = 4.7F, wallTop = 8.6F;
constexpr float tread = 0.32F; // of the three steps down to the court
constexpr float rail = 0.95F;  // height of the balustrade

const ArchedWall lowerArch{bay, 1.2F, 3.1F, galleryFloor, arcade, 3.1F};
const ArchedWall upperArch{bay / 2, 0.56F, galleryFloor + 2.75F,
                           wallTop, 0.4F,  galleryFloor + 2.75F};
const ArchedWall lowerNiche{bay, 0.85F, 1.75F, 4.5F, 0.3F, 0};
const ArchedWall upperNiche{bay, 0.7F, 1.7F, wallTop - galleryFloor, 0.2F, 0};

// One shape for each material.
struct Works {
    Shape ashlar, limestone, plaster, fresco, flagstones, marble, timber, crimson, blue, terracotta,
        turquoise, water, palms;
};

// Places along the four sides of a rectangle, `first` steps from each side's beginning; there, -z
// leads out of the court and x along its side.
std::vector<glm::mat4> around(glm::vec2 half, float spacing, float first) {
    std::vector<glm::mat4> places;
    for (int side = 0; side < 4; ++side) {
        const float along = side % 2 == 0 ? half.x : half.y;
        const float away = side % 2 == 0 ? half.y : half.x;
        for (float x = -along + first * spacing; x < along + 0.01F - first * spacing; x += spacing)
            places.push_back(at({0, 0, 0}, 90 * part(side, 1)) * at({x, 0, -away}));
    }
    return places;
}
std::vector<glm::mat4> bays(glm::vec2 half, float width) { return around(half, width, 0.5F); }
std::vector<glm::mat4> columnsOf(glm::vec2 half, float spacing) { return around(half, spacing, 1); }
// As columnsOf(), with the corners, once for each of the two sides that meet there.
std::vector<glm::mat4> linesOf(glm::vec2 half, float spacing) { return around(half, spacing, 0); }

constexpr std::array<glm::vec2, 4> corners{glm::vec2(1, 1), {1, -1}, {-1, 1}, {-1, -1}};
glm::vec3 inCorner(glm::vec2 half, glm::vec2 signs, float y) {
    return {half.x * signs.x, y, half.y * signs.y};
}

void addArcade(Works& works) {
    const Shape wall = archedWall(lowerArch), ring = voussoirs(lowerArch, 15, 0.34F);
    for (const glm::mat4& place : bays(court, bay)) {
        works.ashlar.add(wall, place);
        works.limestone.add(ring, place);
    }
    const Shape column = grandColumn(0.25F, lowerArch.springing);
    for (const glm::mat4& place : columnsOf(court, bay))
        works.limestone.add(column, place);
    for (const glm::vec2 signs : corners)
        works.limestone.add(pier({0.84F, 0.84F}, lowerArch.springing),
                            at(inCorner(court, signs, 0)));
    for (const glm::vec2 signs : corners)
        works.ashlar.add(box({0.76F, galleryFloor - 3.1F, 0.76F}, 0.01F),
                         at(inCorner(court, signs, (galleryFloor + 3.1F) / 2)));
}

void addPassage(Works& works) {
    const glm::mat4 middle = at({0, lowerArch.springing, -(arcade + passage) / 2});
    const Shape vault = groinVault({bay / 2, passage / 2}, 1.3F);
    for (const glm::mat4& place : bays(court, bay))
        works.plaster.add(vault, place * middle);
    for (const glm::vec2 signs : corners)
        works.plaster.add(groinVault({1.4F, 1.4F}, 1.3F),
                          at(inCorner(outer - 1.4F, signs, lowerArch.springing)));
    const Shape ribs = rib(passage / 2, 1.3F, 0.5F);
    const Shape pilaster = pier({0.5F, 0.3F}, lowerArch.springing);
    for (const glm::mat4& place : linesOf(court, bay)) {
        works.limestone.add(ribs, place * middle);
        works.limestone.add(pilaster, place * at({0, 0, -passage - arcade / 2}));
    }
}

// The wall behind the passage, with a niche or a door in each bay.
void addOuterWall(Works& works) {
    Shape wall = archedWall(lowerNiche);
    wall.add(
        patch([](glm::vec2 uv) { return glm::vec3(1.8F * (uv.x - 0.5F), 2.7F * uv.y, -0.15F); }, 1,
              1, {1, 1}));
    for (Vertex& vertex : wall.vertices) // the painter's bay is 3 m x 4.5 m
        vertex.uv = {vertex.position.x + vertex.position.z + 1.65F,
                     (4.5F - vertex.position.y) / 1.5F};
    const Shape ring = voussoirs(lowerNiche, 13, 0.2F);
    const Shape leaf = door(lowerNiche.radius, lowerNiche.springing);
    const glm::mat4 inwards = at({0, 0, -lowerNiche.thickness / 2});
    int index = 0;
    for (const glm::mat4& place : bays(outer, bay)) {
        works.fresco.add(wall, place * inwards);
        works.limestone.add(ring, place * inwards);
        const bool isDoor = index % 13 == 3 || index % 13 == 10;
        if (isDoor)
            works.timber.add(leaf, place * at({0, 0, -0.22F}));
        ++index;
    }
    works.limestone.add(
        innerMoulding({{0.05F, 0}, {0.05F, 0.14F}, {0.02F, 0.18F}, {0, 0.18F}}, outer));
}

Shape floorBetween(glm::vec2 low, glm::vec2 high, float y) {
    Shape shape = patch(
        [=](glm::vec2 uv) {
            const glm::vec2 p = glm::mix(low, high, glm::vec2(uv.x, 1 - uv.y));
            return glm::vec3(p.x, y, p.y);
        },
        8, 8, {1, 1});
    projectUv(shape);
    return shape;
}

// Four strips round the court, from its half size `inner` to the outer walls.
Shape ringFloor(glm::vec2 inner, float y) {
    const glm::vec2 end = outer + lowerNiche.thickness; // the niches have a floor too
    Shape shape = floorBetween({-end.x, inner.y}, end, y);
    shape.add(floorBetween(-end, {end.x, -inner.y}, y));
    shape.add(floorBetween({-end.x, -inner.y}, {-inner.x, inner.y}, y));
    shape.add(floorBetween({inner.x, -inner.y}, {end.x, inner.y}, y));
    return shape;
}

void addFloors(Works& works) {
    const glm::vec2 edge = court - 0.5F;
    Outline steps;
    for (int i = 3; i > 0; --i) {
        const float x = part(i, 1) * tread, y = -0.15F * part(i, 1);
        steps.insert(steps.end(), {{x, y}, {x, y + 0.11F}, {x + 0.015F, y + 0.12F}});
        addArc(steps, {x + 0.015F, y + 0.135F}, 0.015F, -60, 90, 4); // the nosing
    }
    steps.push_back({tread - 1, 0}); // as far as the passage's floor
    for (glm::vec2& point : steps)
        point.x -= tread;
    works.limestone.add(innerMoulding(steps, edge));
    works.flagstones.add(floorBetween(-edge + 2 * tread, edge - 2 * tread, courtFloor));
    works.marble.add(ringFloor(court + 0.5F, 0));
    works.flagstones.add(ringFloor(court - 0.35F, galleryFloor));
}

void addGallery(Works& works) {
    const Shape wall = archedWall(upperArch), ring = voussoirs(upperArch, 11, 0.18F);
    for (const glm::mat4& place : bays(court, bay / 2)) {
        works.ashlar.add(wall, place);
        works.limestone.add(ring, place);
    }
    const Shape base = pedestal(0.36F, rail);
    const Shape column = plainColumn(0.125F, upperArch.springing - galleryFloor - rail);
    for (const glm::mat4& place : columnsOf(court, bay / 2)) {
        works.limestone.add(base, place * at({0, galleryFloor, 0}));
        works.limestone.add(column, place * at({0, galleryFloor + rail, 0}));
    }
    for (const glm::vec2 signs : corners)
        works.limestone.add(pier({0.5F, 0.5F}, wallTop - galleryFloor),
                            at(inCorner(court, signs, galleryFloor)));
}

void addBalustrade(Works& works) {
    const Shape post = baluster(rail - 0.22F);
    const Shape foot = box({bay / 2 - 0.3F, 0.1F, 0.24F}, 0.012F);
    const Shape hand = box({bay / 2 - 0.3F, 0.12F, 0.26F}, 0.03F);
    for (const glm::mat4& place : bays(court, bay / 2)) {
        for (int i = 0; i < 4; ++i)
            works.limestone.add(post,
                                place * at({0.27F * (part(i, 1) - 1.5F), galleryFloor + 0.1F, 0}));
        works.limestone.add(foot, place * at({0, galleryFloor + 0.05F, 0}));
        works.limestone.add(hand, place * at({0, galleryFloor + rail - 0.06F, 0}));
    }
}

void addCornices(Works& works) {
    const glm::vec2 lower = court - arcade / 2, upper = court - upperArch.thickness / 2;
    works.limestone.add(cornice(lower, 0.20F, 0.3F), at({0, galleryFloor - 0.26F, 0}));
    works.limestone.add(dentils(lower, {0.09F, 0.09F, 0.08F}, 0.17F),
                        at({0, galleryFloor - 0.26F, 0}));
    works.limestone.add(cornice(upper, 0.5F, 0.42F), at({0, wallTop - 0.02F, 0}));
    works.limestone.add(dentils(upper, {0.16F, 0.16F, 0.28F}, 0.42F), at({0, wallTop + 0.12F, 0}));
}

void addUpperRoom(Works& works) {
    Shape wall = archedWall(upperNiche);
    wall.add(patch([](glm::vec2 uv) { return glm::vec3(1.5F * (uv.x - 0.5F), 2.5F * uv.y, -0.1F); },
                   1, 1, {1, 1}));
    projectUv(wall);
    const Shape ring = voussoirs(upperNiche, 11, 0.18F);
    for (const glm::mat4& bayPlace : bays(outer, bay)) {
        const glm::mat4 place = bayPlace * at({0, galleryFloor, -upperNiche.thickness / 2});
        works.plaster.add(wall, place);
        works.limestone.add(ring, place);
    }
    const Shape beam = box({0.14F, 0.2F, passage + arcade}, 0.012F);
    for (const glm::mat4& place : bays(court, bay / 4))
        works.timber.add(beam, place * at({0, wallTop - 0.1F, -(passage + arcade) / 2}));
    for (const float side : {-1.0F, 1.0F}) {
        const glm::vec2 strip(2 * outer.x + 1, outer.y - court.y + 0.3F);
        const float away = (outer.y + court.y + 0.1F) / 2;
        works.timber.add(box({strip.x, 0.4F, strip.y}, 0.01F),
                         at({0, wallTop + 0.2F, side * away}));
        works.timber.add(box({outer.x - court.x + 0.3F, 0.4F, 2 * court.y}, 0.01F),
                         at({side * (outer.x + court.x + 0.1F) / 2, wallTop + 0.2F, 0}));
    }
}

void addCloth(Works& works) {
    const float width = 2 * lowerArch.radius + 0.1F, height = lowerArch.springing - 0.16F;
    const Shape curtain = curtains(width, height - 0.06F);
    const Shape rod = lathe({{0.018F, -width / 2}, {0.018F, width / 2}}, 10);
    const glm::mat4 across = glm::mat4(glm::mat3(glm::vec3(0, 1, 0), {-1, 0, 0}, {0, 0, 1}));
    int index = 0;
    for (const glm::mat4& place : bays(court, bay)) {
        if (index % 3 == 0) {
            (index % 2 == 0 ? works.crimson : works.blue)
                .add(curtain, place * at({0, 0.04F, -0.05F}));
            works.timber.add(rod, place * at({0, height, -0.05F}) * across);
        }
        if (index % 3 == 1)
            (index % 2 == 0 ? works.crimson : works.blue)
                .add(banner(1.0F, 0.6F, 2.4F, {0.60F, 0.80F}),
                     place * at({0.75F, galleryFloor + rail + 0.01F, 0}));
        ++index;
    }
}

void addVessels(Works& works) {
    const Shape big = urn(0.85F), plant = palm(17, 1.25F), jar = amphora(1.15F);
    for (const glm::vec2 signs : corners) {
        const glm::mat4 place = at(inCorner(court - 1.75F, signs, courtFloor));
        works.limestone.add(pedestal(0.8F, 0.45F), place);
        works.terracotta.add(big, place * at({0, 0.45F, 0}));
        works.palms.add(plant, place * at({0, 0.45F + 0.68F, 0}, 40 * signs.x + 25 * signs.y));
    }
    int index = 0;
    for (const glm::mat4& place : bays(outer, bay)) {
        if (index % 3 == 1)
            works.turquoise.add(jar, place * at({0, 0, 0.1F}, 35 * part(index, 1)));
        ++index;
    }
    const Fountain middle = fountain(1.35F);
    works.limestone.add(middle.stone, at({0, courtFloor, 0}));
    works.water.add(middle.water, at({0, courtFloor, 0}));
}

int plain(Scene& scene, const char* name, glm::vec3 colour, float roughness) {
    Material material;
    material.name = name;
    material.baseColour = glm::vec4(colour, 1);
    material.roughness = roughness;
    scene.materials.push_back(material);
    return static_cast<int>(scene.materials.size()) - 1;
}

void furnishAtrium(Scene& scene, const Works& works) {
    const auto add = [&](const Shape& shape, Material material, const Canvas& canvas,
                         const Painter& painter, float metres) {
        addMesh(scene, shape, addMaterial(scene, std::move(material), canvas, painter), metres);
    };
    add(works.ashlar, {.name = "ashlar"}, {1024, 4}, ashlar(), 4);
    add(works.limestone, {.name = "limestone", .roughness = 0.8F}, {512, 1.5F}, limestone(), 1.5F);
    add(works.plaster, {.name = "plaster"}, {512, 3}, plaster(), 3);
    add(works.fresco, {.name = "fresco"}, {1024, 3}, fresco(), 3);
    add(works.flagstones, {.name = "flagstones"}, {1024, 4, true, true}, flagstones(), 4);
    add(works.marble, {.name = "marble"}, {1024, 3, true, true}, marbleFloor(), 3);
    add(works.timber, {.name = "timber", .roughness = 0.7F}, {512, 2}, timber(), 2);
    add(works.crimson, {.name = "crimson", .doubleSided = true}, {512, 1},
        cloth({0.55F, 0.10F, 0.09F}, {0.83F, 0.62F, 0.25F}), 1);
    add(works.blue, {.name = "blue", .doubleSided = true}, {512, 1},
        cloth({0.13F, 0.27F, 0.45F}, {0.86F, 0.75F, 0.48F}), 1);
    add(works.terracotta, {.name = "terracotta"}, {512, 1, true, true},
        glaze({0.68F, 0.38F, 0.24F}), 1);
    add(works.turquoise, {.name = "turquoise"}, {512, 1, true, true}, glaze({0.16F, 0.48F, 0.47F}),
        1);
    add(works.palms, {.name = "palm", .alphaCutoff = 0.5F, .doubleSided = true}, {512, 0.25F},
        frond(), 1);
    addMesh(scene, works.water, plain(scene, "water", {0.03F, 0.09F, 0.09F}, 0.15F));
}

} // namespace

Scene atrium() {
    Works works;
    addFloors(works);
    addArcade(works);
    addPassage(works);
    addOuterWall(works);
    addGallery(works);
    addBalustrade(works);
    addCornices(works);
    addUpperRoom(works);
    addCloth(works);
    addVessels(works);
    projectUv(works.ashlar);
    Scene scene;
    furnishAtrium(scene, works);
    return scene;
}

} // namespace obscura::builtin
