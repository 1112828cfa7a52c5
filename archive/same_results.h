#pragma once

#include <map>
#include <string>
#include <vector>

namespace obscura {

// Tables of an analysis held against those of another, value by value.
struct ResultsComparison {
    long same = 0;   // values
    long nearly = 0; // numbers that differ by less than 1e-9 of the larger, as sums may on another
                     // processor
    double most = 0; // the largest such share
    // What differs: which value of which file, what it was, what it is, and how far apart they are.
    std::vector<std::string> numbers;
    // Texts, and values that only one of both has: where the versions differ, these may.
    std::vector<std::string> others;
};

// `before` and `now`: texts by file name, CSV or JSON. A file that one of them lacks differs. Of
// results.json the part `made` counts for nothing: it says by which version.
ResultsComparison comparisonOf(const std::map<std::string, std::string>& before,
                               const std::map<std::string, std::string>& now);

} // namespace obscura
