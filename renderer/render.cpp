#include "renderer/render.h"

#include "base/files.h"
#include "base/version.h"
#include "renderer/builtin/builtin.h"
#include "renderer/frame/composite.h"
#include "renderer/probe.h"
#include "renderer/reference/traced.h"
#include "renderer/scene/ground.h"
#include "renderer/techniques/occlusion_passes.h"
#include "renderer/techniques/pass_shaders.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

namespace obscura {

namespace {

// What is wrong with a file that a protocol names is told with the line that names it.
template <typename Read>
auto namedAt(const Place& place, Read read) {
    try {
        return read();
    } catch (const std::exception& error) {
        throw Error(place, error.what());
    }
}

// Sub-pixel offsets of `count` frames: the R2 sequence (Roberts 2018) fills the pixel evenly for
// any count.
glm::vec2 jitterOf(int frame, int count) {
    if (count == 1)
        return {0, 0};
    const auto coordinate = [&](double step) {
        const double value = 0.5 + frame * step;
        return static_cast<float>(value - std::floor(value) - 0.5);
    };
    return {coordinate(0.7548776662466927), coordinate(0.5698402909980532)};
}

void hashTarget(Sha256& hash, const gl::Target& target, int i) {
    hash.add(gl::readBytes(target.colour(i), target.width(), target.height(), target.format(i)));
}
void hashTargets(Sha256& hash, const gl::Target& target, int count) {
    for (int i = 0; i < count; ++i)
        hashTarget(hash, target, i);
}

Image layerOf(const gl::Target& target, int index) {
    const int have = gl::channelsOf(target.format(index));
    return flipped(
        gl::readFloats(target.colour(index), target.width(), target.height(), target.format(index)),
        target.width(), target.height(), have, 0, have);
}

double meanOcclusion(const Image& visibility, const std::vector<float>& depth, float empty) {
    double sum = 0;
    std::size_t count = 0;
    for (int y = 0; y < visibility.height; ++y)
        for (int x = 0; x < visibility.width; ++x) {
            const auto at =
                static_cast<std::size_t>((visibility.height - 1 - y) * visibility.width + x);
            if (depth[at] < empty) {
                sum += 1 - static_cast<double>(visibility.at(x, y, 0));
                ++count;
            }
        }
    return count ? sum / static_cast<double>(count) : 0;
}

// Adds the time since the last mark to a stage, once the GPU has done all of it.
class StageClock {
  public:
    void mark(double& stage) {
        gl::finish();
        const auto now = std::chrono::steady_clock::now();
        stage += std::chrono::duration<double>(now - last_).count();
        last_ = now;
    }

  private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

} // namespace

Scene loadSceneOf(const View& view, const Folders& folders) {
    return namedAt(view.place, [&] {
        Scene scene =
            view.file.empty() ? builtinScene(view.builtin) : loadScene(folders.scenes / view.file);
        if (view.ground)
            addGround(scene, *view.ground);
        return scene;
    });
}

std::string SceneHashes::of(const View& view) {
    std::string& hash = known_[view.builtin + "\n" + view.file];
    if (hash.empty())
        hash = namedAt(view.place, [&] {
            return view.file.empty() ? builtinScene(view.builtin).sha256
                                     : sceneSha256(folders_.scenes / view.file);
        });
    return view.ground ? sha256With(*view.ground, hash) : hash;
}

Settings settingsOf(const Recipe& recipe) {
    Settings settings(technique(recipe.technique));
    for (const auto& [name, value] : recipe.settings)
        settings.set(name, value);
    return settings;
}

std::string shaderSha256(const Settings& settings, const Level& level) {
    Sha256 hash;
    hash.add(shaderText("screen.vert").text());
    hash.add(gbufferShaders());
    hash.add(lightShader(level).text());
    for (const Pass* pass : enabledPasses(settings)) {
        for (int l = 0; l < (pass->levels > 1 ? 2 : 1); ++l)
            hash.add(passShader(settings, *pass, l).text());
        if (drawsObjects(*pass))
            hash.add(objectShader(settings, *pass).text());
    }
    if (downscaleOf(settings) > 1)
        hash.add(Reduction::reduceShader().text() + Reduction::upsampleShader().text());
    hash.add(compositeShader().text());
    if (settings.technique().reads & (rays | traced)) // stands in for passes
        hash.add(rayTracerVersion());
    return hash.hex();
}

Recipe makeRecipe(const Protocol& protocol, const Condition& condition, int member,
                  SceneHashes& scenes, const gl::Driver& driver, std::string_view code) {
    const View& view = protocol.view(condition.view);
    const Level& level = protocol.level(condition.level);
    const Settings settings =
        settingsOf(protocol.technique(condition.roles[static_cast<std::size_t>(member)].technique),
                   view.radius);
    Recipe recipe;
    recipe.width = protocol.width;
    recipe.height = protocol.height;
    recipe.antialiasing = protocol.antialiasing;
    recipe.seed = protocol.seed;
    recipe.normals = protocol.normals;
    recipe.view = view;
    recipe.level = level;
    recipe.sceneSha256 = scenes.of(view);
    if (!level.environment.empty())
        recipe.environmentSha256 = namedAt(
            level.place, [&] { return sha256File(scenes.folders().protocol / level.environment); });
    recipe.technique = std::string(settings.technique().id);
    recipe.settings = settings.named();
    recipe.shaderSha256 = shaderSha256(settings, level);
    recipe.codeSha256 = std::string(code);
    recipe.programVersion = std::string(version());
    recipe.glVendor = driver.vendor;
    recipe.glRenderer = driver.renderer;
    recipe.glVersion = driver.version;
    return recipe;
}

// What stays from one recipe to the next.
struct RecipeRenderer::Stage {
    std::string sceneSha256, lighting; // what is loaded; the latter as text
    std::optional<Subject> subject;
    std::optional<RayTracer> tracer;
    std::map<std::string, Image> traced; // visibility of each frame, by all that decides it
    std::optional<Lighting> light;

