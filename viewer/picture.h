#pragma once

#include "gl/object.h"
#include "image/image.h"
#include "protocols/reader/display.h"
#include "protocols/reader/study.h"
#include "renderer/reference/trace_settings.h"
#include "renderer/techniques/settings.h"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

// What the viewer asks to be drawn (Wanted), and what came of it (Drawn). Plain values: whoever has
// one may read it on any thread.

// Names one opening of a scene (viewer/worker.h); opening the same file again gives another. 0:
// none.
using SceneId = std::uint64_t;

struct SceneChoice {
    std::string file;    // glTF; absolute, or relative to the working folder; or empty, and then
    std::string builtin; // a name of builtinSceneNames()
    std::optional<Ground> ground;
};

// What a pane shows of its technique.
enum class Show {
    lit,       // as a stimulus would show it, without anti-aliasing
    occlusion, // visibility as grey, by sRGB's transfer function, as stimuli keep it
    albedo,    // base colour
    normals,   // of the kind wanted, world space: red, green and blue are (n + 1) / 2
    depth,     // view depth, logarithmic from the scene's nearest to its farthest (depthColours)
    error,     // visibility of the reference minus the technique's (errorColours)
    jod        // where a person would see the error in the lit picture (jodColours)
};
const std::array<std::string, 7>& showNames(); // "lit", "occlusion", ...

struct Wanted {
    SceneId scene = 0;
    View view;   // camera, radius, exposure; the settings have radii of their own. The scene is
                 // `scene`
    Level level; // `environment`: absolute, or relative to the working folder
    Normals normals = Normals::smooth;
    bool textures = true;        // without them everything is white
    int width = 0, height = 0;   // of each pane's picture: the pane's pixels x render scale
    std::vector<Settings> panes; // one to four, each complete (its radius in metres)
    Show show = Show::lit;       // in all panes
    bool reference = false;      // trace one; `error` and `jod` imply it
    Integral integral = Integral::cosine; // of the reference, over view.radius
    Display display = displays().front(); // for predicted JOD
    bool difference = false;              // of panes 1 and 0 too
    double errorScale = 0.25; // the error, or difference, that has a colour map's last colour

    bool operator==(const Wanted&) const;
};

// A picture on the GPU, RGBA8, opaque, sRGB code values; rows from the bottom, as OpenGL has them
// (an ImGui image of it goes from uv (0, 1) to (1, 0)). Nearest filtering; gl::filterLinearly
// changes that. Its drawing has finished when it is handed out, and it is never drawn into again
// while somebody holds it; so keep it until the frame that shows it has been swapped. Any context
// of the share group can show it. It may be dropped on any thread, context or not.
struct SharedPicture {
    gl::Texture texture;
    int width = 0, height = 0;
    std::vector<std::byte> pixels = {}; // the same, RGBA; empty unless the worker copies
};

// What a picture shows, rows from the top, 3 channels. A context of the share group must be
// current, unless it has pixels.
Image8 imageOf(const SharedPicture& picture);

struct PassDrawn {
    std::string name; // as in the technique table; "reduce" and "upsample" where it is downscaled
    Work work = Work::gather;
    double ms = 0;
};

// How far a pane is from the reference as it was traced so far.
struct Quality {
    double rmse = 0; // of visibility, over pixels that show a surface
    double flip = 0; // mean FLIP of the lit pictures, over the same; the authors' observer
    double jod = 10; // predicted, of the whole lit pictures on the wanted display
    int rays = 0;    // a pixel, of the reference. With few, its own noise is part of the error
};

struct PaneDrawn {
    std::shared_ptr<const SharedPicture> picture;
    bool waits = false; // for a reference: until then `error` shows occlusion, and `jod` the lit
                        // picture; a ray-traced pane is open
    std::vector<PassDrawn> passes; // as they ran when the technique was last drawn
    double ms = 0;                 // of those passes together
    std::optional<Quality> quality;
    bool tracing = false; // the technique is the reference itself:
    int rays = 0;         // a pixel, traced of it so far
};

struct Drawn {
    Wanted wanted;
    std::vector<PaneDrawn> panes; // as many as wanted
    bool draft = false; // textures are blurred at grazing angles, as the camera moves on a software
                        // driver; a sharp picture follows once it rests
    // Pane 0's visibility minus pane 1's or, where lit pictures are shown, its luma (0 ... 1) minus
    // the other's (errorColours): blue where pane 1 is darker. Null unless wanted, and with one
    // pane.
    std::shared_ptr<const SharedPicture> difference;
    double gbufferMs = 0, lightMs = 0; // when they were last drawn
    double frameMs = 0;                // wall time from taking the wish to the finished pictures
    double intervalMs = 0; // since the picture before, where that led to this without a pause: FPS
    int referenceRays = 0; // a pixel, traced so far for `error`, `jod` and quality
    std::uint64_t number = 0; // counts the worker's pictures; another number, another picture
};

// Every buffer's value at one pixel of the panes' pictures.
struct Probed {
    int x = 0, y = 0;      // from the top left corner of the picture
    bool surface = false;  // the rest but for `lit` means something only where one is seen
    double depth = 0;      // along the view axis, metres
    glm::vec3 position{0}; // world space, metres
    std::optional<glm::vec3> normal; // unit, world space, of the kind wanted; where it was drawn
    std::optional<glm::vec3> albedo; // linear; where it was drawn
    struct Pass {
        std::string name;
        int channels = 1; // of value
        std::array<float, 4> value{};
    };
    struct Pane {
        double visibility = 1;
        std::optional<glm::vec3> lit; // sRGB code values, 0 ... 255; where it was drawn
        std::vector<Pass> passes; // what each left at the pixel, or at that of its smaller target
    };
    std::vector<Pane> panes;
    std::optional<double> reference; // visibility
    int referenceRays = 0;
};

// Maps of `size` colours, code values, each step equally visible (straight lines in Oklab), as the
// pictures have them: for legends. Error: from -errorScale (too bright; red) over 0 (near white) to
// +errorScale (too dark; blue). JOD: from no visible difference (black) to a predicted JOD of 7 or
// less (pale yellow). Depth: near (pale) to far (dark).
std::vector<std::array<std::uint8_t, 3>> errorColours(int size);
std::vector<std::array<std::uint8_t, 3>> jodColours(int size);
std::vector<std::array<std::uint8_t, 3>> depthColours(int size);

} // namespace obscura
