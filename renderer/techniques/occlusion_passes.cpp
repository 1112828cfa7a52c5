#include "renderer/techniques/occlusion_passes.h"

#include "base/error.h"
#include "renderer/techniques/pass_shaders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace obscura {

using namespace bindings;

namespace {

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
    return gl::UniformBuffer(std::as_bytes(std::span(points)), kindOfPoints(points));
}

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
        if (!isEnabled(settings, pass))
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
        gl::compute((length + computeGroup - 1) / computeGroup,
                    rows ? target.height() : target.width());
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
