#pragma once

#include "bench/stability/cell.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace obscura {

// stability.csv: configuration, technique, test, measure, value, pass, picture, note. `pass` is 1
// or 0 for headlines, empty for other measures; "nan" stands for no value.
std::string stabilityCsv(std::span<const StabilityTest> tests,
                         const std::vector<StabilityCell>& cells);

// The same back from a file; `pass` is not read. What is not such a file is an Error that names the
// line.
std::vector<StabilityCell> readStabilityCsv(const std::filesystem::path& path);

// The test's headline for a configuration; null when it was not measured.
const StabilityCell* headline(const std::vector<StabilityCell>& cells,
                              const std::string& configuration, const StabilityTest& test);

// The file of a result's picture in the result folder: "pictures/halo-hbao-steps-8.png".
std::string pictureName(std::string_view test, const std::string& configuration);

// Whether a headline is no failure.
bool passes(const StabilityTest& test, double value);

} // namespace obscura
