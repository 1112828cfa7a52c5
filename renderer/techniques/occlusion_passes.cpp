#include "renderer/techniques/occlusion_passes.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace obscura {

namespace {

// Binding points of a pass's shader. Blocks; the frame is 0.
constexpr int settingsBinding = 1, pointsBinding = 2, environmentBinding = 3, spheresBinding = 4,
              voxelsBinding = 6;
// Storage blocks have bindings of their own.
constexpr int treeBinding = 5; // three of them
constexpr int occludersBinding = 3;
// Samplers; later results follow.
constexpr int depthUnit = 0, normalUnit = 1, albedoUnit = 2, ambientUnit = 3, directUnit = 4,
              resultUnit = 5, voxelsUnit = 20, tracedUnit = 21; // results end below these
constexpr int group = 128; // compute shaders' pixels that share memory

bool enabled(const Settings& settings, const Pass& pass) {
    return pass.enabledBy.empty() || settings[pass.enabledBy] >= static_cast<float>(pass.from);
}

bool widened(const Settings& settings, const Pass& pass) {
    return !pass.widenedBy.empty() && settings[pass.widenedBy] > 0;
}

int layerUnit(const Technique& technique, int further) {
    return resultUnit + static_cast<int>(technique.passes.size()) + further;
}

bool computes(const Pass& pass) {
    return pass.stage == Stage::rows || pass.stage == Stage::columns;
}

// Consecutive scalars lie in consecutive four-byte slots of std140, so the values upload as they
// are, rounded up to sixteen bytes.
gl::UniformBuffer settingsBlock(const Settings& settings) {
    std::vector<float> values = settings.values();
    if (settings.has("radiusMultiplier"))
        for (std::size_t i = 0; i < values.size(); ++i)
            if (settings.technique().parameters[i].name == "radius")
                values[i] *= settings["radiusMultiplier"];
    values.resize((values.size() + 4) / 4 * 4);
    return gl::UniformBuffer(std::as_bytes(std::span(values)));
}

// A uniform block where that many points fit into one: every driver has 16 KiB, and all pixels read
// the same point at once, which is what uniforms are fast at. Both kinds lie alike in memory.
gl::UniformBuffer::Kind kindOf(std::span<const glm::vec4> points) {
    return points.size_bytes() <= 16384 ? gl::UniformBuffer::Kind::uniform
                                        : gl::UniformBuffer::Kind::storage;
}

// So that shaders compiled for one serve the other.
[[maybe_unused]] bool wholeAlike(const Settings& one, const Settings& other) {
    for (const Parameter& parameter : one.technique().parameters)
        if (isWhole(parameter) && one[parameter.name] != other[parameter.name])
            return false;
    return true;
}

std::optional<gl::UniformBuffer> pointsOf(const Settings& settings) {
    if (!settings.technique().points)
        return std::nullopt;
    const std::vector<glm::vec4> points = settings.technique().points(settings);
    return gl::UniformBuffer(std::as_bytes(std::span(points)), kindOf(points));
}

// What becomes of the last pass's visibility (technique.h); for passes that need it sooner too.
constexpr const char* finalVisibility = R"(float finalVisibility(float v) {
    float occlusion = sign(settings.power) * settings.intensity * (1.0 - v);
    return clamp(pow(max(1.0 - occlusion, 0.0), settings.power), 0.0, 1.0);
}
)";

// Whole numbers are constants of the shader, so that its compiler unrolls loops and leaves out what
// is switched off; what a study fits or a person drags changes without compiling anew.
std::string declareSettings(const Settings& settings) {
    std::string members, values;
    for (const Parameter& parameter : settings.technique().parameters) {
        members += fmt::format("    float {};\n", parameter.name);
        values += fmt::format("{}{}", values.empty() ? "" : ", ",
                              isWhole(parameter) ? fmt::format("{:.1f}", settings[parameter.name])
                                                 : fmt::format("given.{}", parameter.name));
    }
    return fmt::format("layout(std140, binding = {}) uniform SettingsBlock {{\n{}}} given;\n"
                       "struct Settings {{\n{}}};\nSettings settings = Settings({});\n{}",
                       settingsBinding, members, members, values,
                       settings.has("intensity") ? finalVisibility : "");
}

