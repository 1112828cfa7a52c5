#include "renderer/techniques/pass_shaders.h"

#include "renderer/frame/gbuffer.h"

#include <fmt/format.h>

namespace obscura {

using namespace bindings;

namespace {

bool widened(const Settings& settings, const Pass& pass) {
    return !pass.widenedBy.empty() && settings[pass.widenedBy] > 0;
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
    const bool uniform = kindOfPoints(points) == gl::UniformBuffer::Kind::uniform;
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
            writes == Writes::fetches ? "shared int groupFetches;\n" : "", computeGroup,
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

bool isEnabled(const Settings& settings, const Pass& pass) {
    return pass.enabledBy.empty() || settings[pass.enabledBy] >= static_cast<float>(pass.from);
}

int bindings::layerUnit(const Technique& technique, int further) {
    return resultUnit + static_cast<int>(technique.passes.size()) + further;
}

bool computes(const Pass& pass) {
    return pass.stage == Stage::rows || pass.stage == Stage::columns;
}

gl::UniformBuffer::Kind kindOfPoints(std::span<const glm::vec4> points) {
    return points.size_bytes() <= 16384 ? gl::UniformBuffer::Kind::uniform
                                        : gl::UniformBuffer::Kind::storage;
}

std::vector<const Pass*> enabledPasses(const Settings& settings) {
    std::vector<const Pass*> result;
    for (const Pass& pass : settings.technique().passes)
        if (isEnabled(settings, pass))
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

} // namespace obscura
