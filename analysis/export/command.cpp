#include "analysis/export/command.h"

#include "analysis/export/formats.h"
#include "analysis/export/pseudonyms.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace obscura {

namespace fs = std::filesystem;

namespace {

const std::map<std::string, SimulatedRows> simulatedRows = {{"refuse", SimulatedRows::refuse},
                                                            {"exclude", SimulatedRows::exclude},
                                                            {"only", SimulatedRows::only},
                                                            {"include", SimulatedRows::include}};

bool isWithin(const fs::path& path, const fs::path& folder) {
    const fs::path inner = fs::weakly_canonical(path), outer = fs::weakly_canonical(folder);
    return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first ==
           outer.end();
}

void checkOut(const fs::path& out, const fs::path& study) {
    checkIsFree(out);
    if (isWithin(out, study))
        throw Error({out.string(), 0, 0, {}},
                    "expected --out to be outside the study's folder, whose data must stay as they "
                    "are; give another");
}

void checkKey(const fs::path& key, const ExportOptions& options) {
    if (isWithin(key, options.out) || isWithin(key, options.study))
        throw Error({key.string(), 0, 0, {}},
                    "expected --new-pseudonyms to name a file outside the export and the study's "
                    "folder, found it within; who has one must not have the other");
    if (fs::exists(fs::symlink_status(key)))
        throw Error({key.string(), 0, 0, {}},
                    "expected --new-pseudonyms to name a new file, found one, which is not "
                    "replaced; give another");
}

// A new file that only its owner may read, on disk when the function returns.
void writeKey(const fs::path& path, const std::string& content) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    const bool written =
        file >= 0 &&
        ::write(file, content.data(), content.size()) == static_cast<ssize_t>(content.size()) &&
        ::fsync(file) == 0;
    const int reason = errno;
    if (file >= 0)
        ::close(file);
    if (!written)
        throw Error({path.string(), 0, 0, {}},
                    fmt::format("cannot be written: {}", std::strerror(reason)));
}

NewFiles filesOf(const ExportOptions& options, RecordedStudy& data) {
    if (options.format == "bids") {
        NewFiles files = bidsFiles(data, !options.stimuli.empty());
        if (!options.stimuli.empty())
            files.merge(shownImages(data, options.stimuli));
        return files;
    }
    if (options.format == "psych-ds")
        return psychDsFiles(data);
    return pwcmpFiles(data, data.remarks);
}

} // namespace

CLI::App* declareExport(CLI::App& app, ExportOptions& options) {
    CLI::App* command = app.add_subcommand(
        "export", "Write a study's data in a standard's form, for archives and other programs");
    command->add_option("STUDY", options.study, "The study's folder (participant_data/<study>)")
        ->option_text(" ")
        ->required();
    command
        ->add_option("--format", options.format,
                     "bids (BIDS, behavioural), psych-ds, or pwcmp (comparisons)")
        ->option_text("WHAT")
        ->required()
        ->check(CLI::IsMember({"bids", "psych-ds", "pwcmp"}));
    command->add_option("--out", options.out, "A new folder")->option_text("DIR")->required();
    command
        ->add_option("--stimuli", options.stimuli,
                     "For bids: folder of the study's stimuli; the images that were shown go "
                     "into the export, compared with the hashes in the data")
        ->option_text("DIR");
    command
        ->add_option("--new-pseudonyms", options.key,
                     "Give participants new, random names, and write who is who into this new "
                     "file, which only you can read")
        ->option_text("FILE");
    command
        ->add_option_function<std::string>(
            "--simulated",
            [&options](const std::string& word) { options.simulated = simulatedRows.at(word); },
            "Sessions of simulated among those of real participants: refuse, exclude, only (the "
            "simulated), include")
        ->option_text("WHAT=refuse")
        ->check(CLI::IsMember({"refuse", "exclude", "only", "include"}));
    command->add_flag("--lenient", options.lenient,
                      "Report rows that cannot be read, and skip them");
    return command;
}

void exportStudy(const ExportOptions& options) {
    checkOut(options.out, options.study);
    if (!options.key.empty())
        checkKey(options.key, options);
    if (!options.stimuli.empty() && options.format != "bids")
        throw Error("expected --stimuli with --format bids only, whose folder has a place for "
                    "images; leave it out");
    RecordedStudy data = readStudy(options.study, options.simulated, options.lenient);
    const std::string key = options.key.empty() ? "" : renameParticipants(data);
    const NewFiles files = filesOf(options, data);
    makeNew(options.out, [&](const fs::path& folder) {
        writeFiles(folder, files);
        if (!options.key.empty())
            writeKey(options.key, key);
    });
    for (const std::string& remark : data.remarks)
        fmt::print(stderr, "{}\n", remark);
    fmt::print("{} session(s) of {}, {} files: {}\n", data.sessions.size(), data.study,
               files.size(), options.out.string());
    if (!options.key.empty())
        fmt::print("who is who: {}\n", options.key.string());
}

} // namespace obscura