void declareBlocks(gl::ShaderText& text, const Settings& settings) {
    std::string block = "layout(std140, binding = 0) uniform FrameBlock { Frame frame; };\n";
    if (!settings.technique().parameters.empty())
        block += declareSettings(settings);
    if (settings.technique().reads & spheres)
        block += fmt::format("layout(std430, binding = {}) readonly buffer SphereBlock {{ vec4 "
                             "spheres[]; }}; // world position, radius\n",
                             spheresBinding);
    if (settings.technique().reads & triangles)
        block +=
            fmt::format("struct Occluder {{ vec4 a, b, c; }}; // corners; w: coverage, whether "
                        "double-sided\nlayout(std430, binding = {}) readonly buffer "
                        "OccluderBlock {{ Occluder occluders[]; }};\n",
                        occludersBinding);
    if (settings.technique().reads & voxels)
        block += fmt::format("layout(std140, binding = {}) uniform VoxelBlock {{ vec4 voxelPlace, "
                             "voxelScale; }};\n",
                             voxelsBinding);
    if (settings.technique().reads & tree)
        block += fmt::format(
            "layout(std430, binding = {}) readonly buffer NodeBlock {{ uvec4 nodes[]; }};\n"
            "layout(std430, binding = {}) readonly buffer TriangleBlock {{ vec4 triangles[]; }};\n"
            "layout(std430, binding = {}) readonly buffer MaskBlock {{ uint masks[]; }};\n",
            treeBinding, treeBinding + 1, treeBinding + 2);
    text.addFile(shaderFolder(), "frame.h");
    text.add(block, "(generated declarations)");
}

std::string declarePoints(const std::vector<glm::vec4>& points) {
    const bool uniform = kindOf(points) == gl::UniformBuffer::Kind::uniform;
    return fmt::format("layout({}, binding = {}) {} PointBlock {{ vec4 points[{}]; }};\n",
                       uniform ? "std140" : "std430", pointsBinding,
                       uniform ? "uniform" : "readonly buffer", points.size());
}

std::string declareInputs(const Settings& settings) {
    const Technique& technique = settings.technique();
    std::string text =
        fmt::format("layout(binding = {}) uniform sampler2D depthBuffer;\n", depthUnit);
    if (technique.reads & normals)
        text += fmt::format("layout(binding = {}) uniform sampler2D normalBuffer;\n", normalUnit);
    if (technique.reads & light) {
        text += fmt::format("layout(binding = {}) uniform sampler2D albedoBuffer;\n", albedoUnit);
        text += fmt::format("layout(binding = {}) uniform sampler2D ambientLight;\n", ambientUnit);
        text += fmt::format("layout(binding = {}) uniform sampler2D directLight;\n", directUnit);
    }
    if (technique.reads & layers)
        for (int further = 0; further < 2; ++further)
            text += fmt::format("layout(binding = {}) uniform sampler2D {}Depth;\n",
                                layerUnit(technique, further), further == 0 ? "second" : "third");
    if (technique.reads & voxels)
        text += fmt::format("layout(binding = {}) uniform sampler3D voxelOpacity;\n", voxelsUnit);
    if (technique.reads & traced)
        text += fmt::format("layout(binding = {}) uniform sampler2D tracedBuffer;\n", tracedUnit);
    if (technique.points)
        text += declarePoints(technique.points(settings));
    // The results of all passes are declared, because the file's other functions must compile too.
    int unit = resultUnit;
    for (const Pass& pass : technique.passes)
        text += fmt::format("layout(binding = {}) uniform {} {}Result;\n", unit++,
                            pass.layers > 1 ? "sampler2DArray" : "sampler2D", pass.name);
    return text;
}

