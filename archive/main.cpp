// obscura-archive: all of a study in one folder or zip, and whether such an archive still holds.

#include "archive/check.h"
#include "archive/contents.h"
#include "archive/results.h"
#include "archive/study.h"
#include "archive/sums.h"
#include "archive/temporary_folder.h"
#include "archive/zip.h"
#include "base/files.h"
#include "base/program.h"
#include "base/progress.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdlib>
#include <optional>

namespace obscura {

namespace fs = std::filesystem;

namespace {

struct Options {
    fs::path folder, out, archive, scenes;
    std::string device;
    StudyPlaces places;
    bool withScenes = false;
};

void declare(CLI::App& app, Options& options) {
    const auto path = [&](const char* name, fs::path& place, const char* what, const char* kind) {
        return app.add_option(name, place, what)->option_text(kind);
    };
    auto* study =
        path("STUDY", options.folder,
             "A folder with the study's parts in it, or up to three levels below; those that it "
             "lacks, or has several of, are named by the options",
             " ");
    path("--protocol", options.places.protocol, "The study's protocol", "FILE");
    path("--stimuli", options.places.stimuli, "Its stimuli, as obscura-stimuli made them", "DIR");
    path("--data", options.places.data, "Its data, as obscura-experiment recorded them", "DIR");
    path("--results", options.places.results,
         "Its results, as obscura-analysis wrote them; made anew where there are none", "DIR");
    auto* out = path("--out", options.out, "What is to be made: a new folder, or NAME.zip", "PATH");
    path("--scenes", options.scenes, "Folder of glTF scenes; default OBSCURA_SCENES", "DIR");
    auto* with =
        app.add_flag("--with-scenes", options.withScenes,
                     "Put in scenes and environment images themselves, whose licences must "
                     "allow it; else their names and hashes");
    path("--check", options.archive,
         "Instead: an archive, a folder or a zip. Compares checksums, reads all of it again, "
         "renders "
         "what this machine can, analyses again, and says what differs; writes nothing",
         "ARCHIVE")
        ->excludes(study)
        ->excludes(out)
        ->excludes(with);
    app.add_option("--device", options.device,
                   "With --check: render with this device of obscura-render --devices")
        ->option_text("NAME");
}

Results resultsOf(const StudyPlaces& places, const fs::path& temporary) {
    if (places.results.empty())
        return makeResults(places, temporary / "results");
    Results results = readResults(places, temporary / "excluded.csv");
    if (!results.excluded.empty())
        writeFile(temporary / "excluded.csv", results.excluded);
    return results;
}

void write(NewFiles files, const std::string& study, const fs::path& out) {
    files[sumsName] = {sumsOf(files)};
    makeNew(out, [&](const fs::path& path) {
        if (out.extension() == ".zip")
            writeZip(path, study, files);
        else
            writeFiles(path, files);
    });
}

int archive(const Options& options) {
    if (options.out.empty())
        throw Error("expected --out, a new folder or NAME.zip, or --check ARCHIVE; see --help");
    checkIsFree(options.out);
    const StudyPlaces places = findStudy(options.folder, options.places);
    const WholeStudy study = openWholeStudy(places);
    const TemporaryFolder temporary;
    const Results results = resultsOf(places, temporary.path());
    const Contents contents = contentsOf(study, results, options.scenes, options.withScenes);
    write(contents.files, study.protocol.name, options.out);
    for (const std::string& remark : contents.remarks)
        fmt::print(stderr, "note: {}\n", remark);
    fmt::print("{}: {} files, from\n  protocol {}\n  stimuli  {}\n  data     {}\n  results  {}\n",
               options.out.string(), contents.files.size() + 1, places.protocol.string(),
               places.stimuli.string(), places.data.string(),
               places.results.empty() ? "made anew" : places.results.string());
    return 0;
}

int check(const Options& options) {
    std::optional<Progress> progress;
    const CheckOptions how{options.scenes, options.device,
                           [&](int done, int total, const std::string& what) {
                               if (total == 0)
                                   progress.reset();
                               else if (!progress)
                                   progress.emplace("rendering", total);
                               if (progress)
                                   progress->update(done, what);
                           }};
    const std::vector<Checked> all = checkArchive(options.archive, how);
    progress.reset();
    const bool sound = isSound(all);
    fmt::print("{}\n{}: {}\n", textOf(all), options.archive.string(),
               sound ? "nothing differs that should be the same"
                     : "something differs that should be the same");
    return sound ? 0 : 1;
}

int run(CLI::App& app, int argc, char** argv) {
    Options options;
    const char* environment = std::getenv("OBSCURA_SCENES");
    options.scenes = environment ? environment : ".";
    declare(app, options);
    app.parse(argc, argv);
    return options.archive.empty() ? archive(options) : check(options);
}

} // namespace

} // namespace obscura

int main(int argc, char** argv) {
    return obscura::runProgram("obscura-archive",
                               "all of a study in one folder or zip, and whether it still holds",
                               obscura::run, argc, argv);
}
