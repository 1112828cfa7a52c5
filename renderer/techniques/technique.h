#pragma once

#include "gl/target.h"

#include <glm/glm.hpp>

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace obscura {

// What a row of the technique table says. Command line, protocol checks, manifest, shader
// assembly, docs/techniques.md and tests all read it from there; the only other place that knows
// anything about a technique is its shader.

class Settings;

enum class Unit {
    metre,  // of the scene
    ratio,  // of the thing that the meaning names
    degree, //
    pixel,  //
    count,  // whole number
    flag    // 0 or 1
};

struct Parameter {
    std::string_view name;
    Unit unit;
    std::string_view meaning;
    float value, low, high;  // default and range, both ends included
    std::string_view source; // of the default: paper and section, program, or "ours: why"
    bool fitted = false;     // matching may move it, as it moves the radius multiplier
};

// How a pass is run. A function of the pass's name in the technique's shader gives each pixel's
// value; what differs is who calls it.
enum class Stage {
    screen,  // vec4 name(ivec2 pixel), drawn over the whole target
    rows,    // the same in a compute shader, in groups of 128 x 1 that may share memory. Called for
             // pixels right of the target too (their value is dropped), so that all reach barriers
    columns, // the same in groups of 1 x 128
    splat,   // vec4 name(ivec2 pixel, vec4 sphere), once per proxy sphere (view space) over the
             // pixels within `radius` x `distantReach` of it, all added up; its radius is the
             // fitted one x `sphereSize`
    boxes    // vec4 name(ivec2 pixel, Occluder triangle), once per triangle (corners in view space)
             // over the pixels behind which a box lies, all added up: the triangle's rectangle
             // along its longest side, grown by `radius` in its plane and to the side that it faces
};

// What a pass is for; benches sum times by it.
enum class Work {
    prepare, // levels and layers of depth, edges, what may be skipped
    gather,  // the occlusion estimate itself, and putting its parts together
    filter,  // blurs and denoisers
    upsample // from a reduced resolution to the full one
};
// "prepare", "gather", "filter", "upsample".
const std::array<std::string, 4>& workNames();

// A number of texture fetches (texelFetch, texture, textureLod and textureGather, each one; not
// image stores, buffers or shared memory) as the shader's text has them, whether or not a driver
// merges some.
using Fetches = double (*)(const Settings&);

// One pass. Later passes read its output from a sampler called nameResult.
struct Pass {
    std::string_view name;
    gl::Format format;
    std::string_view enabledBy = {}; // a flag or count; the pass runs where it is at least `from`
    int from = 1;
    std::string_view widenedBy = {}; // a flag; where it is set, nameWide(ivec2 pixel) is called in
                                     // the place of name and its target is rgba16f
    int scale = 1;  // its target has 1 / scale of the width and height, rounded up; pixels are the
                    // target's. Above 1, reading by texture() filters linearly
    int levels = 1; // of detail: the pass gives level 0; vec4 nameLevel(ivec2 pixel) gives each
                    // next one and finds the one before in level 0 of nameResult
    int layers =
        1; // above 1: vec4 name(ivec2 pixel, int layer), and nameResult is a sampler2DArray
    Stage stage = Stage::screen;
    Work work = Work::gather;
    std::string_view file = {}; // of the shader folder; without it ao/<id of technique>.glsl
    // The most that one pixel of the target makes: at level 0, and at each next level where the
    // pass has those. In rows and columns, its share of what a whole group makes away from the
    // border; as a splat or a box, for one of them. renderer/techniques/fetches.h counts them.
    Fetches fetches = nullptr;
    Fetches levelFetches = nullptr;
};

// What a technique reads besides depth; buffers that nobody reads do not exist.
enum Reads : unsigned {
    depthOnly = 0,
    normals = 1,    // normalBuffer: view space
    light = 2,      // albedoBuffer, ambientLight, directLight; environment.glsl
    spheres = 4,    // proxy spheres of the scene (renderer/scene/proxies.h)
    rays = 8,       // the triangles themselves: no passes, the reference gives visibility
    layers = 16,    // secondDepth, thirdDepth: of depth, where the count `layers` asks for them
    triangles = 32, // occluders (renderer/scene/occluders.h)
    voxels = 64,    // voxelOpacity, voxelPlace, voxelScale: sides are `radius`, before it is
                    // multiplied, / `voxels` (renderer/scene/voxels.h)
    traced = 128,   // tracedBuffer: visibility by `rays` rays a pixel
                    // (renderer/reference/few_rays.h)
    tree = 256      // the triangles in a tree (renderer/frame/triangle_buffers.h): tree.glsl
};

// Settings that a technique's authors offer together under one name ("high"). The radius is never
// among them, because it belongs to the scene.
struct PresetValue {
    std::string_view name;
    float value;
};
struct Preset {
    std::string_view name;
    std::span<const PresetValue> values;
};

// A set of sample points that the shader reads as points[i], made once per settings.
using PointSet = std::vector<glm::vec4> (*)(const Settings&);

struct Technique {
    std::string_view id;
    std::string_view title;
    std::string_view citation;
    unsigned reads; // of Reads
    PointSet points;
    std::span<const Parameter> parameters;
    // The last enabled pass gives visibility in red: 1 open, 0 blocked. Where its format has four
    // channels, the others are light that the pixel sends to the camera besides its ambient light
    // times visibility: bounced, or redistributed. No passes: everything is open.
    std::span<const Pass> passes;
    std::span<const Preset> presets = {};
};

// Parameters that mean the same in every technique that has them, so the table's users need not
// know the technique: `radius` (metres) is multiplied by `radiusMultiplier` before the shader sees
// it; the last pass's visibility v becomes max(0, 1 - intensity (1 - v))^power or, where the power
// is below 0, (1 + intensity (1 - v))^power, clamped to [0, 1]. As the power grows to either side,
// both tend to exp(-intensity |power| (1 - v)), so that no end of the one is one of all curves.
// Matching (matching/match.h) fits the latter three, and what a row says is `fitted`. `guardBand`
// is the share of the image's height that is rendered beyond each of its borders for the
// technique's eyes only. `layers` is how many layers of depth it reads
// (renderer/techniques/further_layers.h). `downscale` runs all passes on every nth pixel and
// spreads the result back (renderer/techniques/reduction.h); what sends light cannot. `accumulate`
// is for techniques with noise: the picture is a mean of up to so many frames
// (renderer/techniques/accumulation.h).

std::span<const Technique> techniques();

// An unknown id is an Error that gives the nearest.
const Technique& technique(std::string_view id);

// What static_assert holds the table to: unique ids, a citation, defaults inside ranges, flags and
// counts whole, passes enabled by parameters that exist and with their fetches declared, presets
// that could be set.
constexpr bool isWhole(const Parameter& parameter) {
    return parameter.unit == Unit::count || parameter.unit == Unit::flag;
}

constexpr bool takes(const Parameter& parameter, float value) {
    return parameter.low <= value && value <= parameter.high &&
           (!isWhole(parameter) || value == static_cast<float>(static_cast<int>(value)));
}

constexpr bool wellFormed(const Parameter& parameter) {
    return !parameter.name.empty() && !parameter.meaning.empty() && !parameter.source.empty() &&
           takes(parameter, parameter.value) &&
           (!parameter.fitted || (!isWhole(parameter) && parameter.value > 0));
}

constexpr bool wellFormed(const Preset& preset, std::span<const Parameter> parameters) {
    for (const PresetValue& value : preset.values) {
        bool found = false;
        for (const Parameter& parameter : parameters)
            found |= parameter.name == value.name && takes(parameter, value.value);
        if (!found || value.name == "radius")
            return false;
    }
    return !preset.name.empty();
}

constexpr bool wellFormed(const Pass& pass, std::span<const Parameter> parameters) {
    const auto known = [&](std::string_view name) {
        bool found = name.empty();
        for (const Parameter& parameter : parameters)
            found |= parameter.name == name && isWhole(parameter);
        return found;
    };
    const bool compute = pass.stage == Stage::rows || pass.stage == Stage::columns;
    const bool single = pass.levels == 1 && pass.layers == 1;
    const bool counted = pass.fetches && (pass.levels > 1) == (pass.levelFetches != nullptr);
    return known(pass.enabledBy) && known(pass.widenedBy) && counted && pass.scale >= 1 &&
           pass.levels >= 1 && pass.layers >= 1 && (single || !compute);
}

constexpr bool wellFormed(const Technique& technique) {
    for (std::size_t i = 0; i < technique.parameters.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j)
            if (technique.parameters[i].name == technique.parameters[j].name)
                return false;
        if (!wellFormed(technique.parameters[i]))
            return false;
    }
    for (const Pass& pass : technique.passes)
        if (!wellFormed(pass, technique.parameters))
            return false;
    for (std::size_t i = 0; i < technique.presets.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j)
            if (technique.presets[i].name == technique.presets[j].name)
                return false;
        if (!wellFormed(technique.presets[i], technique.parameters))
            return false;
    }
    // Five samplers are inputs, some techniques read more, and a shader has sixteen.
    const unsigned reads = technique.reads;
    const std::size_t inputs =
        5u + (reads & layers ? 2u : 0u) + (reads & voxels ? 1u : 0u) + (reads & traced ? 1u : 0u);
    return technique.passes.size() + inputs <= 16 && !technique.id.empty() &&
           !technique.title.empty() && !technique.citation.empty();
}

constexpr bool wellFormed(std::span<const Technique> table) {
    for (std::size_t i = 0; i < table.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j)
            if (table[i].id == table[j].id)
                return false;
        if (!wellFormed(table[i]))
            return false;
    }
    return true;
}

} // namespace obscura
