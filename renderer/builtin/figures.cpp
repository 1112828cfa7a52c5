#include "base/parallel.h"
#include "renderer/builtin/masonry.h"
#include "renderer/builtin/people.h"
#include "renderer/builtin/scenes.h"
#include "renderer/builtin/textures.h"

#include <array>
#include <utility>

namespace obscura::builtin {

namespace {

Shape plinth() {
    const float half = 0.65F; // its depth
    Outline outline{{0.25F, 0}, {0.25F, 0.11F}, {0.24F, 0.12F}, {0.05F, 0.12F}, {0.05F, 0.16F}};
    addArc(outline, {0.05F, 0.19F}, 0.03F, -90, 60, 4);
    outline.insert(outline.end(), {{0, 0.23F}, {0, 0.29F}, {-0.01F, 0.30F}, {-half, 0.30F}});
    return pillar(outline, {2.0F, 2 * half});
}

// A blind arcade behind the figures, so that their heads stand before stone and not sky.
void addWall(Shape& ashlarWork, Shape& limestoneWork) {
    const ArchedWall wall{1.6F, 0.58F, 1.75F, 3.1F, 0.3F, 0};
    const Shape ring = voussoirs(wall, 11, 0.2F), post = pier({0.30F, 0.2F}, wall.springing);
    for (int i = -2; i <= 2; ++i) {
        const glm::mat4 place = at({wall.bay * part(i, 1), 0, -1.75F});
        ashlarWork.add(archedWall(wall), place);
        limestoneWork.add(ring, place);
        limestoneWork.add(post, place * at({wall.bay / 2, 0, 0.12F}));
    }
    ashlarWork.add(box({8, 3.1F, 0.1F}, 0.01F), at({0, 1.55F, -1.92F}));
    limestoneWork.add(cornice({5, 1.6F}, 0.22F, 0.3F), at({0, 3.0F, 0}));
    projectUv(ashlarWork);
}

void addSurroundings(Scene& scene) {
    Shape ashlarWork, limestoneWork = plinth();
    addWall(ashlarWork, limestoneWork);
    Shape floor = patch([](glm::vec2 uv) { return glm::vec3(10 * uv.x - 5, 0, 6 - 8 * uv.y); }, 16,
                        16, {1, 1});
    projectUv(floor);
    addMesh(scene, limestoneWork,
            addMaterial(scene, {.name = "limestone", .roughness = 0.8F}, {512, 1.5F}, limestone()),
            1.5F);
    addMesh(scene, ashlarWork, addMaterial(scene, {.name = "ashlar"}, {1024, 4}, ashlar()), 4);
    addMesh(scene, floor,
            addMaterial(scene, {.name = "flagstones"}, {1024, 4, true, true}, flagstones()), 4);
}

void addFigure(Scene& scene, const char* name, Figure figure, const glm::mat4& place) {
    Material material{.name = name};
    material.baseColourTexture.texture = addColourTexture(scene, std::move(figure.colours));
    material.roughness = 0.75F;
    scene.materials.push_back(material);
    Shape placed;
    placed.add(figure.shape, place);
    addMesh(scene, placed, static_cast<int>(scene.materials.size()) - 1);
}

} // namespace

Scene figures() {
    const std::array<Body, 2> bodies{reader(), guard()};
    std::array<Figure, 2> models;
    forEachInParallel(bodies.size(), [&](std::size_t i) { models[i] = modelled(bodies[i]); });
    Scene scene;
    addSurroundings(scene);
    addFigure(scene, "reader", std::move(models[0]), at({-0.46F, 0.30F, 0.0F}, 16));
    addFigure(scene, "guard", std::move(models[1]), at({0.46F, 0.30F, -0.02F}, -12));
    return scene;
}

} // namespace obscura::builtin
