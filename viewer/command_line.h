#pragma once

#include "renderer/techniques/settings.h"
#include "viewer/panes.h"
#include "viewer/picture.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace obscura {

// What obscura-view is started with: what is to be seen, and what is to be done with it. A protocol
// brings all that its condition has; what is said beside it counts instead.
struct CommandLine {
    SceneChoice scene;                        // the built-in atrium unless said; a file exists
    std::filesystem::path scenes;             // folder of glTF scenes, as studies name them
    std::vector<TechniqueSetting> techniques; // of the panes, at most four; none said: `none`, gtao
    std::optional<Layout> layout;             // none said: as many panes as techniques
    Show show = Show::lit;
    Level level; // named; `environment` absolute or relative to the working folder
    Normals normals = Normals::smooth;
    std::optional<Camera> camera; // none said: one that shows the scene
    std::optional<double> radius; // metres; none said: one that suits the scene
    double exposure = 0;          // stops
    bool textures = true;
    bool reference = false;
    int rays = 64; // a pixel, that --picture waits for
    double renderScale = 1;
    int width = 1280, height = 720; // of the window; in a test, of the pictures
    double uiScale = 0;             // 0: the screen's
    std::string tab;                // the panel that is open; "": the first
    bool panels = true, help = false, times = false;
    std::filesystem::path picture; // the window is saved there, and the program ends; "": it stays

    std::filesystem::path protocol; // "": none
    std::vector<View> views;        // of the protocol: those of the scene, or, of a test for which
                                    // no condition was named, all

    bool test = false;
    int cameras = 4; // found in the scene, where nobody says which
    double seconds = 5;
    int rounds = 3;
    std::uint64_t seed = 1;
    std::filesystem::path out = "obscura-test";
    std::string device;
};

// Names of the panels that --tab opens.
const std::vector<std::string>& tabNames();

// Reads the options and the protocol; loads no scene. An Error says what is wrong; --help and
// mistakes of spelling end the program (base/program.h).
CommandLine parseCommandLine(CLI::App& app, int argc, char** argv);

} // namespace obscura
