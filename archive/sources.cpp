#include "archive/sources.h"

#include "archive/paths.h"
#include "base/files.h"
#include "base/version.h"
#include "renderer/render.h"
#include "renderer/scene/gltf_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>

namespace obscura {

namespace fs = std::filesystem;

namespace {

// A scene's file may say whose it is: glTF 2.0, section 5.8 (asset.copyright), and what Sketchfab
// adds to it.
std::string licenceIn(const nlohmann::json& root) {
    std::string licence;
    const auto add = [&](const nlohmann::json& object, const char* key) {
        if (object.contains(key) && object[key].is_string() &&
            licence.find(object[key].get<std::string>()) == licence.npos)
            licence += (licence.empty() ? "" : "; ") + object[key].get<std::string>();
    };
    const nlohmann::json& asset = root.at("asset");
    add(asset, "copyright");
    if (asset.contains("extras") && asset["extras"].is_object())
        for (const char* key : {"title", "author", "license", "source"})
            add(asset["extras"], key);
    return licence;
}

// Texts beside a scene that tell its terms, as downloads have them.
std::vector<fs::path> termsBeside(const fs::path& folder) {
    std::vector<fs::path> found;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        std::string name = entry.path().stem().string();
        std::transform(name.begin(), name.end(), name.begin(),
                       [](unsigned char c) { return std::tolower(c); });
        if (entry.is_regular_file() &&
            (name == "license" || name == "licence" || name == "copying"))
            found.push_back(entry.path());
    }
    return found;
}

// Of a scene that is here.
void describe(Source& source, const fs::path& scenes) {
    const GltfFile file(scenes / source.name);
    const fs::path folder = fs::weakly_canonical(fs::absolute(file.path()).parent_path());
    const fs::path within = fs::path(source.name).parent_path();
    source.licence = licenceIn(file.root());
    const auto add = [&](const fs::path& path, const fs::path& below) {
        source.files[(scenesFolder / within / below).generic_string()] = {{}, path};
    };
    add(file.path(), file.path().filename());
    for (const fs::path& named : file.named())
        add(named, named.lexically_relative(folder));
    for (const fs::path& terms : termsBeside(folder)) {
        add(terms, terms.filename());
        source.licence += fmt::format("{}see {}", source.licence.empty() ? "" : "; ",
                                      (within / terms.filename()).generic_string());
    }
}

// Whether it is the one that the recipe was made with.
bool isHere(const Recipe& recipe, SceneHashes& hashes) {
    const fs::path file = hashes.folders().scenes / recipe.view.file;
    return faultOfPath(recipe.view.file).empty() && fs::is_regular_file(file) &&
           hashes.of(recipe.view) == recipe.sceneSha256;
}

Source sceneOf(const Recipe& recipe, SceneHashes& hashes) {
    if (recipe.view.file.empty())
        return {"built-in scene", recipe.view.builtin, recipe.sceneSha256,
                "MIT, as Obscura, whose code makes it"};
    Source source{"scene", recipe.view.file, recipe.sceneSha256, ""};
    if (isHere(recipe, hashes))
        describe(source, hashes.folders().scenes);
    return source;
}

Source environmentOf(const Recipe& recipe, const fs::path& protocol) {
    Source source{"environment image", recipe.level.environment, recipe.environmentSha256, ""};
    const fs::path file = protocol / source.name;
    if (fs::is_regular_file(file) && sha256File(file) == source.sha256)
        source.files[source.name] = {{}, file};
    return source;
}

std::string cell(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    for (std::size_t at = 0; (at = text.find('|', at)) != text.npos; at += 2)
        text.insert(at, "\\");
    return text;
}

} // namespace

std::vector<Source> sourcesOf(const Manifest& manifest, const fs::path& scenes,
                              const fs::path& protocol) {
    SceneHashes hashes({scenes, protocol});
    std::vector<Source> sources;
    const auto add = [&](const std::string& sha256, auto make) {
        if (!sha256.empty() && std::none_of(sources.begin(), sources.end(), [&](const Source& one) {
                return one.sha256 == sha256;
            }))
            sources.push_back(make());
    };
    for (const ConditionRecord& condition : manifest.conditions)
        for (const ImageRecord& image : condition.images) {
            const Recipe& recipe = image.recipe;
            add(recipe.sceneSha256, [&] { return sceneOf(recipe, hashes); });
            add(recipe.environmentSha256, [&] { return environmentOf(recipe, protocol); });
        }
    return sources;
}

std::string licencesText(const std::string& own, const std::vector<Source>& sources) {
    const auto known = [](const std::string& licence) {
        return licence.empty() ? "**unknown**" : cell(licence);
    };
    std::string text = fmt::format(
        "# Licences\n\n"
        "What is known of the terms on which this archive's parts may be used. **Unknown** is no "
        "permission: ask\nwhoever made it.\n\n"
        "| part | terms |\n|---|---|\n"
        "| the study: protocol, answers, results, and the pictures as far as they are ours | {} |\n"
        "| Obscura {}, which rendered, asked and counted, and is no part of this archive | MIT |\n"
        "| letters in figures, contact sheets and the report: drawn by the fonts of the machine "
        "that made them; PDF files hold the letters that they use | **unknown**; Debian's default, "
        "DejaVu, is free (Bitstream Vera's terms) |\n",
        known(own), version());
    for (const Source& source : sources)
        text += fmt::format("| {} `{}`, SHA-256 {:.12}..., and all pictures of it | {} |\n",
                            source.kind, source.name, source.sha256, known(source.licence));
    if (own.empty())
        text +=
            "\nThe study's own terms are the `license` of its `dataset_description.json`, which "
            "has none yet.\n";
    return text;
}

} // namespace obscura
