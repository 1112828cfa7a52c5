#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace obscura {

// One value that another program computed (R, pwcmp), and ours.
struct GoldenValue {
    std::string key;
    double computed = 0,
           expected = 0;  // NaN where there is none; ours also where the key is unknown
    double tolerance = 0; // absolute

    bool holds() const; // within the tolerance, or both without a value
};

// Computes every key of `folder`/golden_values.csv (key,value,abs_tol) from the data files beside
// it, and every scale of jod.csv from the wins.csv beside it, there or in `folder`/human. The files
// are laid out as in Obscura's shared golden/, whose README.md and golden_statistics.R define them.
// Errors name file, line and column.
std::vector<GoldenValue> goldenValues(const std::filesystem::path& folder);

// Prints each with its difference; the exit status is 1 if any does not hold.
int printGolden(const std::filesystem::path& folder);

} // namespace obscura
