#pragma once

#include "inference/result.h"
#include <Eigen/Dense>

#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace obscura {
struct GoldenValue; // golden.h
}

// What the computation of golden values shares.
namespace obscura::golden {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// By key. A list's elements have the keys key[1], key[2] and so on; a list of one has the key
// itself.
using Values = std::map<std::string, std::vector<double>>;

inline double valueOf(const std::optional<double>& value) { return value.value_or(none); }

// Statistic, df, p.
inline std::vector<double> spelt(const std::optional<Test>& test) {
    return test ? std::vector{valueOf(test->statistic), valueOf(test->df), test->p}
                : std::vector{none, none, none};
}

inline std::vector<double> listOf(const Eigen::VectorXd& values) {
    return {values.data(), values.data() + values.size()};
}

// tour.*, from tournament_matrix.csv and tournament_trials.csv.
void addTournament(const std::filesystem::path& folder, Values& values);

// The scales of jod.csv, from wins.csv.
void addJods(const std::filesystem::path& folder, std::vector<GoldenValue>& golden);

} // namespace obscura::golden
