#include "matching/match_files.h"

#include "base/csv.h"
#include "base/files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace obscura {

using nlohmann::json;

namespace {

constexpr int formatVersion = 1; // of a finished technique's file; others are measured again

std::string numbers(const ImageError& e) {
    return fmt::format("{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}", e.rmse, e.bias, e.biasFree, e.ssim,
                       e.meanOcclusion);
}

json toJson(const MatchRow& row) {
    const ImageError& e = row.error;
    return {{"technique", row.technique},
            {"view", row.view},
            {"radius", row.radius},
            {"train", row.train},
            {"reference", row.reference},
            {"stage", row.stage},
            {"errors", {e.rmse, e.bias, e.biasFree, e.ssim, e.meanOcclusion}}};
}

MatchRow rowOf(const json& from) {
    const auto value = [&](std::size_t i) { // JSON has no NaN and writes null
        const json& number = from.at("errors").at(i);
        return number.is_null() ? std::nan("") : number.get<double>();
    };
    return {from.at("technique"),
            from.at("view"),
            from.at("radius"),
            from.at("train"),
            from.at("reference"),
            from.at("stage"),
            {value(0), value(1), value(2), value(3), value(4)}};
}

// A TOML key: bare where it may be.
std::string keyOf(const std::string& name) {
    const bool bare = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return (std::isalnum(c) && c < 128) || c == '-' || c == '_';
    });
    return bare ? name : json(name).dump();
}

std::string listOf(const std::vector<View>& views) {
    std::string text;
    for (const View& view : views)
        text += fmt::format("{}{} at {:g} m", text.empty() ? "" : ", ", view.name, view.radius);
    return text;
}

std::string criterionOf(const MatchStudy& study) {
    if (!study.partner.empty())
        return fmt::format("equal mean occlusion with \"{}\", then least squares", study.partner);
    return fmt::format("least squares to the {} reference",
                       truthNames()[static_cast<std::size_t>(study.truth)]);
}

std::string headerOf(const MatchStudy& study, const MatchResult& result) {
    std::string text = fmt::format(
        "# Written by obscura-stimuli match; a protocol takes it by include = [\"matched.toml\"].\n"
        "# Study: {}, SHA-256 {}\n# Fitted by: {}, {} rays per pixel, {} normals, seed {}\n",
        study.name, study.sha256, criterionOf(study), study.rays,
        normalsNames()[static_cast<std::size_t>(study.normals)], study.seed);
    for (const auto& [name, hash] : result.sceneSha256)
        text += fmt::format("# Scene: {}, SHA-256 {}\n", name, hash);
    text += fmt::format("# Trained on ({} x {}): {}\n# Tested on ({} x {}): {}\n",
                        study.training.width, study.training.height, listOf(study.train),
                        study.image.width, study.image.height, listOf(study.test));
    return text +
           "# RMSE is over test views, which the fit has not seen.\n"
           "# Visibility v becomes max(0, 1 - intensity (1 - v))^power; with a power below 0,\n"
           "# (1 + intensity (1 - v))^power. A power of 64 stands for\n"
           "# exp(-intensity power (1 - v)), and is no bound.\n";
}

} // namespace

std::string matchedFragment(const MatchStudy& study, const MatchResult& result) {
    std::string text = headerOf(study, result);
    const std::string reference =
        study.partner.empty() ? truthNames()[static_cast<std::size_t>(study.truth)] : study.partner;
    for (const MatchedTechnique& technique : result.techniques) {
        const auto raw = summaryOf(technique.rows, reference, "raw"),
                   matched = summaryOf(technique.rows, reference, "matched");
        text += "\n";
        if (matched.views > 0)
            text += fmt::format("# RMSE {:.4f} raw, {:.4f} matched; bias {:+.4f}\n", raw.rmse,
                                matched.rmse, matched.bias);
        if (!technique.note.empty())
            text += fmt::format("# {}\n", technique.note);
        text += fmt::format("[techniques.{}]\ntechnique = {}\n", keyOf(technique.setting.name),
                            json(technique.setting.technique).dump());
        if (technique.setting.preset)
            text += fmt::format("preset = {}\n", json(technique.setting.preset->name).dump());
        for (const Setting& given : technique.setting.settings)
            text += fmt::format("{} = {}\n", given.name, given.value);
        for (const auto& [name, value] : technique.fitted)
            text += fmt::format("{} = {}\n", name, value);
    }
    return text;
}

std::string matchTable(const MatchResult& result) {
    std::string text = "technique,view,radius,set,reference,stage,rmse,bias,bias_free_rmse,ssim,"
                       "mean_occlusion\n";
    const auto add = [&](const MatchRow& row) {
        text += fmt::format("{},{},{},{},{},{},{}\n", csvCell(row.technique), csvCell(row.view),
                            row.radius, row.train ? "train" : "test", csvCell(row.reference),
                            row.stage, numbers(row.error));
    };
    for (const MatchRow& row : result.truths)
        add(row);
    for (const MatchedTechnique& technique : result.techniques)
        for (const MatchRow& row : technique.rows)
            add(row);
    return text;
}

std::filesystem::path FinishedTechniques::path(const std::string& key) const {
    return folder_ / (key + ".json");
}

std::optional<MatchedTechnique> FinishedTechniques::find(const std::string& key) const {
    if (!std::filesystem::exists(path(key)))
        return std::nullopt;
    try {
        const json root = json::parse(readFile(path(key)));
        if (root.at("formatVersion") != formatVersion)
            return std::nullopt;
        MatchedTechnique technique;
        technique.fitted = root.at("fitted").get<std::map<std::string, double>>();
        technique.note = root.at("note");
        for (const json& row : root.at("rows"))
            technique.rows.push_back(rowOf(row));
        return technique;
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

void FinishedTechniques::add(const std::string& key, const MatchedTechnique& technique) const {
    json rows = json::array();
    for (const MatchRow& row : technique.rows)
        rows.push_back(toJson(row));
    writeFile(path(key), json{{"formatVersion", formatVersion},
                              {"fitted", technique.fitted},
                              {"note", technique.note},
                              {"rows", rows}}
                             .dump(1));
}

MatchSummary summaryOf(const std::vector<MatchRow>& rows, const std::string& reference,
                       const std::string& stage) {
    MatchSummary sum;
    for (const MatchRow& row : rows) {
        if (row.train || row.reference != reference || row.stage != stage)
            continue;
        sum.rmse += row.error.rmse * row.error.rmse;
        sum.biasFree += row.error.biasFree * row.error.biasFree;
        sum.bias += row.error.bias;
        sum.ssim += row.error.ssim;
        sum.meanOcclusion += row.error.meanOcclusion;
        ++sum.views;
    }
    const double count = std::max(sum.views, 1);
    return {std::sqrt(sum.rmse / count),     sum.bias / count,
            std::sqrt(sum.biasFree / count), sum.ssim / count,
            sum.meanOcclusion / count,       sum.views};
}

} // namespace obscura
