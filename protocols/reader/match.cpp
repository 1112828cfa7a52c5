#include "protocols/reader/match.h"

#include "base/files.h"
#include "protocols/reader/study_parts.h"

#include <fmt/format.h>

#include <set>

namespace obscura {

namespace {

Truth parseTruth(const PlacedText& given) {
    const auto& all = truthNames();
    const auto found = std::find(all.begin(), all.end(), given.text);
    if (found == all.end())
        throw Error(
            given.place,
            fmt::format("expected one of \"{}\", found \"{}\"{}", fmt::join(all, "\", \""),
                        given.text,
                        nearest(given.text, all).empty() ? "" : suggestion(given.text, all)));
    return static_cast<Truth>(found - all.begin());
}

void parseCriterion(TomlTable& root, MatchStudy& study) {
    const bool reference = root.has("reference"), partner = root.has("partner");
    if (reference == partner)
        throw Error(root.place(),
                    fmt::format("expected either \"reference\" (one of {}) or \"partner\" (the "
                                "name of a technique), found {}",
                                fmt::join(truthNames(), ", "), reference ? "both" : "neither"));
    if (reference)
        study.truth = static_cast<Truth>(root.choice("reference", truthNames(), 0));
    else {
        study.partner = root.text("partner");
        mustExist(root.placeOf(*root.node("partner"), "partner"), study.partner, study.techniques,
                  "a technique under [techniques]");
    }
    for (const PlacedText& given : root.texts("scores", "names of references"))
        study.scores.push_back(parseTruth(given));
}

// The views of one list, at each radius where the study names several.
std::vector<View> viewsOf(TomlTable& root, const char* key, const std::vector<View>& all,
                          const std::vector<double>& radii, std::set<std::string>& used) {
    std::vector<View> result;
    const auto names = root.requiredTexts(key, "names of scenes under [scenes]");
    for (const PlacedText& name : names) {
        mustExist(name.place, name.text, all, "a scene under [scenes]");
        if (!used.insert(name.text).second)
            throw Error(name.place, fmt::format("expected a scene that is not in use yet, found "
                                                "\"{}\" again: what is fitted on one view must be "
                                                "tested on another",
                                                name.text));
        View view = *std::find_if(all.begin(), all.end(),
                                  [&](const View& v) { return v.name == name.text; });
        for (const double radius : radii.empty() ? std::vector{view.radius} : radii) {
            view.radius = radius;
            result.push_back(view);
        }
    }
    return result;
}

void parseViews(TomlTable& root, MatchStudy& study) {
    const std::vector<double> radii = root.numbers("radii", lowestRadius, highestRadius);
    std::vector<View> all;
    for (auto& [name, table] : root.tables("scenes", "at least one scene, [scenes.NAME]"))
        all.push_back(parseView(name, std::move(table), radii.empty()));
    std::set<std::string> used;
    study.train = viewsOf(root, "train", all, radii, used);
    study.test = viewsOf(root, "test", all, radii, used);
    for (const View& view : all)
        if (!used.contains(view.name))
            throw Error(view.place, "expected every scene in \"train\" or \"test\", found it in "
                                    "neither");
}

// No technique may have its own radius. All take that of the view, or their errors could not be
// compared.
void checkTechniques(const MatchStudy& study) {
    for (const TechniqueSetting& technique : study.techniques)
        for (const Setting& setting : technique.settings)
            if (setting.name == "radius")
                throw Error(setting.place, "a technique that is matched has each view's radius; "
                                           "leave this out, or give \"radiusMultiplier\"");
}

} // namespace

ImageSize parseSize(TomlTable table) {
    ImageSize size;
    size.width = table.integer("width", 16, 8192);
    size.height = table.integer("height", 16, 8192);
    table.finish();
    return size;
}

MatchStudy parseComparison(TomlTable& root, Lists lists, std::string& includedSha256) {
    MatchStudy study;
    study.name = root.text("name");
    checkName(root, "name", study.name, "-", " and hyphens");
    study.seed = static_cast<std::uint64_t>(root.integer("seed", 0, 2147483647));
    if (auto training = root.table("training"))
        study.training = parseSize(std::move(*training));
    study.normals = parseNormals(root);
    study.rays = root.integer("rays", 1, 1 << 20, study.rays);
    parseViews(root, study);
    Techniques techniques = parseTechniques(root, lists);
    study.techniques = std::move(techniques.techniques);
    includedSha256 = techniques.includedSha256;
    checkTechniques(study);
    parseCriterion(root, study);
    return study;
}

const std::vector<std::string>& truthNames() {
    static const std::vector<std::string> names{"cosine", "uniform", "falloff", "depth"};
    return names;
}

MatchStudy parseMatchStudy(const std::string& text, const std::string& file) {
    const toml::table table = parseToml(text, file);
    std::string includedSha256;
    TomlTable root(table, file, "");
    MatchStudy study = parseComparison(root, Lists::refused, includedSha256);
    if (auto image = root.table("image"))
        study.image = parseSize(std::move(*image));
    if (!root.has("training"))
        study.training = study.image;
    root.finish();
    study.sha256 = studySha256(text, includedSha256);
    return study;
}

MatchStudy readMatchStudy(const std::filesystem::path& path) {
    return parseMatchStudy(readFile(path), path.string());
}

MatchStudy atRadius(MatchStudy study, double radius) {
    std::set<double> known;
    for (std::vector<View>* views : {&study.train, &study.test}) {
        for (const View& view : *views)
            known.insert(view.radius);
        std::erase_if(*views, [&](const View& view) { return view.radius != radius; });
    }
    if (study.train.empty() || study.test.empty())
        throw Error(fmt::format("expected a radius that training and test views of \"{}\" have, "
                                "found {}; one of: {}",
                                study.name, radius, fmt::join(known, ", ")));
    study.name += fmt::format("-{}", radius); // results of their own
    return study;
}

} // namespace obscura
