#pragma once

#include "protocols/reader/study_text.h"
#include "renderer/techniques/settings.h"

#include <filesystem>
#include <string>
#include <vector>

namespace obscura {

// What is on the screen.
struct Seen {
    View view;   // its scene as a study names it (inScenesFolder()); `name`: what the camera is
                 // called, or ""
    Level level; // `environment`: absolute, or relative to the working folder
    Normals normals = Normals::smooth;
    bool textures = true;
    int width = 1280, height = 720; // of the panes' pictures
    std::vector<Settings> panes;    // two for a pair: its first member, its second
};

// A scene's file as a study names it: relative to the scenes folder where it lies in there, else
// absolute.
std::string inScenesFolder(const std::filesystem::path& file,
                           const std::filesystem::path& scenesFolder);

// The view with numbers that a person can read: the camera to a hundred-thousandth of the distance
// to its target, which there is less than a hundredth of a pixel of 720, the radius to four digits.
// What was rounded is not changed again.
View rounded(View view);

// All of it as tables that can be pasted into a protocol: [scenes.X], [levels.Y], and
// [techniques.Z] for each pane.
std::string tablesText(const Seen& seen);

// What studies call its parts, and how they spell them.
std::string sceneName(const View& view);   // "sponza-camera-1": the file, and the camera's name
std::string levelName(const Level& level); // "light" where it has none
std::string studyName(const std::filesystem::path& file);
TomlFields techniqueFields(const TechniqueSetting& setting);
// The level as a study in `folder` names its environment.
Level levelIn(const std::filesystem::path& folder, Level level);
// A name that none of `taken` has: "gtao", "gtao-2", ...
std::string newName(const std::string& wish, const std::vector<std::string>& taken);

} // namespace obscura