// A macro is not expanded inside itself.
constexpr const char* countingFetches = R"(int fetchCount = 0;
#define texelFetch(values, pixel, level) (++fetchCount, texelFetch(values, pixel, level))
#define texture(values, uv) (++fetchCount, texture(values, uv))
#define textureLod(values, uv, level) (++fetchCount, textureLod(values, uv, level))
#define textureGather(values, uv) (++fetchCount, textureGather(values, uv))
)";

// A pixel's share of what its group fetches; a group lies along one axis.
constexpr const char* groupShare = R"(    if (gl_LocalInvocationIndex == 0u)
        groupFetches = 0;
    barrier();
    atomicAdd(groupFetches, fetchCount);
    barrier();
    int start = int(gl_WorkGroupID.x * gl_WorkGroupSize.x);
    int inside = min(int(gl_WorkGroupSize.x), imageSize(resultImage).{} - start);
    value = vec4(float(groupFetches) / float(inside));
)";

std::string mainOf(const Settings& settings, const Pass& pass, int level, Writes writes) {
    std::string call = fmt::format("vec4 value = {}{}{}(pixel{});\n", pass.name,
                                   widened(settings, pass) ? "Wide" : "", level > 0 ? "Level" : "",
                                   pass.layers > 1              ? ", layer"
                                   : pass.stage == Stage::splat ? ", sphere"
                                   : pass.stage == Stage::boxes ? ", Occluder(a, b, c)"
                                                                : "");
    if (writes == Writes::fetches) {
        call += computes(pass) ? fmt::format(groupShare, pass.stage == Stage::rows ? "x" : "y")
                               : "    value = vec4(float(fetchCount));\n";
    } else if (enabledPasses(settings).back() == &pass) {
        call += settings.has("intensity") ? "    value.r = finalVisibility(value.r);\n"
                                          : "    value.r = clamp(value.r, 0.0, 1.0);\n";
    }
    if (computes(pass)) {
        // Groups of columns lie along x too: llvmpipe fills its vectors from x alone.
        return fmt::format(
            "{}layout(local_size_x = {}) in;\n"
            "layout(binding = 0, {}) uniform writeonly image2D resultImage;\n"
            "void main() {{\n    ivec2 pixel = ivec2(gl_GlobalInvocationID.{});\n"
            "    {}"
            "    if (all(lessThan(pixel, imageSize(resultImage))))\n"
            "        imageStore(resultImage, pixel, value);\n}}\n",
            writes == Writes::fetches ? "shared int groupFetches;\n" : "", group,
            gl::glslName(writes == Writes::fetches ? gl::Format::r32f : formatOf(settings, pass)),
            pass.stage == Stage::rows ? "xy" : "yx", call);
    }
    return fmt::format("{}{}layout(location = 0) out vec4 result;\nvoid main() {{\n    ivec2 pixel "
                       "= ivec2(gl_FragCoord.xy);\n    {}    result = value;\n}}\n",
                       pass.layers > 1 ? "uniform int layer;\n" : "",
                       pass.stage == Stage::splat   ? "flat in vec4 sphere;\n"
                       : pass.stage == Stage::boxes ? "flat in vec4 a, b, c;\n"
                                                    : "",
                       call);
}

} // namespace

std::vector<const Pass*> enabledPasses(const Settings& settings) {
    std::vector<const Pass*> result;
    for (const Pass& pass : settings.technique().passes)
        if (enabled(settings, pass))
            result.push_back(&pass);
    return result;
}

gl::Format formatOf(const Settings& settings, const Pass& pass) {
    return widened(settings, pass) ? gl::Format::rgba16f : pass.format;
}

gl::ShaderText passShader(const Settings& settings, const Pass& pass, int level, Writes writes) {
    const Technique& technique = settings.technique();
    gl::ShaderText text;
    declareBlocks(text, settings);
    text.add(declareInputs(settings), "(generated declarations)");
    if (writes == Writes::fetches)
        text.add(countingFetches, "(generated counter)");
    if (technique.reads & light)
        text.addFile(shaderFolder(), "environment.glsl");
    text.addFile(shaderFolder(), pass.file.empty() ? fmt::format("ao/{}.glsl", technique.id)
                                                   : std::string(pass.file));
    text.add(mainOf(settings, pass, level, writes), "(generated main)");
    return text;
}

