#include "viewer/presets.h"

#include "base/error.h"
#include "base/files.h"
#include "protocols/reader/views_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace obscura {

namespace {

namespace fs = std::filesystem;

std::string placeOf(const View& scene) {
    return scene.file.empty() ? scene.builtin : fs::weakly_canonical(scene.file).string();
}

View placed(View view) {
    if (!view.file.empty())
        view.file = placeOf(view);
    return view;
}

void write(const fs::path& file, const std::vector<View>& views) {
    writeFile(file, viewsText(views, "Views that were stored in obscura-view. A study takes these "
                                     "tables as they are.\nChange and delete what you like."));
}

} // namespace

fs::path viewsFolder() {
    const char* config = std::getenv("XDG_CONFIG_HOME");
    if (config && fs::path(config).is_absolute())
        return fs::path(config) / "obscura" / "views";
    const char* home = std::getenv("HOME");
    if (!home || !*home)
        throw Error("expected HOME or XDG_CONFIG_HOME to name a folder to keep views in, found "
                    "neither; set one of them");
    return fs::path(home) / ".config" / "obscura" / "views";
}

fs::path viewsFile(const fs::path& folder, const View& scene) {
    const std::string place = placeOf(scene);
    return folder / (scene.file.empty()
                         ? place + ".toml"
                         : fmt::format("{}-{}.toml", plainName(fs::path(place).filename().string()),
                                       sha256(place).substr(0, 8)));
}

std::vector<View> storedViews(const fs::path& folder, const View& scene) {
    const fs::path file = viewsFile(folder, scene);
    if (!fs::exists(file))
        return {};
    std::vector<View> views = parseViews(readFile(file), file.string());
    for (View& view : views) {
        if (placeOf(view) != placeOf(scene))
            throw Error(view.place,
                        fmt::format("expected a view of {}, for which this file is, found one of "
                                    "{}; move it to {}, or delete it",
                                    placeOf(scene), placeOf(view),
                                    viewsFile(folder, view).string()));
        view.file = scene.file;
    }
    return views;
}

void storeView(const fs::path& folder, const View& view) {
    if (view.name.empty())
        throw Error("expected a name for the view, found none; type one");
    std::vector<View> views = storedViews(folder, view);
    const auto known = std::find_if(views.begin(), views.end(),
                                    [&](const View& each) { return each.name == view.name; });
    if (known == views.end())
        views.push_back(view);
    else
        *known = view;
    std::transform(views.begin(), views.end(), views.begin(), placed);
    write(viewsFile(folder, view), views);
}

void forgetView(const fs::path& folder, const View& scene, const std::string& name) {
    std::vector<View> views = storedViews(folder, scene);
    if (std::erase_if(views, [&](const View& each) { return each.name == name; }) == 0)
        return;
    std::transform(views.begin(), views.end(), views.begin(), placed);
    write(viewsFile(folder, scene), views);
}

std::vector<View> allViews(const View& found, const std::vector<NamedCamera>& cameras,
                           const std::vector<View>& stored) {
    std::vector<View> views;
    const auto add = [&](View view, const std::string& name) {
        view.name = name;
        for (int number = 2; std::any_of(views.begin(), views.end(),
                                         [&](const View& each) { return each.name == view.name; });
             ++number)
            view.name = fmt::format("{} {}", name, number);
        views.push_back(std::move(view));
    };
    add(found, "found");
    for (const NamedCamera& each : cameras) {
        View view = found;
        view.camera = each.camera;
        if (view.camera.position != found.camera.position)
            add(view, each.name.empty() ? "camera" : each.name);
    }
    for (const View& view : stored)
        add(view, view.name);
    return views;
}

} // namespace obscura
