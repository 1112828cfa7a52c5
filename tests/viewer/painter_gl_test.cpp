// What the painter draws, beside what stimuli are made with; and what it does not draw again.
#include "base/files.h"
#include "renderer/render.h"
#include "renderer/techniques/pass_shaders.h"
#include "tests/renderer/scene/small_gltf.h"
#include "tests/renderer/techniques/occlusion_fixture.h"
#include "tests/viewer/room.h"
#include "viewer/painter.h"
#include "viewer/tracer.h"

#include <gmock/gmock.h>

#include <cmath>
#include <condition_variable>
#include <mutex>

namespace obscura {
namespace {

class PainterTest : public GlTest {
  protected:
    Drawn draw(const Wanted& wanted) {
        compiled_ = 0;
        return painter_.draw(wanted, [&](const Painter::Step& step) {
            compiled_ += step.kind == Painter::Step::Kind::compiling;
        });
    }
    void openRoom() { painter_.open(1, room()); }

    Painter painter_{gl::Timing::finish};
    int compiled_ = 0; // techniques, by the last draw()
};

std::array<int, 3> colourAt(const Image8& image, int x, int y) {
    const auto at = static_cast<std::size_t>((y * image.width + x) * 3);
    return {image.pixels[at], image.pixels[at + 1], image.pixels[at + 2]};
}

std::vector<float> cornersOf(const Scene& scene) {
    std::vector<float> corners;
    for (const std::uint32_t index : scene.indices)
        for (int axis = 0; axis < 3; ++axis)
            corners.push_back(scene.vertices[index].position[axis]);
    return corners;
}

// One by one, by the code that makes stimuli: with a guard band, on every second pixel, and sending
// light.
TEST_F(PainterTest, LitPicturesAreThoseOfStimuli) {
    const std::filesystem::path folder(testing::TempDir());
    const std::vector<float> corners = cornersOf(room());
    writeFile(folder / "t.bin", trianglesBuffer(corners));
    writeFile(folder / "room.gltf", trianglesGltf(corners));
    const Scene scene = loadScene(folder / "room.gltf");
    painter_.open(7, scene);
    Wanted wanted = wantedOf(7, {settingsOf("starcraft", {{"samples", 16}, {"downscale", 2}}),
                                 settingsOf("sao", {{"guardBand", 0.1}}), settingsOf("ssdo"),
                                 settingsOf("none")});
    wanted.view.file = (folder / "room.gltf").string();
    wanted.view.exposure = 0.3;
    wanted.level.ambient.reset();
    wanted.level.sky = Sky{};
    const Drawn drawn = draw(wanted);
    RecipeRenderer renderer{Folders{}};
    for (std::size_t i = 0; i < wanted.panes.size(); ++i) {
        Recipe recipe;
        recipe.width = wanted.width;
        recipe.height = wanted.height;
        recipe.seed = 1;
        recipe.view = wanted.view;
        recipe.sceneSha256 = scene.sha256;
        recipe.level = wanted.level;
        recipe.technique = std::string(wanted.panes[i].technique().id);
        recipe.settings = wanted.panes[i].named();
        const Rendering rendering = renderer.render(recipe);
        EXPECT_EQ(imageOf(*drawn.panes[i].picture).pixels, rendering.image.pixels)
            << recipe.technique;
        EXPECT_EQ(painter_.visibility(static_cast<int>(i)).pixels, rendering.visibility.pixels)
            << recipe.technique;
    }
}

// A wall of many pieces that fills every picture: none of it may be left out.
TEST_F(PainterTest, NothingThatIsSeenIsLeftOut) {
    Scene scene;
    for (int x = -60; x < 60; ++x)
        for (int y = -60; y < 60; ++y) {
            const float left = static_cast<float>(x), low = static_cast<float>(y);
            addQuad(scene, {glm::vec3(left, low, 0), glm::vec3(left + 1, low, 0),
                            glm::vec3(left + 1, low + 1, 0), glm::vec3(left, low + 1, 0)});
        }
    painter_.open(1, scene);
    Wanted wanted = wantedOf(1, {settingsOf("none")});
    for (const double side : {-3.0, 0.3, 2.0}) {
        wanted.view.camera.position = {side, 0.7, 6};
        wanted.view.camera.target = {-0.5 * side, 0.3 * side, 0};
        draw(wanted);
        const Surfaces surfaces = painter_.surfaces();
        for (std::size_t i = 0; i < surfaces.depth.size(); ++i)
            ASSERT_FALSE(surfaces.empty(i)) << i << " from " << side;
    }
}

// A time is kept with what was drawn in it: two measured times are never equal to the last bit.
TEST_F(PainterTest, OneSliderRunsOneTechnique) {
    openRoom();
    Wanted wanted = wantedOf(1, {settingsOf("starcraft"), settingsOf("gtao")});
    const Drawn before = draw(wanted);
    EXPECT_EQ(compiled_, 2);
    wanted.panes[1].set("power", 3);
    const Drawn slid = draw(wanted);
    EXPECT_EQ(compiled_, 0);
    EXPECT_EQ(slid.gbufferMs, before.gbufferMs);
    EXPECT_EQ(slid.lightMs, before.lightMs);
    EXPECT_EQ(slid.panes[0].picture, before.panes[0].picture);
    EXPECT_EQ(slid.panes[0].ms, before.panes[0].ms);
    EXPECT_NE(slid.panes[1].ms, before.panes[1].ms);
    EXPECT_NE(imageOf(*slid.panes[1].picture).pixels, imageOf(*before.panes[1].picture).pixels);

    wanted.view.exposure = 1;
    const Drawn exposed = draw(wanted);
    EXPECT_EQ(exposed.lightMs, slid.lightMs);
    EXPECT_EQ(exposed.panes[1].ms, slid.panes[1].ms);
    EXPECT_NE(imageOf(*exposed.panes[0].picture).pixels, imageOf(*slid.panes[0].picture).pixels);

    wanted.view.camera.position[0] += 0.1;
    const Drawn moved = draw(wanted);
    EXPECT_EQ(compiled_, 0);
    EXPECT_NE(moved.gbufferMs, exposed.gbufferMs);
    EXPECT_NE(moved.panes[0].ms, exposed.panes[0].ms);
}

TEST_F(PainterTest, CompilesForWholeNumbersOnceAndForNothingElse) {
    openRoom();
    Wanted wanted = wantedOf(1, {settingsOf("starcraft", {{"samples", 8}})});
    const Drawn first = draw(wanted);
    EXPECT_EQ(compiled_, 1);
    wanted.panes[0].set("samples", 12);
    draw(wanted);
    EXPECT_EQ(compiled_, 1);
    wanted.panes[0].set("samples", 8);
    wanted.width = 100; // and back at once
    draw(wanted);
    EXPECT_EQ(compiled_, 0);
    wanted.width = 160;
    const Drawn again = draw(wanted);
    EXPECT_EQ(compiled_, 0);
    EXPECT_EQ(imageOf(*again.panes[0].picture).pixels, imageOf(*first.panes[0].picture).pixels);
}

TEST_F(PainterTest, ShowsBuffersAndProbesThem) {
    openRoom();
    Wanted wanted = wantedOf(1, {settingsOf("gtao")});
    wanted.view.camera.position = {2, 2, 3}; // 5 m before the wall
    wanted.view.camera.target = {2, 2, -2};
    wanted.show = Show::normals;
    EXPECT_EQ(colourAt(imageOf(*draw(wanted).panes[0].picture), 80, 45),
              (std::array<int, 3>{128, 128, 255})); // towards +z
    wanted.show = Show::occlusion;
    const Image8 grey = imageOf(*draw(wanted).panes[0].picture);
    EXPECT_THAT(colourAt(grey, 80, 45), testing::Each(colourAt(grey, 80, 45)[0]));
    EXPECT_EQ(colourAt(grey, 3, 88)[0], displayed(painter_.visibility(0)).pixels[88 * 160 + 3]);

    const Probed probed = painter_.probe(80, 45).value();
    EXPECT_TRUE(probed.surface);
    EXPECT_NEAR(probed.depth, 5, 1e-4);
    EXPECT_NEAR(probed.position.z, -2, 1e-4);
    EXPECT_NEAR(probed.position.x, 2, 0.05);
    EXPECT_NEAR(probed.normal.value().z, 1, 1e-3);
    EXPECT_EQ(static_cast<float>(probed.panes.at(0).visibility),
              painter_.visibility(0).at(80, 45, 0));
    EXPECT_EQ(probed.panes[0].passes.size(), enabledPasses(wanted.panes[0]).size());
    EXPECT_EQ(painter_.probe(160, 0), std::nullopt);
}

TEST_F(PainterTest, WithoutTexturesAllIsWhite) {
    Scene scene = room();
    scene.materials.front().baseColour = {0.215861f, 1, 0, 1};
    painter_.open(1, scene);
    Wanted wanted = wantedOf(1, {settingsOf("none")});
    wanted.show = Show::albedo;
    EXPECT_EQ(colourAt(imageOf(*draw(wanted).panes[0].picture), 80, 80),
              (std::array<int, 3>{128, 255, 0}));
    EXPECT_NEAR(painter_.probe(80, 80)->albedo.value().r, 0.2158, 1e-3);
    wanted.textures = false;
    EXPECT_THAT(colourAt(imageOf(*draw(wanted).panes[0].picture), 80, 80), testing::Each(255));
}

// A checked floor, seen flat: blurred in a draft, and then as it would have been without one.
TEST_F(PainterTest, ADraftIsSharpenedByTheNextPicture) {
    Scene scene = room();
    Texture texture;
    texture.image = {64, 64, 4, {}};
    for (int i = 0; i < 64 * 64; ++i)
        texture.image.pixels.insert(texture.image.pixels.end(), 4, (i + i / 64) % 2 ? 255 : 60);
    texture.srgb = true;
    scene.textures.push_back(texture);
    scene.materials.front().baseColourTexture.texture = 0;
    for (Vertex& vertex : scene.vertices)
        vertex.uv = {vertex.position.x * 0.2f, vertex.position.z * 0.2f};
    painter_.open(1, scene);
    Wanted wanted = wantedOf(1, {settingsOf("none")});
    wanted.view.camera.position = {0, 0.2, 5};
    const Drawn sharp = draw(wanted);
    wanted.view.camera.position[0] = 0.1;
    draw(wanted);
    wanted.view.camera.position[0] = 0;
    const Drawn draft = painter_.draw(wanted, {}, true);
    EXPECT_TRUE(draft.draft);
    EXPECT_NE(imageOf(*draft.panes[0].picture).pixels, imageOf(*sharp.panes[0].picture).pixels);
    const Drawn again = draw(wanted);
    EXPECT_FALSE(again.draft);
    EXPECT_EQ(imageOf(*again.panes[0].picture).pixels, imageOf(*sharp.panes[0].picture).pixels);
}

TEST_F(PainterTest, ErrorsAndDifferencesHaveTheColoursOfTheirScale) {
    openRoom();
    Wanted wanted = wantedOf(1, {settingsOf("none"), settingsOf("gtao", {{"intensity", 0}})});
    wanted.show = Show::error;
    wanted.difference = true;
    EXPECT_TRUE(draw(wanted).panes[0].waits); // for a reference
    ASSERT_EQ(painter_.truthsWanted().size(), 1U);
    const auto colour = [](std::size_t i) {
        const auto codes = errorColours(3)[i];
        return std::array<int, 3>{codes[0], codes[1], codes[2]};
    };
    const auto errorWith = [&](float reference) {
        auto image = std::make_shared<Image>(Image{160, 90, 1, {}});
        image->pixels.assign(160 * 90, reference);
        painter_.take(painter_.view(),
                      {{painter_.truthsWanted()[0], image, static_cast<int>(reference * 1000)}});
        const Drawn drawn = draw(wanted);
        EXPECT_FALSE(drawn.panes[0].waits);
        EXPECT_EQ(colourAt(imageOf(*drawn.difference), 80, 80), colour(1)); // both are open
        return colourAt(imageOf(*drawn.panes[0].picture), 80, 80);
    };
    EXPECT_EQ(errorWith(0.75f), colour(0)); // too bright by the whole scale
    EXPECT_EQ(errorWith(1), colour(1));
}

TEST_F(PainterTest, WhatCannotBeDrawnLeavesAllAsItWas) {
    openRoom();
    const Wanted wanted = wantedOf(1, {settingsOf("gtao")});
    const Drawn before = draw(wanted);
    Wanted wrong = wanted;
    wrong.level.ambient.reset();
    wrong.level.environment = "no-such-sky.hdr";
    EXPECT_THROW(draw(wrong), Error);
    wrong = wanted;
    wrong.panes.resize(5, wrong.panes[0]);
    EXPECT_THROW(draw(wrong), Error);
    wrong = wanted;
    wrong.scene = 2;
    EXPECT_THROW(draw(wrong), Error);
    EXPECT_EQ(draw(wanted).panes[0].picture, before.panes[0].picture);
}

// Whoever holds a picture keeps it as it is, also after the painter has gone.
TEST_F(PainterTest, APictureStaysWhatItIs) {
    std::shared_ptr<const SharedPicture> kept;
    {
        Painter painter(gl::Timing::finish);
        painter.open(1, room());
        Wanted wanted = wantedOf(1, {settingsOf("none")});
        kept = painter.draw(wanted).panes[0].picture;
        const Image8 before = imageOf(*kept);
        for (int i = 0; i < 4; ++i) {
            wanted.view.camera.position[0] += 0.3;
            painter.draw(wanted);
        }
        EXPECT_EQ(imageOf(*kept).pixels, before.pixels);
    }
    EXPECT_EQ(imageOf(*kept).width, 160);
}

TEST_F(PainterTest, ReferencesRefineAndJudge) {
    openRoom();
    Wanted wanted = wantedOf(1, {settingsOf("none"), settingsOf("ray_traced")});
    wanted.reference = true;
    draw(wanted);
    ASSERT_EQ(painter_.truthsWanted().size(), 1U); // both are of one radius and integral
    const auto rays = std::make_shared<const RayTracer>(room());
    const Surfaces surfaces = painter_.surfaces();
    std::mutex mutex;
    std::condition_variable changed;
    int calls = 0;
    Tracer tracer([&] {
        const std::lock_guard lock(mutex);
        ++calls;
        changed.notify_all();
    });
    const auto waitFor = [&](const auto& condition) {
        std::unique_lock lock(mutex);
        for (int seen = -1; !condition(); seen = calls)
            changed.wait(lock, [&] { return calls != seen; });
    };
    tracer.trace(painter_.view(), rays, surfaces, painter_.truthsWanted());
    std::vector<int> counts;
    waitFor([&] {
        const Tracer::Traced traced = tracer.traced();
        if (!traced.truths.empty() && (counts.empty() || counts.back() != traced.truths[0].rays))
            counts.push_back(traced.truths[0].rays);
        return !counts.empty() && counts.back() == Tracer::mostRays;
    });
    EXPECT_LE(counts.front(), 256);
    const Tracer::Traced traced = tracer.traced();
    EXPECT_EQ(traced.share, 1);
    TraceSettings settings;
    settings.rays = 1024;
    settings.seed = 99;
    const Image truth = rays->trace(surfaces, settings).visibility;
    double bias = 0, square = 0;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
        const double error = static_cast<double>(traced.truths[0].visibility->pixels[i]) -
                             static_cast<double>(truth.pixels[i]);
        bias += error / static_cast<double>(truth.pixels.size());
        square += error * error / static_cast<double>(truth.pixels.size());
    }
    EXPECT_LT(std::abs(bias), 5e-4);
    EXPECT_LT(std::sqrt(square), 5e-3);

    painter_.take(traced.view, traced.truths);
    draw(wanted);
    tracer.judge(painter_.comparison().value());
    std::optional<Judgement> judgement;
    waitFor([&] { return (judgement = tracer.judgement()).has_value(); });
    painter_.take(std::move(*judgement));
    wanted.show = Show::jod;
    const Drawn drawn = draw(wanted);
    EXPECT_EQ(drawn.panes[1].quality.value().rmse, 0); // the reference is the reference
    EXPECT_EQ(drawn.panes[1].quality->jod, 10);
    EXPECT_GT(drawn.panes[0].quality.value().rmse, 0.05);
    EXPECT_LT(drawn.panes[0].quality->jod, 9.9);
    EXPECT_EQ(drawn.panes[0].quality->rays, 1024);
    EXPECT_FALSE(drawn.panes[0].waits);
}

} // namespace
} // namespace obscura
