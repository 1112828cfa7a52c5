#pragma once

#include "base/error.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

// What studies of people (protocol.h) and of techniques (match.h) declare alike: scenes seen from a
// camera, lighting, techniques with settings. study_parts.h reads them.

using Vec3 = std::array<double, 3>;

struct Camera {
    Vec3 position{};        // metres of the scene, y up
    Vec3 target{};          // the point looked at; its distance is the focus distance
    Vec3 up{0, 1, 0};       //
    double fovDegrees = 50; // vertical, 1 ... 120
    double near = 0;        // metres; 0: as the scene's size wants it (nearPlane)

    bool operator==(const Camera&) const = default;
};

// What is wrong with it: "" for a camera that sees something. It must be finite, look somewhere
// other than straight along `up`, and its angle be below 180 degrees.
std::string faultOf(const Camera& camera);

// Metres: what radii a study may have.
constexpr double lowestRadius = 1e-4, highestRadius = 1e4;

// A floor at the lowest point of a scene and a wall behind it, so that what came alone has
// something to stand on and to shade. Both are matte and reach well beyond the scene.
struct Ground {
    double wall = 0;            // z of the wall, which faces +z; metres
    Vec3 colour{0.5, 0.5, 0.5}; // linear, of 1

    bool operator==(const Ground&) const = default;
};

// A scene seen from one camera.
struct View {
    std::string name;
    std::string file;    // glTF file, relative to the scenes folder; or empty, and then
    std::string builtin; // "sculpture", "atrium" or "figures"
    Camera camera;
    double radius = 0;   // metres, lowestRadius ... highestRadius: how far occlusion reaches, the
                         // same for every technique here
    double exposure = 0; // stops: light is scaled by 2^exposure before the display curve
    std::optional<Ground> ground;
    Place place;
};

// A sky of three colours, blended by elevation; radiance in scene units (1 = display white).
struct Sky {
    Vec3 zenith{0.25, 0.42, 0.75};
    Vec3 horizon{0.75, 0.82, 0.9};
    Vec3 ground{0.22, 0.2, 0.18};
};

struct Sun {
    double azimuthDegrees = 0;    // from +z towards +x
    double elevationDegrees = 45; // above the horizon, 0 ... 90
    Vec3 irradiance{3, 2.9, 2.7}; // on a surface that faces it
};

// How scene light becomes display light, after exposure (shaders/composite.frag has the sources).
enum class Curve { clamp, reinhard, aces, neutral };

// Their spellings, in the order of the enumeration.
const std::vector<std::string>& curveNames();

// Lighting of one complexity level (thesis 5.3). Exactly one of: constant ambient light on a plain
// background; a sky; an environment image. The sun may be added to any of them.
struct Level {
    std::string name;
    std::optional<Vec3> ambient; // constant light from everywhere
    Vec3 background{1, 1, 1};    // seen where no surface is; only with `ambient`
    std::optional<Sky> sky;
    std::string environment; // equirectangular HDR image, relative to the protocol's folder
    std::optional<Sun> sun;
    bool sceneLights = false;      // with the lights that the scene's file brings, unshadowed
    Curve curve = Curve::reinhard; // display curve
    double white = 4;              // the luminance that Reinhard's curve maps to display white
    bool occludeDirect = false;    // occlude the light of sun and scene as well
    Place place;
};

struct Setting {
    std::string name;
    double value = 0;
    Place place;
};

struct PresetName {
    std::string name;
    Place place;
};

// A technique with the settings that differ from its defaults, or from a preset of its authors',
// under a name of the study's own ("blizzard24"). The renderer checks all against its technique
// table.
struct TechniqueSetting {
    std::string name;
    std::string technique;
    std::vector<Setting> settings;
    Place place;
    std::optional<PresetName> preset = {};
};

// Which normal occlusion techniques and references work with: the triangle's own, the one
// interpolated between vertices, or that with the normal map applied. Lighting always has the last.
enum class Normals { face, smooth, mapped };

// Their spellings, in the order of the enumeration.
const std::vector<std::string>& normalsNames();

} // namespace obscura
