#pragma once

#include "renderer/scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace obscura {

// The views of one scene that a person goes through: the one that was found for it, those of the
// file's own cameras, and those that he stored.
//
// Stored ones are kept in a folder that is ours alone and not beside the scene, whose folder may be
// read-only, shared or under version control: one file for each scene, of the form of a study's
// [scenes], so that they can be copied into a protocol (protocols/reader/views_file.h). It is named
// after the scene and where that lies ("Sponza.gltf-1f0c2a9b.toml"; "atrium.toml", where it is
// built in) and says which scene it is of. A scene that is moved leaves its views behind: name the
// new place in the file, and rename it as an error says.

// $XDG_CONFIG_HOME/obscura/views; ~/.config/obscura/views where that is not set or not absolute
// (XDG Base Directory Specification 0.8). An Error where there is no home either. Not created.
std::filesystem::path viewsFolder();

// Of the scene that a view shows; all else of the view is of no matter.
std::filesystem::path viewsFile(const std::filesystem::path& folder, const View& scene);

// In the order in which they were stored; none where there is no file. An Error names file, line
// and key of what is wrong in it, another scene included. `file` of each is as `scene` has it.
std::vector<View> storedViews(const std::filesystem::path& folder, const View& scene);

// Adds the view to those of its scene, or puts it in the place of the one of its name, which must
// not be empty. The file is written whole or not at all, and one that cannot be read stays as it
// is: an Error then, as of storedViews().
void storeView(const std::filesystem::path& folder, const View& view);

// Takes the view of that name out of the scene's file; nothing where there is none.
void forgetView(const std::filesystem::path& folder, const View& scene, const std::string& name);

// One list: what was found, as "found"; the file's cameras with the radius and exposure of that,
// but for one that it is itself; the stored. No two have the same name: later ones get a number.
std::vector<View> allViews(const View& found, const std::vector<NamedCamera>& cameras,
                           const std::vector<View>& stored);

} // namespace obscura
