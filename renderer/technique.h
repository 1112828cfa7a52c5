#pragma once

#include "renderer/gl/target.h"

#include <glm/glm.hpp>

#include <span>
#include <string_view>
#include <vector>

namespace obscura {

// What a row of the technique table says. Command line, protocol checks, manifest, shader
// assembly and tests all read it from there; nothing about a technique stands anywhere else but in
// its shader.

enum class Unit {
    metre, // of the scene
    ratio, // of the thing that the meaning names
    count, // whole number
    flag   // 0 or 1
};

struct Parameter {
    std::string_view name;
    Unit unit;
    std::string_view meaning;
    float value, low, high; // default and range, both ends included
};

// One screen-sized pass: the function of this name in the technique's shader, vec4 name(ivec2
// pixel). Later passes read its output from a sampler called nameResult.
struct Pass {
    std::string_view name;
    gl::Format format;
    std::string_view enabledBy = {}; // a flag parameter; 0 leaves the pass out
};

// A set of sample points that the shader reads as points[i], made once per setting of its count.
using PointSet = std::vector<glm::vec4> (*)(int count);

struct Technique {
    std::string_view id;
    std::string_view title;
    std::string_view citation;
    bool normals; // reads the G-buffer's normals, not depth alone
    PointSet points;
    std::span<const Parameter> parameters;
    // The last pass gives visibility in red: 1 open, 0 blocked. No passes: everything is open.
    std::span<const Pass> passes;
};

std::span<const Technique> techniques();

// An unknown id is an Error that gives the nearest.
const Technique& technique(std::string_view id);

// What static_assert holds the table to: unique ids, a citation, defaults inside ranges, flags and
// counts whole, passes enabled by flags that exist.
constexpr bool wellFormed(const Parameter& parameter) {
    const bool whole = parameter.unit == Unit::count || parameter.unit == Unit::flag;
    const bool inside = parameter.low <= parameter.value && parameter.value <= parameter.high;
    return !parameter.name.empty() && !parameter.meaning.empty() && inside &&
           (!whole || parameter.value == static_cast<float>(static_cast<int>(parameter.value)));
}

constexpr bool wellFormed(const Technique& technique) {
    for (const Parameter& parameter : technique.parameters)
        if (!wellFormed(parameter))
            return false;
    for (const Pass& pass : technique.passes) {
        bool found = pass.enabledBy.empty();
        for (const Parameter& parameter : technique.parameters)
            found |= parameter.name == pass.enabledBy && parameter.unit == Unit::flag;
        if (!found)
            return false;
    }
    return !technique.id.empty() && !technique.title.empty() && !technique.citation.empty();
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
