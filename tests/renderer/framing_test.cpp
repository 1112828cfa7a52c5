// What a view must show, on scenes that are hard to show. Nothing here needs OpenGL.
#include "protocols/reader/study_text.h"
#include "renderer/extent.h"
#include "renderer/found_cameras.h"
#include "renderer/framing.h"
#include "renderer/reference/sight.h"
#include "renderer/scene/quads.h"
#include "tests/error_of.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace obscura {
namespace {

using glm::vec3;
using testing::HasSubstr;

Framing framed(const Scene& scene, std::uint64_t seed = 1, double aspect = 16.0 / 9) {
    return framing(scene, RayTracer(scene), seed, aspect);
}

void place(Scene& scene, float scale, vec3 offset = vec3(0)) {
    for (Vertex& vertex : scene.vertices)
        vertex.position = vertex.position * scale + offset;
}

// Where the picture's borders are at -1 and 1; nothing for what is nearer than the near plane.
std::vector<glm::vec2> inPicture(const Scene& scene, std::size_t vertices, const Camera& camera,
                                 double aspect = 16.0 / 9) {
    const Frame frame =
        makeFrame(camera, static_cast<int>(std::lround(900 * aspect)), 900, scene.bounds(), 1);
    std::vector<glm::vec2> result;
    for (std::size_t i = 0; i < vertices; ++i) {
        const glm::vec4 clip =
            frame.clipFromView * (frame.viewFromWorld * glm::vec4(scene.vertices[i].position, 1));
        if (clip.w > frame.depth.x)
            result.push_back(glm::vec2(clip) / clip.w);
    }
    return result;
}

// The first `vertices` of a scene are all in the picture, and fill it to a good part.
void expectWhole(const Scene& scene, std::size_t vertices, const Camera& camera,
                 double aspect = 16.0 / 9, double share = 0.7) {
    const std::vector<glm::vec2> at = inPicture(scene, vertices, camera, aspect);
    ASSERT_EQ(at.size(), vertices) << "something is nearer than the near plane";
    glm::vec2 low(2), high(-2);
    for (const glm::vec2& point : at) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    EXPECT_GT(std::min(low.x, low.y), -1);
    EXPECT_LT(std::max(high.x, high.y), 1);
    EXPECT_GT(std::max(high.x - low.x, high.y - low.y), 2 * share);
}

// Looks once more with hardly any near plane, and finer.
void expectNothingCut(const Scene& scene, const Framing& found) {
    Camera camera = found.camera;
    camera.near = 1e-7;
    const Surfaces surfaces = Sight(scene).surfaces(camera, 192, 108);
    for (std::size_t i = 0; i < surfaces.depth.size(); ++i)
        ASSERT_GT(static_cast<double>(surfaces.depth[i]), found.near);
}

double shown(const Scene& scene, const Camera& camera) {
    const Surfaces surfaces = Sight(scene).surfaces(camera, 48, 27);
    double count = 0;
    for (std::size_t i = 0; i < surfaces.depth.size(); ++i)
        count += !surfaces.empty(i);
    return count / static_cast<double>(surfaces.depth.size());
}

double occlusion(const Scene& scene, const Framing& found) {
    const Surfaces surfaces = Sight(scene).surfaces(found.camera, 48, 27);
    TraceSettings settings;
    settings.radius = found.radius;
    settings.rays = 32;
    const Image visibility = RayTracer(scene).trace(surfaces, settings).visibility;
    double sum = 0, count = 0;
    for (int y = 0; y < 27; ++y)
        for (int x = 0; x < 48; ++x)
            if (!surfaces.empty(surfaces.index(x, 26 - y))) {
                sum += 1 - static_cast<double>(visibility.at(x, y, 0));
                ++count;
            }
    return sum / count;
}

// Three boxes on top of each other, turned faces and all: something that casts occlusion, 2 m high.
Scene tower() {
    Scene scene;
    addBox(scene, vec3(-1, 0, -0.6), vec3(1, 0.5, 0.6));
    addBox(scene, vec3(-0.5, 0.5, -0.4), vec3(0.5, 1.3, 0.4));
    addBox(scene, vec3(-0.8, 1.3, -0.5), vec3(0.8, 2, 0.5));
    return scene;
}

// A box seen from inside.
void addRoom(Scene& scene, vec3 low, vec3 high) {
    const std::size_t first = scene.indices.size();
    addBox(scene, low, high);
    for (std::size_t i = first; i < scene.indices.size(); i += 3)
        std::swap(scene.indices[i], scene.indices[i + 1]);
    for (std::size_t i = scene.vertices.size() - 24; i < scene.vertices.size(); ++i)
        scene.vertices[i].normal *= -1.0f;
}

Scene furnishedRoom() {
    Scene scene;
    addRoom(scene, vec3(-4, 0, -3), vec3(4, 3, 3));
    addBox(scene, vec3(-3.5f, 0, -2.5f), vec3(-2, 0.8f, -1));
    addBox(scene, vec3(1, 0, -2.8f), vec3(3, 2, -2.2f));
    addBox(scene, vec3(2.5f, 0, 1), vec3(3.5f, 0.5f, 2));
    return scene;
}

void addBall(Scene& scene, float radius, int around) {
    const auto at = [&](int i, int j) {
        const double turn = 2 * std::numbers::pi * i / around,
                     polar = std::numbers::pi * j / (around / 2);
        return radius * vec3(std::sin(polar) * std::sin(turn), std::cos(polar),
                             std::sin(polar) * std::cos(turn));
    };
    for (int j = 0; j < around / 2; ++j)
        for (int i = 0; i < around; ++i)
            addQuad(scene, {at(i, j + 1), at(i + 1, j + 1), at(i + 1, j), at(i, j)});
}

// What is seen from outside is seen whole, at any size and anywhere; and the view is the same, as
// far as floats tell kilometres from their thousandths.
TEST(Framing, ShowsTheWholeOfAnObject) {
    const Framing metres = framed(tower());
    EXPECT_FALSE(metres.inside);
    const std::pair<float, vec3> cases[] = {{1, vec3(0)},           {0.0005f, vec3(0)},
                                            {5000, vec3(0)},        {1, vec3(3000, -500, 7000)},
                                            {1, vec3(0, 10000, 0)}, {0.0005f, vec3(2, 1, 0)}};
    for (const auto& [scale, offset] : cases) {
        Scene scene = tower();
        place(scene, scale, offset);
        const Framing found = framed(scene);
        SCOPED_TRACE(found.why);
        expectWhole(scene, scene.vertices.size(), found.camera);
        expectNothingCut(scene, found);
        EXPECT_FALSE(found.inside);
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR((found.camera.position[static_cast<std::size_t>(axis)] -
                         static_cast<double>(offset[axis])) /
                            static_cast<double>(scale),
                        metres.camera.position[static_cast<std::size_t>(axis)], 0.02);
        EXPECT_GT(found.camera.position[1], static_cast<double>(scene.bounds().low.y));
        if (scale >= 1) {
            EXPECT_GT(occlusion(scene, found), 0.02);
            EXPECT_LT(occlusion(scene, found), 0.5);
        }
    }
}

// Wider or narrower than usual, it is still all there.
TEST(Framing, FollowsThePicturesShape) {
    for (const double aspect : {0.5, 1.0, 3.0})
        expectWhole(tower(), tower().vertices.size(), framed(tower(), 1, aspect).camera, aspect);
}

// Or narrower than it was framed for.
TEST(Framing, StepsBackForANarrowerPicture) {
    const Framing found = framed(tower());
    for (const double aspect : {1.2, 0.5})
        expectWhole(tower(), tower().vertices.size(), fitted(found, aspect), aspect, 0.5);
    EXPECT_EQ(fitted(found, 2).position, found.camera.position);
    const Framing room = framed(furnishedRoom());
    EXPECT_EQ(fitted(room, 0.5).position, room.camera.position);
}

// From the front, where both sides show as much.
TEST(Framing, PrefersTheFront) { EXPECT_GT(framed(tower()).camera.position[2], 0.5); }

TEST(Framing, LooksAtWhatStandsOnAHugeFloor) {
    for (const float reach : {20.0f, 5000.0f}) {
        Scene scene = tower();
        addQuad(scene, {vec3(-reach, 0, reach), vec3(reach, 0, reach), vec3(reach, 0, -reach),
                        vec3(-reach, 0, -reach)});
        const Framing found = framed(scene);
        SCOPED_TRACE(found.why);
        expectWhole(scene, tower().vertices.size(), found.camera);
        expectNothingCut(scene, found);
        EXPECT_GT(found.camera.position[1], 0);
        EXPECT_THAT(found.why, HasSubstr("such as a floor"));
        const double dark = occlusion(scene, found);
        EXPECT_GT(dark, 0.02);
        EXPECT_LT(dark, 0.5);
    }
}

// A stage of a few large boxes, with one thing on it that somebody has modelled.
TEST(Framing, LooksAtWhereTheDetailIs) {
    Scene scene;
    addBall(scene, 0.5f, 64);
    const std::size_t ball = scene.vertices.size();
    for (int i = 0; i < 6; ++i) {
        addBox(scene, vec3(2 * i - 6, -0.7f, -4), vec3(2 * i - 4, -0.5f, 4));
        addBox(scene, vec3(2 * i - 6, -0.5f, -4), vec3(2 * i - 5.5f, 3, -3.5f));
    }
    const Framing found = framed(scene);
    SCOPED_TRACE(found.why);
    expectWhole(scene, ball, found.camera);
    expectNothingCut(scene, found);
}

TEST(Framing, LooksAtWhatIsUnderTheDomeOfASky) {
    Scene scene = tower();
    const std::size_t first = scene.indices.size();
    addBall(scene, 200, 32);
    for (std::size_t i = first; i < scene.indices.size(); i += 3)
        std::swap(scene.indices[i], scene.indices[i + 1]);
    const Framing found = framed(scene);
    SCOPED_TRACE(found.why);
    expectWhole(scene, tower().vertices.size(), found.camera);
}

// Of a thousandth of the area, a kilometre away.
TEST(Framing, IsNotMisledByCrumbsFarAway) {
    Scene scene = tower();
    addBox(scene, vec3(1000, 300, -2000), vec3(1000.02f, 300.02f, -1999.98f));
    addBox(scene, vec3(-600, 0, 800), vec3(-599.98f, 0.02f, 800.02f));
    const Framing found = framed(scene);
    SCOPED_TRACE(found.why);
    expectWhole(scene, tower().vertices.size(), found.camera);
    EXPECT_THAT(found.why, HasSubstr("far from everything else was left out"));
}

// But a mast is no crumb: it goes on from the rest.
TEST(Framing, KeepsWhatIsThinAndLong) {
    Scene scene = tower();
    for (int i = 0; i < 40; ++i)
        addBox(scene, vec3(0, 2 + 0.5 * i, 0), vec3(0.01f, 2.5 + 0.5 * i, 0.01f));
    expectWhole(scene, scene.vertices.size(), framed(scene).camera);
}

TEST(Framing, StandsInARoom) {
    for (const vec3& offset : {vec3(0), vec3(4000, 200, -6000)})
        for (const float scale : {1.0f, 0.0002f, 1000.0f}) {
            Scene scene = furnishedRoom();
            place(scene, scale, offset * (scale < 1 ? 0.0f : 1.0f));
            const Framing found = framed(scene);
            SCOPED_TRACE(found.why);
            EXPECT_TRUE(found.inside);
            EXPECT_GT(shown(scene, found.camera), 0.99);
            expectNothingCut(scene, found);
            const double above =
                found.camera.position[1] - static_cast<double>(scene.bounds().low.y);
            EXPECT_GT(above, 0.1 * 3 * static_cast<double>(scale));
            EXPECT_LT(above, 0.95 * 3 * static_cast<double>(scale));
            if (scale == 1) {
                EXPECT_NEAR(above, 1.6, 0.05);
                EXPECT_GT(occlusion(scene, found), 0.05);
                EXPECT_LT(occlusion(scene, found), 0.5);
            }
        }
}

// One room of a house of four, whose outside shows more than any of them: the house. (Walls of one
// face each way.)
TEST(Framing, ShowsAHouseFromOutside) {
    Scene scene;
    addBox(scene, vec3(-6, 0, -5), vec3(6, 6, 5));
    for (const float x : {-1.0f, 1.0f})
        for (const float y : {0.1f, 3.1f})
            for (const float z : {-1.0f, 1.0f})
                addRoom(scene, vec3(std::min(0.1f * x, 5.9f * x), y, std::min(0.1f * z, 4.9f * z)),
                        vec3(std::max(0.1f * x, 5.9f * x), y + 2.8f, std::max(0.1f * z, 4.9f * z)));
    const Framing found = framed(scene);
    SCOPED_TRACE(found.why);
    EXPECT_FALSE(found.inside);
    expectWhole(scene, scene.vertices.size(), found.camera);
}

TEST(Framing, ShowsAnOpenCityFromAbove) {
    Scene scene;
    for (int x = 0; x < 10; ++x)
        for (int z = 0; z < 10; ++z)
            addBox(scene, vec3(30 * x, 0, 30 * z),
                   vec3(30 * x + 18, 10 + (7 * x + 3 * z) % 11 * 3, 30 * z + 18));
    addQuad(scene, {vec3(-10, 0, 300), vec3(300, 0, 300), vec3(300, 0, -10), vec3(-10, 0, -10)});
    const Framing found = framed(scene);
    SCOPED_TRACE(found.why);
    EXPECT_FALSE(found.inside);
    expectWhole(scene, scene.vertices.size(), found.camera);
    EXPECT_GT(found.camera.position[1], 50);
    expectNothingCut(scene, found);
}

// A shell is seen from outside, even where its inner side is drawn too.
TEST(Framing, ShowsAnEmptyShellFromOutside) {
    for (const bool doubleSided : {false, true}) {
        Scene scene;
        addBall(scene, 2, 32);
        scene.materials[0].doubleSided = doubleSided;
        const Framing found = framed(scene);
        SCOPED_TRACE(found.why);
        EXPECT_FALSE(found.inside);
        expectWhole(scene, scene.vertices.size(), found.camera);
    }
}

// Blades two millimetres wide: most rays pass, and what there is must be in the picture.
TEST(Framing, ShowsThinPlants) {
    Scene scene;
    for (int i = 0; i < 60; ++i) {
        const double turn = 2.4 * i;
        const vec3 foot(0.02 * std::sin(turn), 0, 0.02 * std::cos(turn)),
            tip = vec3(0.3 * std::sin(turn), 0.5 + 0.005 * i, 0.3 * std::cos(turn)),
            side = 0.001f * vec3(std::cos(turn), 0, -std::sin(turn));
        addQuad(scene, {foot - side, foot + side, tip + side, tip - side});
    }
    scene.materials[0].doubleSided = true;
    const Framing found = framed(scene);
    SCOPED_TRACE(found.why);
    expectWhole(scene, scene.vertices.size(), found.camera);
    expectNothingCut(scene, found);
    EXPECT_LT(found.radius, 0.25); // though next to nothing is occluded
}

TEST(Framing, PrefersACameraOfTheFilesThatShowsSomething) {
    Scene scene = furnishedRoom();
    Camera away, into;
    away.position = {0, 50, 0};
    away.target = {0, 51, 0.1};
    into.position = {-3.5, 2, 2.5};
    into.target = {-2.8, 1.8, 1.9};
    into.fovDegrees = 70;
    into.up = {0.21, 0.94, -0.18}; // not rolled
    scene.cameras = {{"lost", away}, {"corner", into}};
    const Framing found = framed(scene);
    EXPECT_EQ(found.camera.position, into.position);
    EXPECT_EQ(found.camera.fovDegrees, 70);
    EXPECT_EQ(found.camera.up, (Vec3{0, 1, 0}));
    EXPECT_TRUE(found.inside);
    EXPECT_THAT(found.why, HasSubstr("the file's own, \"corner\""));
    scene.cameras[1].camera.up = {0.3, 0.9, 0.3};
    EXPECT_EQ(framed(scene).camera.up, (Vec3{0.3, 0.9, 0.3}));
}

TEST(Framing, IsTheSameEachTime) {
    const Framing once = framed(furnishedRoom()), again = framed(furnishedRoom());
    EXPECT_EQ(toToml(once.camera), toToml(again.camera));
    EXPECT_EQ(once.why, again.why);
}

TEST(Framing, SaysWhenThereIsNothingToLookAt) {
    Scene scene = tower();
    place(scene, 0);
    EXPECT_THAT(test::errorOf([&] { framed(scene); }), HasSubstr("no triangle has an area"));
    EXPECT_THAT(test::errorOf([&] { extentOf(Scene()); }), HasSubstr("no triangle has an area"));
}

TEST(Radius, IsOneTwoOrFiveTimesAPowerOfTen) {
    const std::pair<double, double> rounded[] = {
        {0.5, 0.5}, {1.4, 1},  {1.42, 2},       {3, 2},        {3.2, 5},
        {7, 5},     {7.1, 10}, {0.0012, 0.001}, {0.068, 0.05}, {0.08, 0.1}};
    for (const auto& [metres, expected] : rounded)
        EXPECT_NEAR(roundRadius(metres), expected, 1e-12 * expected) << metres;
}

// Backs of materials that are not double-sided are not there for who looks, but for who asks.
TEST(Sight, MeetsWhatAPictureShows) {
    Scene scene;
    addBox(scene, vec3(-1), vec3(1));
    const vec3 ahead(0, 0, -1);
    const Sight sight(scene);
    ASSERT_TRUE(sight.along(vec3(0, 0, 5), ahead));
    EXPECT_FLOAT_EQ(sight.along(vec3(0, 0, 5), ahead)->distance, 4);
    EXPECT_TRUE(sight.along(vec3(0, 0, 5), ahead)->front);
    EXPECT_FALSE(sight.along(vec3(0), ahead));
    const auto back = sight.along(vec3(0), ahead, true);
    ASSERT_TRUE(back);
    EXPECT_FALSE(back->front);
    EXPECT_EQ(back->faceNormal, vec3(0, 0, 1));
    scene.materials[0].doubleSided = true;
    EXPECT_TRUE(Sight(scene).along(vec3(0), ahead));
}

} // namespace
} // namespace obscura