bool drawsObjects(const Pass& pass) {
    return pass.stage == Stage::splat || pass.stage == Stage::boxes;
}

gl::ShaderText objectShader(const Settings& settings, const Pass& pass) {
    gl::ShaderText text;
    declareBlocks(text, settings);
    text.addFile(shaderFolder(), pass.stage == Stage::splat ? "splat.vert" : "box.vert");
    return text;
}

gl::Program passProgram(const Settings& settings, const Pass& pass, int level, Writes writes) {
    const gl::ShaderText text = passShader(settings, pass, level, writes);
    const std::string label =
        fmt::format("{} {}{}{}", settings.technique().id, pass.name, level > 0 ? " levels" : "",
                    writes == Writes::fetches ? " fetches" : "");
    if (computes(pass))
        return gl::Program(label, text);
    return gl::Program(
        label, drawsObjects(pass) ? objectShader(settings, pass) : shaderText("screen.vert"), text);
}

namespace {

// Visibility alone, or light beside it.
int resultChannels(const Settings& settings) {
    return gl::channelsOf(formatOf(settings, *enabledPasses(settings).back())) == 4 ? 4 : 1;
}

} // namespace

double occlusionBytes(const Settings& settings, int width, int height) {
    const int factor = downscaleOf(settings);
    const auto smaller = [](int size, int scale) { return (size + scale - 1) / scale; };
    double bytes = 1.0 * smaller(width, factor) * smaller(height, factor) *
                   FurtherLayers::bytesPerPixel(furtherLayers(settings));
    for (const Pass* pass : enabledPasses(settings)) {
        const int across = smaller(smaller(width, factor), pass->scale),
                  down = smaller(smaller(height, factor), pass->scale);
        for (int level = 0; level < pass->levels; ++level)
            bytes += 1.0 * std::max(across >> level, 1) * std::max(down >> level, 1) *
                     pass->layers * gl::bytesOf(formatOf(settings, *pass));
    }
    if (settings.technique().reads & traced)
        bytes += 1.0 * width * height * gl::bytesOf(gl::Format::r32f);
    if (factor > 1) {
        const double normal =
            settings.technique().reads & normals ? bytesOf(gl::Format::rgba16f) : 0;
        bytes +=
            1.0 * smaller(width, factor) * smaller(height, factor) *
                (bytesOf(gl::Format::r32f) + normal) +
            1.0 * width * height * bytesOf(formatOf(settings, *enabledPasses(settings).back()));
    }
    if (accumulatedFrames(settings) > 1)
        bytes += 1.0 * width * height * Accumulation::bytes(resultChannels(settings));
    return bytes;
}

std::optional<Normals> normalsFor(const Technique& technique, Normals kind) {
    return technique.reads & normals ? std::optional(kind) : std::nullopt;
}

int downscaleOf(const Settings& settings) {
    return settings.has("downscale") ? static_cast<int>(settings["downscale"]) : 1;
}

int accumulatedFrames(const Settings& settings) {
    return settings.has("accumulate") ? static_cast<int>(settings["accumulate"]) : 1;
}

int guardPixels(const Settings& settings, int height) {
    return settings.has("guardBand")
               ? static_cast<int>(std::ceil(settings["guardBand"] * static_cast<float>(height)))
               : 0;
}

namespace {

// `width` and `height` are those that the technique works on.
gl::SlicedTarget targetOf(const Settings& settings, const Pass& pass, int width, int height) {
    const auto scaled = [&](int size) { return (size + pass.scale - 1) / pass.scale; };
    return gl::SlicedTarget(scaled(width), scaled(height), formatOf(settings, pass),
                            {pass.levels, pass.layers, pass.scale > 1},
                            fmt::format("{} {}", settings.technique().id, pass.name));
}

} // namespace

