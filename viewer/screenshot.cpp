#include "viewer/screenshot.h"

#include "base/files.h"
#include "viewer/seen.h"
#include "viewer/technique_words.h"

#include <fmt/format.h>

#include <array>

namespace obscura {

namespace fs = std::filesystem;

namespace {

// File systems take 255 bytes; some are left for "-visibility.exr" and numbers. A name that is cut
// tells by a hash that it is another one's.
constexpr std::size_t longest = 180;

std::string shortened(const std::string& name) {
    return name.size() <= longest ? name
                                  : name.substr(0, longest - 9) + "-" + sha256(name).substr(0, 8);
}

} // namespace

std::string screenshotName(const View& view, const Settings& settings, Show show) {
    const TechniqueSetting setting = settingOf(settings, view.radius);
    std::string name = sceneName(view) + "_" + slug(setting.technique);
    if (setting.preset)
        name += "-" + slug(setting.preset->name);
    for (const Setting& each : setting.settings)
        name += fmt::format("_{}-{}", each.name, static_cast<float>(each.value));
    if (show != Show::lit)
        name += "_" + showNames()[static_cast<std::size_t>(show)];
    return shortened(plainName(name));
}

Screenshot writeScreenshot(const fs::path& folder, const std::string& name, const Image8& shown,
                           const Image& visibility) {
    makeFolders(folder);
    for (int i = 1;; ++i) {
        const std::string free = i == 1 ? name : fmt::format("{}-{}", name, i);
        Screenshot files{folder / (free + ".png"), folder / (free + "-visibility.exr")};
        if (fs::exists(files.png) || fs::exists(files.exr))
            continue;
        if (visibility.pixels.empty())
            files.exr.clear();
        else
            writeExr(files.exr, visibility, std::array{std::string("V")});
        writePng(files.png, shown);
        return files;
    }
}

} // namespace obscura
