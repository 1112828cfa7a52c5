#include "renderer/ao.h"

#include <fmt/format.h>

namespace obscura {

namespace {

// Binding points of a pass's shader.
constexpr int settingsBinding = 1, pointsBinding = 2;        // blocks; the frame is 0
constexpr int depthUnit = 0, normalUnit = 1, resultUnit = 2; // samplers; later results follow

bool enabled(const Settings& settings, const Pass& pass) {
    return pass.enabledBy.empty() || settings[pass.enabledBy] != 0;
}

// Consecutive scalars lie in consecutive four-byte slots of std140, so the values upload as they
// are, rounded up to sixteen bytes.
gl::UniformBuffer settingsBlock(const Settings& settings) {
    std::vector<float> values = settings.values();
    values.resize((values.size() + 4) / 4 * 4);
    return gl::UniformBuffer(std::as_bytes(std::span(values)));
}

std::string declareInputs(const Technique& technique) {
    std::string text = fmt::format("layout(std140, binding = 0) uniform FrameBlock {{ Frame frame; "
                                   "}};\nlayout(std140, binding = {}) uniform SettingsBlock {{\n",
                                   settingsBinding);
    for (const Parameter& parameter : technique.parameters)
        text += fmt::format("    float {};\n", parameter.name);
    text += "} settings;\n";
    text += fmt::format("layout(binding = {}) uniform sampler2D depthBuffer;\n", depthUnit);
    if (technique.normals)
        text += fmt::format("layout(binding = {}) uniform sampler2D normalBuffer;\n", normalUnit);
    if (technique.points)
        text += fmt::format("layout(std430, binding = {}) readonly buffer PointBlock {{ vec4 "
                            "points[]; }};\n",
                            pointsBinding);
    // Every pass's, for a file's other functions must compile too.
    int unit = resultUnit;
    for (const Pass& pass : technique.passes)
        text +=
            fmt::format("layout(binding = {}) uniform sampler2D {}Result;\n", unit++, pass.name);
    return text;
}

} // namespace

gl::ShaderText passShader(const Technique& technique, const Pass& pass) {
    gl::ShaderText text;
    text.addFile(shaderFolder(), "frame.h");
    text.add(declareInputs(technique), "(generated declarations)");
    text.addFile(shaderFolder(), fmt::format("ao/{}.glsl", technique.id));
    text.add(fmt::format("layout(location = 0) out vec4 result;\n"
                         "void main() {{ result = {}(ivec2(gl_FragCoord.xy)); }}\n",
                         pass.name),
             "(generated main)");
    return text;
}

OcclusionPasses::OcclusionPasses(const Settings& settings, int width, int height)
    : settings_(settingsBlock(settings)), open_(gl::constantTexture({1, 1, 1, 1})) {
    const Technique& technique = settings.technique();
    int unit = resultUnit;
    for (const Pass& pass : technique.passes) {
        const int own = unit++;
        if (!enabled(settings, pass))
            continue;
        const std::string label = fmt::format("{} {}", technique.id, pass.name);
        steps_.push_back(
            {gl::Program(label, shaderText("screen.vert"), passShader(technique, pass)),
             gl::Target(width, height, std::array{pass.format}, false, label), own});
    }
    if (technique.points) {
        const std::vector<glm::vec4> points =
            technique.points(static_cast<int>(settings["samples"]));
        points_.emplace(std::as_bytes(std::span(points)), gl::UniformBuffer::Kind::storage);
    }
}

const gl::Texture& OcclusionPasses::visibility(const GBuffer& gbuffer) const {
    settings_.bind(settingsBinding);
    if (points_)
        points_->bind(pointsBinding);
    gl::bindTexture(depthUnit, gbuffer.depth());
    if (gbuffer.normal())
        gl::bindTexture(normalUnit, *gbuffer.normal());
    gl::State{}.apply();
    for (const Step& step : steps_) {
        step.target.bind();
        step.program.use();
        triangle_.draw();
        gl::bindTexture(step.unit, step.target.colour(0));
    }
    return steps_.empty() ? open_ : steps_.back().target.colour(0);
}

} // namespace obscura