    const Image& tracedIn(const Frame& frame, int index, const Recipe& recipe,
                          const Settings& settings);
};

// The seed is each frame's own, so that frames average the rays' noise too.
const Image& RecipeRenderer::Stage::tracedIn(const Frame& frame, int index, const Recipe& recipe,
                                             const Settings& settings) {
    Recipe unlit = recipe;
    unlit.level = {};
    unlit.environmentSha256.clear();
    unlit.shaderSha256.clear();
    Image& known = traced[fmt::format("{} {}", index, unlit.json())];
    if (known.pixels.empty())
        known = tracedVisibility(
            *tracer, surfacesOf(subject->scene(), subject->pass(), frame, recipe.normals), settings,
            recipe.seed + static_cast<std::uint64_t>(index) * 0x9e3779b97f4a7c15u);
    return known;
}

RecipeRenderer::RecipeRenderer(Folders folders)
    : folders_(std::move(folders)), stage_(std::make_unique<Stage>()) {}
RecipeRenderer::~RecipeRenderer() = default;

const std::filesystem::path RecipeRenderer::environmentOf(const Level& level) const {
    return folders_.protocol / level.environment;
}

void RecipeRenderer::prepare(const Recipe& recipe) {
    const auto mustBe = [](const std::string& what, const std::string& found,
                           const std::string& expected) {
        if (found != expected)
            throw Error(
                fmt::format("expected {} with SHA-256 {}, found {}: it has changed since the "
                            "recipe was made; generate the stimuli again",
                            what, expected, found));
    };
    if (stage_->sceneSha256 != recipe.sceneSha256) {
        stage_->light.reset();
        stage_->tracer.reset();
        stage_->traced.clear();
        stage_->subject.reset();
        const Scene scene = loadSceneOf(recipe.view, folders_); // the GPU and Embree keep theirs
        mustBe(fmt::format("scene \"{}\"", recipe.view.name), scene.sha256, recipe.sceneSha256);
        warnings_ = scene.warnings;
        namedAt(recipe.view.place, [&] { stage_->subject.emplace(scene); });
        stage_->tracer.emplace(scene);
        stage_->sceneSha256 = recipe.sceneSha256;
        stage_->lighting.clear();
    }
    // The recipe's JSON is a canonical text of everything lighting depends on, and of more.
    Recipe lightingOnly;
    lightingOnly.level = recipe.level;
    lightingOnly.environmentSha256 = recipe.environmentSha256;
    if (const std::string key = lightingOnly.json(); stage_->lighting != key) {
        if (!recipe.level.environment.empty())
            mustBe("the environment image", sha256File(environmentOf(recipe.level)),
                   recipe.environmentSha256);
        stage_->light.reset();
        namedAt(recipe.level.place, [&] {
            stage_->light.emplace(recipe.level, stage_->subject->scene(),
                                  environmentOf(recipe.level));
        });
        stage_->lighting = key;
    }
}

const Subject& RecipeRenderer::subject(const Recipe& recipe) {
    prepare(recipe);
    return *stage_->subject;
}

Rendering RecipeRenderer::render(const Recipe& recipe, bool layers) {
    const Settings settings = settingsOf(recipe);
    StageClock clock;
    prepare(recipe);
    const Lighting& lighting = *stage_->light;
    const GpuScene& scene = stage_->subject->scene();
    const GBufferPass& gbufferPass = stage_->subject->pass();
    const int guard = guardPixels(settings, recipe.height);
    GBufferContent content;
    content.shadingNormal = lighting.readsNormals();
    content.occlusionNormal = normalsFor(settings.technique(), recipe.normals);
    content.emission = scene.emits();
    const GBuffer gbuffer(recipe.width, recipe.height, content);
    // What the technique sees, where that is more than the image shows.
    std::optional<GBuffer> padded;
    if (guard > 0)
        padded.emplace(recipe.width + 2 * guard, recipe.height + 2 * guard,
                       GBufferContent{false, false, content.occlusionNormal});
    const LightBuffers light(recipe.width, recipe.height, lighting.hasDirect());
    const OcclusionPasses occlusion(settings, recipe.width + 2 * guard, recipe.height + 2 * guard);
    Composite composite(recipe.view, recipe.level, recipe.width, recipe.height, layers);
    clock.mark(times_.scene);

    Rendering result;
    Sha256 inputs;
    std::vector<float> firstDepth;
    float empty = 0;
    for (int i = 0; i < recipe.antialiasing; ++i) {
        const Frame frame =
            makeFrame(recipe.view.camera, recipe.width, recipe.height, scene.bounds(), recipe.seed,
                      jitterOf(i, recipe.antialiasing));
        const gl::UniformBuffer block = frameBuffer(frame);
        bindFrame(block);
        gbufferPass.draw(scene, frame, gbuffer);
        clock.mark(times_.gbuffer);
        lighting.draw(gbuffer, light);
        clock.mark(times_.light);
        hashTargets(inputs, gbuffer.target(), lighting.readsNormals() ? 3 : 2);
        if (gbuffer.emission())
            hashTarget(inputs, gbuffer.target(), 4);
        hashTargets(inputs, light.target(), light.target().count());
        if (i == 0) {
            firstDepth =
                gl::readFloats(gbuffer.depth(), recipe.width, recipe.height, gl::Format::r32f);
            empty = frame.depth.y;
            constexpr const char* names[] = {"albedo", "depth", "normal", "occlusion-normal",
                                             "emission"};
            for (int c = 0; layers && c < gbuffer.target().count(); ++c)
                if (gbuffer.target().has(c))
                    result.layers[names[c]] = layerOf(gbuffer.target(), c);
        }
        clock.mark(times_.hash);
        Frame seen = frame;                         // by the technique
        std::optional<gl::UniformBuffer> wideBlock; // occlusion reads it too
        if (padded) {
            seen = makeFrame(recipe.view.camera, recipe.width, recipe.height, scene.bounds(),
                             recipe.seed, jitterOf(i, recipe.antialiasing), guard);
            wideBlock.emplace(frameBuffer(seen));
            bindFrame(*wideBlock);
            gbufferPass.draw(scene, seen, *padded);
        }
        std::optional<gl::Texture> traced;
        if (settings.technique().reads & rays)
            traced = visibilityTexture(stage_->tracedIn(frame, i, recipe, settings));
        bindFrame(wideBlock ? *wideBlock : block);
        const gl::Texture& visibility =
            traced ? *traced
                   : occlusion.visibility({padded ? *padded : gbuffer, seen,
                                           [&]() -> OcclusionInputs::Light {
                                               return {light, lighting};
                                           },
                                           std::cref(stage_->subject->spheres()),
                                           stage_->subject->peel(), &stage_->subject->occluders(),

                                           std::cref(stage_->subject->triangles()),
                                           std::cref(stage_->subject->traced())});
        clock.mark(times_.occlusion);
        composite.draw(light, visibility, occlusion.sendsLight(), guard, gbuffer.emission());
        clock.mark(times_.composite);
    }

    const std::vector<float> mean = composite.mean();
    result.image = displayed(flipped(mean, recipe.width, recipe.height, 4, 0, 3));
    result.visibility = flipped(mean, recipe.width, recipe.height, 4, 3, 1);
    if (layers)
        result.layers["linear"] =
            flipped(composite.meanLinear(), recipe.width, recipe.height, 4, 0, 3);
    result.inputsSha256 = inputs.hex();
    result.meanOcclusion = meanOcclusion(result.visibility, firstDepth, empty);
    gl::throwMessages();
    clock.mark(times_.composite);
    return result;
}

} // namespace obscura