OcclusionPasses::OcclusionPasses(const Settings& settings, int width, int height)
    : layers_(furtherLayers(settings), 1, 1), settings_(settings), block_(settingsBlock(settings)),
      open_(gl::constantTexture({1, 1, 1, 1})) {
    const Technique& technique = settings.technique();
    if (const int frames = accumulatedFrames(settings); frames > 1)
        accumulation_.emplace(frames, resultChannels(settings), width, height);
    if (const int factor = downscaleOf(settings); factor > 1) {
        if (gl::channelsOf(formatOf(settings, *enabledPasses(settings).back())) == 4)
            throw Error(fmt::format("expected downscale = 1 where {} sends light (four channels "
                                    "are not upsampled), found {}",
                                    technique.id, factor));
        reduction_.emplace(factor, technique.reads & normals, width, height,
                           formatOf(settings, *enabledPasses(settings).back()));
        width = reduction_->width();
        height = reduction_->height();
    }
    layers_.resize(width, height);
    int unit = resultUnit;
    for (const Pass& pass : technique.passes) {
        const int own = unit++;
        if (!enabled(settings, pass))
            continue;
        std::optional<gl::Program> levels;
        if (pass.levels > 1)
            levels = passProgram(settings, pass, 1);
        steps_.push_back({&pass, passProgram(settings, pass), std::move(levels),
                          targetOf(settings, pass, width, height), own});
    }
    points_ = pointsOf(settings);
}

void OcclusionPasses::resize(int width, int height) {
    if (accumulation_)
        accumulation_->resize(width, height);
    if (reduction_) {
        reduction_->resize(width, height);
        width = reduction_->width();
        height = reduction_->height();
    }
    layers_.resize(width, height);
    for (Step& step : steps_)
        step.target = targetOf(settings_, *step.pass, width, height);
}

void OcclusionPasses::set(const Settings& settings) {
    assert(&settings.technique() == &settings_.technique() && wholeAlike(settings, settings_));
    if (settings.values() == settings_.values())
        return;
    settings_ = settings;
    block_ = settingsBlock(settings);
    points_ = pointsOf(settings);
    forget();
}

// In the frame that the passes work in.
void OcclusionPasses::drawLayers(const OcclusionInputs& inputs) const {
    layers_.draw(inputs.peel,
                 reduction_ ? reducedFrame(inputs.frame, downscaleOf(settings_)) : inputs.frame,
                 reduction_ ? reduction_->depth() : inputs.gbuffer.depth(),
                 layerSeparation * settings_["radius"]);
}

// What has yet to be drawn, light, is drawn first, for that binds other things at the same places.
void OcclusionPasses::bindInputs(const OcclusionInputs& inputs) const {
    const unsigned reads = settings_.technique().reads;
    const auto lit = reads & light ? std::optional(inputs.light()) : std::nullopt;
    if (reads & traced)
        gl::bindTexture(tracedUnit,
                        inputs.traced(inputs.gbuffer, inputs.frame,
                                      settings_["radius"] * settings_["radiusMultiplier"],
                                      static_cast<int>(settings_["rays"])));
    block_.bind(settingsBinding);
    if (points_)
        points_->bind(pointsBinding);
    gl::bindTexture(depthUnit, inputs.gbuffer.depth());
    if (inputs.gbuffer.occlusionNormal())
        gl::bindTexture(normalUnit, *inputs.gbuffer.occlusionNormal());
    if (reduction_) {
        gl::bindTexture(depthUnit, reduction_->depth());
        if (reduction_->normals())
            gl::bindTexture(normalUnit, *reduction_->normals());
    }
    if (lit) {
        gl::bindTexture(albedoUnit, inputs.gbuffer.albedo());
        gl::bindTexture(ambientUnit, lit->buffers.ambient());
        gl::bindTexture(directUnit, lit->buffers.direct());
        lit->lighting.environment().bind(environmentBinding);
    }
    if (reads & spheres)
        inputs.spheres().bind(spheresBinding);
    for (int further = 0; further < layers_.count(); ++further)
        gl::bindTexture(layerUnit(settings_.technique(), further), layers_.depth(further));
    if (reads & triangles)
        inputs.occluders->triangles().bind(occludersBinding);
    if (reads & voxels)
        inputs.occluders->voxels(settings_["radius"] / settings_["voxels"])
            .bind(voxelsUnit, voxelsBinding);
    if (reads & tree)
        inputs.tree().bind(treeBinding);
}

