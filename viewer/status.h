#pragma once

#include "renderer/framing.h"
#include "renderer/scene/scene.h"
#include "viewer/picture.h"

#include <limits>
#include <string>
#include <vector>

namespace obscura {

// A scene that is ready, and a view that shows it.
struct Opened {
    SceneId id = 0;
    SceneChoice choice;
    std::string sha256;
    Bounds bounds;
    std::size_t triangles = 0;
    std::vector<NamedCamera> cameras;  // the file's own
    std::vector<std::string> warnings; // what it has and we do not show
    Camera camera;                     // of a view that shows the scene, `near` set
    double radius = 0.5;               // metres, suggested
    bool inside = false;               // the camera stands in a room
    std::string why;                   // a sentence: how the view was found
    double seconds = 0;                // that opening took
    Framing framing;                   // of which camera, radius, inside and why are, for fitted()
};

// What the worker is at, for people.
struct Status {
    enum class Doing { nothing, loading, compiling, drawing, tracing } doing = Doing::nothing;
    std::string what; // "sponza.gltf: decoding", "GTAO", "32 of 1024 rays": "" while drawing
    double share = 0; // done, 0 ... 1
    double secondsLeft = std::numeric_limits<double>::quiet_NaN(); // NaN: not known
    // The last thing that went wrong since the last success of its kind (opening, drawing,
    // tracing), in words for the user; "" for nothing.
    std::string error;
    bool loading = false; // a scene is being opened, whatever else goes on
    SceneId opened = 0;   // the newest scene that is ready
    int rays = 0;         // a pixel of the reference so far
};

} // namespace obscura
