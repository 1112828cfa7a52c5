// What the technique table says of texture fetches, against a count of them.
#include "renderer/techniques/fetches.h"
#include "tests/renderer/techniques/occlusion_fixture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace obscura {
namespace {

// The inside of a box 2 m wide and high, seen through its open front, with a block against the back
// wall: every pixel shows a surface 1 to 3 m away, and there are corners and walls face on.
Scene roomScene() {
    Scene scene;
    const auto quad = [&](glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
        addQuad(scene, {a, b, c, d});
    };
    quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
    quad({-1, -1, 4}, {1, -1, 4}, {1, -1, 0}, {-1, -1, 0});
    quad({-1, 1, 0}, {1, 1, 0}, {1, 1, 4}, {-1, 1, 4});
    quad({-1, -1, 4}, {-1, -1, 0}, {-1, 1, 0}, {-1, 1, 4});
    quad({1, -1, 0}, {1, -1, 4}, {1, 1, 4}, {1, 1, 0});
    quad({0, -1, 0.4f}, {0.6f, -1, 0.4f}, {0.6f, 0, 0.4f}, {0, 0, 0.4f});
    quad({0, -1, 0}, {0, -1, 0.4f}, {0, 0, 0.4f}, {0, 0, 0});
    quad({0, 0, 0.4f}, {0.6f, 0, 0.4f}, {0.6f, 0, 0}, {0, 0, 0});
    return scene;
}

// Face on, all that is seen.
Scene wallScene() {
    Scene scene;
    addQuad(scene,
            {glm::vec3(-9, -9, 0), glm::vec3(9, -9, 0), glm::vec3(9, 9, 0), glm::vec3(-9, 9, 0)});
    return scene;
}

// That room as techniques see it, with one sphere for its block.
class Room {
  public:
    Room(int width, int height, const Scene& scene = roomScene())
        : width_(width), height_(height), occluders_(scene), scene_(scene),
          frame_(makeFrame(camera(), width, height, scene_.bounds(), 1)),
          frameBlock_(frameBuffer(frame_)),
          lighting_(whiteLight(), scene_, std::filesystem::path()),
          gbuffer_(width, height, {true, false, Normals::smooth}), light_(width, height, false),
          spheres_(std::array{glm::vec4(0.3f, -0.5f, 0.2f, 0.3f)}),
          triangles_(std::make_shared<const Scene>(scene)),
          traced_(std::make_shared<const Scene>(scene)) {
        bindFrame(frameBlock_);
        pass_.draw(scene_, frame_, gbuffer_);
        lighting_.draw(gbuffer_, light_);
    }
    // Its frame is bound.
    OcclusionInputs inputs() const {
        bindFrame(frameBlock_);
        return {gbuffer_,
                frame_,
                [this]() -> OcclusionInputs::Light {
                    return {light_, lighting_};
                },
                [this]() -> const ProxySpheres& { return spheres_; },
                peelOf(pass_, scene_),
                &occluders_,
                std::cref(triangles_),
                std::cref(traced_)};
    }
    std::vector<FetchCount> count(const Settings& settings) const {
        return countFetches(settings, inputs(), width_, height_);
    }

