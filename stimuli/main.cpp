#include "base/arguments.h"
#include "base/program.h"
#include "base/progress.h"
#include "matching/match.h"
#include "matching/match_files.h"
#include "protocols/reader/protocol_argument.h"
#include "renderer/reference/reference_cache.h"
#include "stimuli/generate.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdlib>
#include <optional>

namespace {

using namespace obscura;
namespace fs = std::filesystem;

Announce announcing(std::optional<Progress>& progress, const std::string& label) {
    return [&progress, label](int done, int total, const std::string& file) {
        if (!progress)
            progress.emplace(label, total);
        progress->update(done, file);
    };
}

void warn(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings)
        fmt::print(stderr, "warning: {}\n", warning);
}

void report(const GenerateResult& result, const fs::path& folder) {
    warn(result.warnings);
    const StageTimes& t = result.times;
    fmt::print("{} images rendered, {} kept or rendered by others, in {}\n", result.rendered,
               result.kept, folder.string());
    if (result.rendered > 0)
        fmt::print(
            "seconds: scenes and shadow maps {:.1f}, G-buffer {:.1f}, light {:.1f}, occlusion "
            "{:.1f}, composite {:.1f}, proof of matching {:.1f}, writing {:.1f}; of these and "
            "others "
            "{:.1f} for quality and times; peak memory {:.0f} MiB\n",
            t.scene, t.gbuffer, t.light, t.occlusion, t.composite, t.hash, result.writing,
            result.measuring, peakMemory());
    for (const ConditionRecord& condition : result.manifest.conditions) {
        fmt::print("  {:<24} matched {:.12}\n", condition.condition,
                   condition.images.front().inputsSha256);
        for (const ImageRecord& image : condition.images)
            fmt::print("    {:<20} mean occlusion {:.4f}  RMSE {:.4f}  predicted JOD {:6.3f}  {}\n",
                       image.name, image.meanOcclusion, image.quality->rmse, image.quality->jod,
                       image.milliseconds ? fmt::format("{:.2f} ms", *image.milliseconds) : "");
    }
}

// Prints a line for each technique: how much fitting has improved it on views that it was not
// fitted on.
void report(const MatchStudy& study, const MatchResult& result, const fs::path& folder) {
    warn(result.warnings);
    const std::string target =
        study.partner.empty() ? truthNames()[static_cast<std::size_t>(study.truth)] : study.partner;
    fmt::print("{} techniques ({} known from before), in {}; on test views against {}:\n",
               result.techniques.size(), result.kept, folder.string(), target);
    fmt::print("{:<28} {:>8} {:>8} {:>8} {:>9} {:>7}  {}\n", "", "raw RMSE", "matched", "bias",
               "bias-free", "SSIM", "settings");
    for (const MatchedTechnique& technique : result.techniques) {
        const auto raw = summaryOf(technique.rows, target, "raw"),
                   fitted = summaryOf(technique.rows, target, "matched");
        std::string settings = technique.note;
        for (const auto& [name, value] : technique.fitted)
            settings += fmt::format("{}{} {}", settings.empty() ? "" : ", ", name, value);
        if (raw.views > 0)
            fmt::print("{:<28} {:8.4f} {:8.4f} {:+8.4f} {:9.4f} {:7.4f}  {}\n",
                       technique.setting.name, raw.rmse, fitted.rmse, fitted.bias, fitted.biasFree,
                       fitted.ssim, settings);
        else
            fmt::print("{:<28} {}\n", technique.setting.name, settings);
    }
}

struct Options {
    fs::path file, out;
    std::string device;
    Folders folders;
};

int runMatch(const Options& options, double radius) {
    MatchStudy study = readMatchStudy(options.file);
    if (radius > 0)
        study = atRadius(study, radius);
    const fs::path out = options.out.empty() ? fs::path("match-" + study.name) : options.out;
    const gl::Context context(options.device);
    std::optional<Progress> progress;
    const MatchResult result = match(study, options.folders, out, defaultCache(), context.driver(),
                                     [&](double done, double total, const std::string& note) {
                                         if (!progress)
                                             progress.emplace("matching", total);
                                         progress->update(done, note);
                                     });
    progress.reset();
    report(study, result, out);
    return 0;
}

int run(CLI::App& app, int argc, char** argv) {
    Options options;
    fs::path &protocolPath = options.file, &out = options.out;
    std::string& device = options.device;
    const char* environment = std::getenv("OBSCURA_SCENES");
    options.folders.scenes = environment ? environment : ".";
    Folders& folders = options.folders;
    bool layers = false, check = false, verifyOnly = false;
    double radius = 0;
    CLI::App* matching = app.add_subcommand(
        "match", "fit techniques to a reference and measure their errors on other views");
    takesProtocol(matching->add_option("study", options.file, "techniques and views, TOML"))
        ->required();
    matching->add_option("--out", out, "result folder; default match-NAME");
    matching->add_option("--scenes", folders.scenes,
                         "folder of glTF scenes; default OBSCURA_SCENES");
    matching->add_option("--device", device, "render with this device of obscura-render --devices");
    matching->add_option("--radius", radius, "only this one of the study's radii, metres")
        ->check(numberFrom(1e-4, 1e4));
    takesProtocol(app.add_option("protocol", protocolPath, "study, TOML"));
    app.add_option("--out", out,
                   "stimulus folder; default stimuli-NAME; processes of the same command, on any "
                   "machines that see it, share the work");
    app.add_option("--scenes", folders.scenes, "folder of glTF scenes; default OBSCURA_SCENES");
    app.add_option("--device", device, "render with this device of obscura-render --devices");
    app.add_flag("--layers", layers, "write linear EXR of image, visibility and G-buffer as well");
    app.add_flag(
        "--check", check,
        "check the protocol, load all that it names, and warn of conditions that are worth "
        "nothing; write nothing");
    app.add_flag(
        "--verify", verifyOnly,
        "compare the folder with the protocol, its files with their hashes, and every image "
        "with what is rendered again; write nothing");
    app.callback([&] {
        if (!matching->parsed() && protocolPath.empty())
            throw CLI::RequiredError("protocol");
    });
    app.parse(argc, argv);
    if (matching->parsed())
        return runMatch(options, radius);

    const Protocol protocol = readProtocol(protocolPath);
    folders.protocol = protocolPath.parent_path();
    if (out.empty())
        out = "stimuli-" + protocol.name;
    const gl::Context context(device);
    std::optional<Progress> progress;
    if (check) {
        const std::vector<std::string> warnings =
            obscura::check(protocol, folders, context.driver(), announcing(progress, "checking"));
        progress.reset();
        warn(warnings);
        fmt::print("{}: {} conditions, {}\n", protocolPath.string(), protocol.conditions.size(),
                   warnings.empty() ? "all well" : "all can be made, with the warnings above");
    } else if (verifyOnly) {
        const Manifest manifest = readManifest(out / "manifest.json");
        const int others = verify(protocol, manifest, folders, context.driver(),
                                  announcing(progress, "verifying"));
        progress.reset();
        fmt::print("{}: all {} images repeat byte for byte\n", out.string(),
                   manifest.conditions.size() * 2);
        if (others > 0)
            fmt::print("{} of them were made by other code, and come out the same\n", others);
    } else {
        const GenerateResult result = generate(protocol, folders, out, layers, context.driver(),
                                               announcing(progress, "rendering stimuli"));
        if (progress)
            progress->update(static_cast<double>(protocol.conditions.size()) * 2);
        progress.reset();
        report(result, out);
    }
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    return obscura::runProgram(
        "obscura-stimuli", "makes the images of a study, or matches techniques", run, argc, argv);
}
