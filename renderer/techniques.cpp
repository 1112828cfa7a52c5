#include "protocols/error.h"
#include "renderer/technique.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

namespace obscura {

namespace {

using gl::Format;

// `count` points spread evenly over the volume of the unit ball, so that their lengths vary as the
// thesis wants: the R3 sequence (Roberts 2018), which has no clumps at 8 points and converges at
// 4096. xyz is the point.
std::vector<glm::vec4> ballPoints(int count) {
    constexpr double root = 1.2207440846057596; // of x^4 = x + 1
    std::vector<glm::vec4> points;
    for (int i = 0; i < count; ++i) {
        const auto coordinate = [&](double power) {
            const double value = 0.5 + (i + 1) / std::pow(root, power);
            return value - std::floor(value);
        };
        const double z = 2 * coordinate(1) - 1, angle = 2 * std::numbers::pi * coordinate(2);
        const double length = std::cbrt(coordinate(3)), flat = std::sqrt(1 - z * z);
        points.emplace_back(length * flat * std::cos(angle), length * flat * std::sin(angle),
                            length * z, 0);
    }
    return points;
}

constexpr Parameter radius{"radius", Unit::metre, "how far occluders are looked for",
                           0.5f,     1e-4f,       1e4f};
constexpr Parameter blur{"blur", Unit::flag, "edge-aware blur over the 4 x 4 noise tile", 1, 0, 1};

constexpr Parameter samples(float value, std::string_view meaning = "points tested per pixel") {
    return {"samples", Unit::count, meaning, value, 1, 16384};
}

constexpr Pass gatherAndBlur[] = {
    {"gather", Format::r16f},
    {"blurTile", Format::r16f, "blur"},
};

constexpr Parameter crytekParameters[] = {
    samples(24, "points tested per pixel; whole cubes of eight"),
    radius,
    {"range", Unit::ratio,
     "depth difference, in radii, at which a nearer surface has faded to neutral; the thesis' "
     "normalised depth makes this so large that it never engages",
     200, 0.01f, 1e6f},
    blur,
};

// The accessibility curve of appendix B, with lengths in radii instead of the appendix's scene
// units, so that one setting serves scenes of any size.
constexpr Parameter fullOcclusion{
    "fullOcclusion",
    Unit::ratio,
    "depth difference, in radii, below which a surface in front of the pixel is ignored",
    0.02f,
    0,
    10};
constexpr Parameter noOcclusion{
    "noOcclusion",
    Unit::ratio,
    "depth difference, in radii, beyond which a surface in front of the pixel is ignored",
    1.5f,
    0.01f,
    100};
constexpr Parameter attenuation{
    "attenuation",
    Unit::ratio,
    "depth difference, in radii, at which accessibility is one half, before the power",
    0.35f,
    1e-3f,
    1e3f};
constexpr Parameter power{"power", Unit::ratio, "exponent of accessibility", 2, 0.01f, 64};

constexpr Parameter blizzardParameters[] = {samples(24), radius, fullOcclusion, noOcclusion,
                                            attenuation, power,  blur};

constexpr Parameter blizzardCorrectedParameters[] = {
    samples(24),
    radius,
    {"fullUntil", Unit::ratio,
     "distance behind the surface, in radii, up to which a point counts as fully occluded", 1, 0,
     100},
    {"noneFrom", Unit::ratio,
     "distance behind the surface, in radii, from which a point counts as open again", 2, 0.01f,
     1000},
    {"bias", Unit::ratio, "distance behind the surface, in radii, that is ignored", 0.02f, 0, 1},
    blur};

constexpr Parameter rayMarchParameters[] = {
    samples(30, "directions per pixel"),
    radius,
    {"steps", Unit::count, "equal steps along each direction", 4, 1, 64},
    fullOcclusion,
    noOcclusion,
    attenuation,
    power,
    blur};

constexpr Technique table[] = {
    {"none", "No ambient occlusion", "the control condition", false, nullptr, {}, {}},
    {"crytek", "Crytek 2007",
     "Mittring 2007; Kajalin, ShaderX7 2009; as in Jakobsen 2010, appendix A", false, nullptr,
     crytekParameters, gatherAndBlur},
    {"blizzard", "Blizzard 2008",
     "Filion and McNaughton 2008; as printed in Jakobsen 2010, appendix B", true, ballPoints,
     blizzardParameters, gatherAndBlur},
    {"blizzard_corrected", "Blizzard 2008, corrected curve",
     "Filion and McNaughton 2008, their three rules for the occlusion curve", true, ballPoints,
     blizzardCorrectedParameters, gatherAndBlur},
    {"ray_march", "Ray-marching 2010", "Jakobsen 2010, section 4.3.3 and appendix C", true,
     ballPoints, rayMarchParameters, gatherAndBlur},
};
static_assert(wellFormed(table));

} // namespace

std::span<const Technique> techniques() { return table; }

const Technique& technique(std::string_view id) {
    std::vector<std::string> ids;
    for (const Technique& row : table) {
        if (row.id == id)
            return row;
        ids.emplace_back(row.id);
    }
    throw Error(
        fmt::format("expected the id of a technique, found \"{}\"{}", id, suggestion(id, ids)));
}

} // namespace obscura