  private:
    static Camera camera() {
        Camera camera;
        camera.position = {-0.2, 0.1, 2.5};
        camera.target = {-0.1, 0, 0};
        return camera;
    }
    int width_, height_;
    SceneOccluders occluders_;
    GpuScene scene_;
    Frame frame_;
    gl::UniformBuffer frameBlock_;
    Lighting lighting_;
    GBufferPass pass_;
    GBuffer gbuffer_;
    LightBuffers light_;
    ProxySpheres spheres_;
    SceneTriangles triangles_;
    FewRays traced_;
};

std::string spelt(const Settings& settings) {
    std::string text(settings.technique().id);
    for (const auto& [name, value] : settings.named())
        text += fmt::format(" {}={}", name, value);
    return text;
}

// Passes of which no pixel of the room makes all that could be: ssdo's, where every sample would
// have to be blocked from near, and compute blurs, for the room is smaller than a group, which so
// has no neighbours to load.
bool isBound(const Technique& row, const Pass& pass) {
    return (row.id == "ssdo" && pass.name != "shade") || pass.stage == Stage::rows ||
           pass.stage == Stage::columns;
}

void expectDeclared(const Room& room, Settings settings) {
    settings.set("radius", 0.8); // enough for all steps and lines, and still inside the image
    SCOPED_TRACE(spelt(settings));
    for (const FetchCount& count : room.count(settings)) {
        SCOPED_TRACE(fmt::format("{}, level {}", count.pass->name, count.level));
        EXPECT_LE(count.mean, count.most);
        if (count.pass->stage == Stage::boxes) { // of as many triangles as lie around the pixel
            EXPECT_GT(count.most, 0);
            EXPECT_EQ(std::fmod(count.most, count.declared), 0);
        } else if (isBound(settings.technique(), *count.pass)) {
            EXPECT_LE(count.most, count.declared);
            EXPECT_GT(count.most, 0.5 * count.declared);
        } else {
            EXPECT_EQ(count.most, count.declared);
        }
    }
}

TEST_F(GlTest, PassesFetchWhatTheyDeclare) {
    const Room room(64, 64);
    for (const Technique& row : techniques()) {
        if (row.passes.empty())
            continue;
        expectDeclared(room, Settings(row));
        for (const Preset& preset : row.presets) {
            Settings settings(row);
            settings.apply(preset.name);
            expectDeclared(room, settings);
        }
    }
}

TEST_F(GlTest, PassesFetchWhatTheyDeclareWithOtherSettings) {
    const struct {
        const char* technique;
        std::vector<PresetValue> values;
    } cases[] = {
        {"crytek", {{"samples", 20}}},
        {"crytek_shaderx7", {{"samples", 5}}},
        {"starcraft", {{"samples", 5}}},
        {"ray_march", {{"samples", 7}, {"steps", 9}}},
        {"hbao", {{"directions", 3}, {"steps", 7}, {"blurRadius", 6}, {"ownLayer", 1}}},
        {"hbao_deinterleaved", {{"directions", 5}, {"steps", 2}}},
        {"vao", {{"downscale", 2}}},
        {"multi_scale", {{"blur", 0}, {"steps", 2}}},
        {"gtao", {{"denoise", 0}, {"bentNormals", 1}, {"steps", 5}}},
        {"gtao", {{"denoise", 3}, {"bentNormals", 1}}},
        {"gtao", {{"adaptive", 1}}},
        {"gtao", {{"adaptive", 1}, {"layers", 3}}},
        {"visibility_bitmask", {{"denoise", 3}, {"slices", 2}, {"layers", 2}}},
        {"visibility_bitmask", {{"adaptive", 1}, {"slices", 2}}},
        {"gt_vbao", {{"adaptive", 1}, {"steps", 3}}},
        {"alchemy", {{"samples", 7}, {"blurRadius", 32}}},
        {"sao", {{"samples", 24}, {"mipOffset", 0}}},
        {"volumetric_obscurance", {{"samples", 4}, {"clipByNormal", 0}}},
        {"vao_plus_plus",
         {{"adaptive", 0},
          {"culling", 0},
          {"samples", 9},
          {"blur", 0},
          {"luminanceSensitivity", 1}}},
        {"vao_plus_plus",
         {{"blur", 2}, {"blurSize", 6}, {"luminanceSensitivity", 2}, {"colourBleeding", 3}}},
        {"ssdo", {{"blur", 0}, {"samples", 8}}},
        {"ssdo", {{"bounce", 0}}},
        {"rtao", {{"denoise", 0}}},
        {"proxy_spheres", {{"detail", 0}}},
        {"proxy_spheres", {{"distant", 0}, {"blur", 0}, {"samples", 6}}},
    };
    const Room room(64, 64);
    for (const auto& [id, values] : cases) {
        Settings settings(technique(id));
        for (const PresetValue& given : values)
            settings.set(given.name, static_cast<double>(given.value));
        expectDeclared(room, settings);
    }
}

// Of what the row declares, a single slice where all is open.
TEST_F(GlTest, AdaptiveSlicesAreSparedOnAWall) {
    const Room wall(64, 64, wallScene());
    for (const char* id : {"gtao", "visibility_bitmask"}) {
        Settings settings(technique(id));
        settings.set("adaptive", 1);
        for (const FetchCount& count : wall.count(settings)) {
            if (count.pass->name != "gather")
                continue;
            EXPECT_EQ(count.most,
                      count.declared - 2 * (settings["slices"] - 1) * settings["steps"]);
        }
    }
}

// A line of 384 pixels is three groups of 128. The one in the middle has neighbours on both sides.
TEST_F(GlTest, GroupsShareWhatTheyFetch) {
    Settings settings(technique("alchemy"));
    settings.set("samples", 1);
    settings.set("blurRadius", 20);
    const auto expectShare = [&](const Room& room, std::string_view pass) {
        const std::vector<FetchCount> counts = room.count(settings);
        const auto count = std::find_if(counts.begin(), counts.end(),
                                        [&](const FetchCount& c) { return c.pass->name == pass; });
        EXPECT_EQ(count->most, count->declared);
        EXPECT_DOUBLE_EQ(count->most, 3 * (128 + 2 * 20) / 128.0);
        EXPECT_DOUBLE_EQ(count->mean, 3 * (384 + 4 * 20) / 384.0);
    };
    expectShare(Room(384, 8), "blurRows");
    expectShare(Room(8, 384), "blurColumns");
}

// What one of renderer/techniques/reduction.h's shaders fetches for any pixel, which is as much for
// all.
double fetchesOf(std::string shader, const std::string& output, std::map<const char*, int> values) {
    shader.erase(0, shader.find('\n') + 1); // the version, which is in `text` already
    shader.replace(shader.find("void main()"), 11, "void counted()");
    gl::ShaderText text;
    text.add("int count = 0;\n#define texelFetch(a, b, c) (++count, texelFetch(a, b, c))\n"
             "#define textureGather(a, b) (++count, textureGather(a, b))",
             "");
    text.add(shader, "");
    text.add("void main() { counted(); " + output + " = float(count); }", "");
    const gl::Program program("counting", shaderText("screen.vert"), text);
    for (const auto& [name, value] : values)
        program.set(name, value);
    const gl::Target target(8, 8, std::array{gl::Format::r32f}, false, "count");
    gl::State().apply();
    target.bind();
    program.use();
    gl::ScreenTriangle().draw();
    const std::vector<float> counts = gl::readFloats(target.colour(0), 8, 8, gl::Format::r32f);
    EXPECT_EQ(counts, std::vector(counts.size(), counts[0]));
    return counts[0];
}

TEST_F(GlTest, TheReductionFetchesWhatItDeclares) {
    const Room room(64, 64);
    Settings settings(technique("vao"));
    settings.set("downscale", 2);
    const OcclusionPasses passes(settings, 64, 64);
    passes.visibility(room.inputs()); // leaves what upsampling reads bound
    EXPECT_EQ(fetchesOf(Reduction::upsampleShader().text(), "visibilityOut.r", {{"factor", 2}}),
              Reduction::upsamplePass.fetches(settings));
    const std::string reduce = Reduction::reduceShader().text();
    EXPECT_EQ(fetchesOf(reduce, "depthOut", {{"factor", 2}, {"hasNormals", 1}}),
              Reduction::reducePass.fetches(settings));
    EXPECT_EQ(fetchesOf(reduce, "depthOut", {{"factor", 2}, {"hasNormals", 0}}),
              Reduction::reducePass.fetches(Settings(technique("crytek"))));
}

TEST(FetchesPerPixel, WeighsPassesByTheirTargets) {
    static constexpr Parameter parameters[] = {
        {"blur", Unit::flag, "switches a pass", 0, 0, 1, "this test"}};
    static constexpr Pass passes[] = {
        {.name = "layered",
         .format = gl::Format::r16f,
         .scale = 2,
         .layers = 3,
         .fetches = [](const Settings&) { return 8.0; }},
        {.name = "levels",
         .format = gl::Format::r16f,
         .levels = 3,
         .fetches = [](const Settings&) { return 1.0; },
         .levelFetches = [](const Settings&) { return 4.0; }},
        {.name = "switched",
         .format = gl::Format::r16f,
         .enabledBy = "blur",
         .fetches = [](const Settings&) { return 100.0; }},
    };
    const Technique row{"made_up", "", "", depthOnly, nullptr, parameters, passes};
    Settings settings(row);
    EXPECT_DOUBLE_EQ(fetchesPerPixel(settings), 8.0 * 3 / 4 + 1 + 4.0 / 4 + 4.0 / 16);
    settings.set("blur", 1);
    EXPECT_DOUBLE_EQ(fetchesPerPixel(settings), 108.25);
}

TEST(FetchesPerPixel, CountsWhatReducedResolutionAdds) {
    Settings settings(technique("starcraft"));
    EXPECT_DOUBLE_EQ(fetchesPerPixel(settings), (2 + 16) + (1 + 16));
    settings.set("downscale", 2);
    EXPECT_DOUBLE_EQ(fetchesPerPixel(settings), (2 + 35) / 4.0 + 4);
}

} // namespace
} // namespace obscura
