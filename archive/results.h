#pragma once

#include "analysis/whole_analysis.h"
#include "archive/same_results.h"
#include "archive/study.h"

#include <filesystem>
#include <map>
#include <string>

namespace obscura {

// Results of a study, as obscura-analysis wrote them: the same data must give them again.

struct Results {
    std::filesystem::path folder;
    AnalysisRequest request;
    std::string program;  // that made them: "0.1.0 (0123456789ab)"
    std::string excluded; // what it was told to leave out, a CSV; "" for nothing
};

// Those of the study's places, for its data where they now lie. `excluded` is the file in which
// that text lies, or will.
Results readResults(const StudyPlaces& places, const std::filesystem::path& excluded);

// Analyses a study as obscura-analysis does that is given nothing but it, and writes all into
// `folder`.
Results makeResults(const StudyPlaces& places, const std::filesystem::path& folder);

// What the data give now, by file name.
std::map<std::string, std::string> tablesOf(const Results& results);

// That, held against the files of the same names in the folder.
ResultsComparison comparisonOf(const Results& results,
                               const std::map<std::string, std::string>& tables);

// This program, as results name it.
std::string thisProgram();

} // namespace obscura
