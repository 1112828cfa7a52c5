#pragma once

#include "archive/results.h"
#include "archive/study.h"
#include "base/new_files.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace obscura {

// What an archive holds and where. It is a dataset of BIDS (behavioural), so that others' programs
// can read it, with all the rest in the folders that BIDS leaves to the makers:
//
//   dataset_description.json, participants.tsv, sub-.../   the data as BIDS has them
//   README.md, LICENCES.md, SHA256SUMS
//   stimuli/                      manifest.json and every file that it vouches for
//   code/archive.json             the archive's own record: below
//   code/protocol/                the protocol and the files that it names
//   code/excluded.csv             what the analysis was told to leave out, if anything
//   sourcedata/<study>/           the data as they were recorded, which is a dataset of Psych-DS
//   derivatives/obscura-analysis/ report, tables, figures
constexpr const char* recordName = "code/archive.json";
constexpr const char* excludedName = "code/excluded.csv";
constexpr const char* resultsFolder = "derivatives/obscura-analysis";

// code/archive.json: `study`, `protocol` (a path within the archive), `sources` and `versions`.
struct Record {
    std::string study;
    std::string protocol;
    nlohmann::ordered_json sources, versions;
};
Record readRecord(const std::filesystem::path& archive);

struct Contents {
    NewFiles files;                   // without the list of checksums
    std::vector<std::string> remarks; // what was left out, and what nobody knows
};

// `results` are the study's: an Error where the data give others. With `withSources` the scenes and
// environment images themselves are put in; an Error names one that is not here.
Contents contentsOf(const WholeStudy& study, const Results& results,
                    const std::filesystem::path& scenes, bool withSources);

} // namespace obscura
