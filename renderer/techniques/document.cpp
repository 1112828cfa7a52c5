#include "renderer/techniques/document.h"

#include "base/files.h"
#include "base/shipped.h"
#include "renderer/techniques/fetches.h"

#include <fmt/format.h>

namespace obscura {

namespace {

std::string readsOf(const Technique& technique) {
    std::string text = "depth";
    const auto add = [&](unsigned bit, const char* what) {
        if (technique.reads & bit)
            text += fmt::format(", {}", what);
    };
    add(normals, "normals");
    add(light, "light and albedo");
    add(spheres, "spheres fitted to the scene's meshes");
    add(rays | traced | tree | triangles, "the scene's triangles");
    add(voxels, "voxels of the scene");
    add(layers, "further layers of depth");
    return text;
}

std::string passOf(const Pass& pass) {
    std::string details;
    const auto add = [&](const std::string& detail) {
        details += (details.empty() ? "" : ", ") + detail;
    };
    if (!pass.enabledBy.empty())
        add(pass.from == 1 ? fmt::format("with `{}`", pass.enabledBy)
                           : fmt::format("with `{}` {} or more", pass.enabledBy, pass.from));
    if (pass.scale > 1)
        add(fmt::format("1/{} of the size", pass.scale));
    if (pass.levels > 1)
        add(fmt::format("{} levels", pass.levels));
    if (pass.layers > 1)
        add(fmt::format("{} layers", pass.layers));
    if (pass.stage == Stage::rows || pass.stage == Stage::columns)
        add("compute");
    if (pass.stage == Stage::splat)
        add("once for each sphere");
    if (pass.stage == Stage::boxes)
        add("once for each triangle");
    return details.empty() ? fmt::format("`{}`", pass.name)
                           : fmt::format("`{}` ({})", pass.name, details);
}

std::string rowOf(const Technique& technique) {
    std::string text = fmt::format("\n### `{}`: {}\n\n{}.\n\nReads {}.", technique.id,
                                   technique.title, technique.citation, readsOf(technique));
    std::string passes;
    for (const Pass& pass : technique.passes)
        passes += (passes.empty() ? " Passes: " : ", ") + passOf(pass);
    if (!passes.empty())
        text += fmt::format("{}. Texture fetches per pixel: {:.4g}.", passes,
                            fetchesPerPixel(Settings(technique)));
    text += "\n";
    if (!technique.parameters.empty())
        text += "\n| parameter | default | unit | range | meaning | source of the default |\n"
                "|---|---|---|---|---|---|\n";
    for (const Parameter& p : technique.parameters)
        text += fmt::format("| `{}` | {} | {} | {} … {} | {}{} | {} |\n", p.name, p.value,
                            spell(p.unit), p.low, p.high, p.meaning,
                            p.fitted ? "; matching may fit it" : "", p.source);
    for (const Preset& preset : technique.presets) {
        std::string values;
        for (const PresetValue& value : preset.values)
            values +=
                fmt::format("{}`{}` = {}", values.empty() ? "" : ", ", value.name, value.value);
        Settings settings(technique);
        settings.apply(preset.name);
        text += fmt::format("\nPreset `{}`: {}; texture fetches per pixel: {:.4g}.\n", preset.name,
                            values, fetchesPerPixel(settings));
    }
    return text;
}

} // namespace

std::string_view spell(Unit unit) {
    switch (unit) {
    case Unit::metre:
        return "m";
    case Unit::ratio:
        return "ratio";
    case Unit::degree:
        return "degrees";
    case Unit::pixel:
        return "pixels";
    case Unit::count:
        return "count";
    case Unit::flag:
        break;
    }
    return "0 or 1";
}

std::string techniquesDocument() {
    std::string text = readFile(shipped("techniques.in.md"));
    for (const Technique& technique : techniques())
        text += rowOf(technique);
    return text;
}

} // namespace obscura