void drawPass(const Pass& pass, const gl::Program& program, const gl::SlicedTarget& target,
              const gl::ScreenTriangle& triangle, const OcclusionInputs& inputs) {
    program.use();
    if (computes(pass)) {
        const bool rows = pass.stage == Stage::rows;
        const int length = rows ? target.width() : target.height();
        target.bindImage(0);
        gl::compute((length + group - 1) / group, rows ? target.height() : target.width());
        return;
    }
    gl::State state;
    state.add = drawsObjects(pass);
    state.cullBack = pass.stage == Stage::boxes;
    state.apply();
    for (int layer = 0; layer < target.slices().layers; ++layer) {
        target.bind(0, layer);
        if (target.slices().layers > 1)
            program.set("layer", layer);
        if (state.add) {
            target.clear();
            if (pass.stage == Stage::splat)
                triangle.drawQuads(inputs.spheres().count());
            else
                triangle.drawBoxes(inputs.occluders->triangles().count());
        } else {
            triangle.draw();
        }
    }
}

void OcclusionPasses::run(const Step& step, const OcclusionInputs& inputs) const {
    const gl::SlicedTarget& target = step.target;
    drawPass(*step.pass, step.program, target, triangle_, inputs);
    if (target.slices().levels == 1)
        return;
    step.levelProgram->use();
    gl::bindTexture(step.unit, target.texture());
    for (int level = 1; level < target.slices().levels; ++level) {
        target.bind(level, 0);
        triangle_.draw();
    }
    target.readAll();
}

const gl::Texture& OcclusionPasses::oneFrame(const OcclusionInputs& inputs,
                                             const PassObserver& issued) const {
    const auto tell = [&](const Pass& pass) {
        if (issued)
            issued(pass);
    };
    if (reduction_) {
        reduction_->reduce(inputs.gbuffer, inputs.frame);
        tell(Reduction::reducePass);
    }
    if (layers_.count() > 0) {
        drawLayers(inputs);
        tell(FurtherLayers::pass);
    }
    bindInputs(inputs);
    for (const Step& step : steps_) {
        run(step, inputs);
        gl::bindTexture(step.unit, step.target.texture());
        tell(*step.pass);
    }
    const gl::Texture& result = steps_.empty() ? open_ : steps_.back().target.texture();
    if (!reduction_)
        return result;
    const gl::Texture& full = reduction_->upsample(result, inputs.gbuffer);
    tell(Reduction::upsamplePass);
    return full;
}

const gl::Texture& OcclusionPasses::visibility(const OcclusionInputs& inputs) const {
    forget();
    for (int frame = 1; frame < accumulatedFrames(settings_); ++frame)
        next(inputs);
    return next(inputs);
}

const gl::Texture& OcclusionPasses::next(const OcclusionInputs& inputs,
                                         const PassObserver& issued) const {
    if (!accumulation_)
        return oneFrame(inputs, issued);
    OcclusionInputs cycled = inputs;
    cycled.frame.seed.y = accumulation_->frame();
    cycledFrame_.emplace(frameBuffer(cycled.frame));
    bindFrame(*cycledFrame_);
    const gl::Texture& result =
        accumulation_->add(oneFrame(cycled, issued), inputs.gbuffer, cycled.frame);
    if (issued)
        issued(Accumulation::pass);
    return result;
}

void OcclusionPasses::forget() const {
    if (accumulation_)
        accumulation_->forget();
}

bool OcclusionPasses::sendsLight() const {
    return !steps_.empty() && gl::channelsOf(steps_.back().target.format()) == 4;
}

const gl::SlicedTarget& OcclusionPasses::result(std::string_view pass) const {
    const auto found = std::find_if(steps_.begin(), steps_.end(),
                                    [&](const Step& step) { return step.pass->name == pass; });
    assert(found != steps_.end() && "no such pass, or it is switched off");
    return found->target;
}

} // namespace obscura
