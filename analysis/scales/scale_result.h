#pragma once

#include "analysis/scales/scale_data.h"

#include "inference/psychometric.h"
#include "inference/result.h"
#include "inference/scales.h"
#include <Eigen/Core>

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace obscura {

// A scale that was fitted, or the parameters of a curve, in the same words for all kinds.
struct ScaleItem {
    std::string name;
    double value = 0;
    std::optional<double> standardError{};
    // 95 %; an end that the data do not bound is absent. None at all: not known, or the item is the
    // origin, which has no error of its own.
    OpenInterval interval{};
    std::vector<std::pair<double, int>> counts{}; // of ratings: how often each value was given
};

// From an item to the next one.
struct ScaleStep {
    std::size_t from = 0, to = 0; // items
    double difference = 0;        // >= 0 unless items have an order of their own
    std::optional<double> standardError{};
    OpenInterval interval{};
    std::optional<double> p{}, holm{}; // of the same scale's steps
};

// What tells whether to believe it.
struct ScaleDiagnostic {
    std::string name;
    std::optional<double> value{};
    std::optional<Test> test{};
};

// What a psychometric function was fitted to, for its picture.
struct ScaleCurve {
    Ladder ladder;
    PsychometricModel model;
    Psychometric parameters;
};

struct ScaleResult {
    ScaleGroup group;             // its notes moved to `notes`
    std::string unit;             // "JOD"
    std::vector<ScaleItem> items; // in the protocol's order; none where nothing could be fitted
    std::vector<ScaleStep> steps; // by rising value
    std::vector<ScaleDiagnostic> diagnostics;
    std::string intervals;          // how they came about
    std::vector<std::string> notes; // what to know before believing it; why there is none
    std::optional<ScaleCurve> curve{};
    std::vector<ScaleStep> pairs{}; // every two items, from < to, without p; none of a curve
    bool isOrdered = false;         // items have an order of their own, that of a ladder's steps
};

ScaleResult resultOf(const ScaleGroup& group, std::string unit);

// A scale's values, of any zero, when person p counts times[p] times; absent where there are none.
using Refit = std::function<std::optional<Eigen::VectorXd>(std::span<const int> times)>;

// Items and steps of a scale from its first item: with intervals by resampling people where `refit`
// can be asked and there are enough of them, else from the covariance (an empty one: none).
void addScale(ScaleResult& result, const Eigen::VectorXd& values, const Eigen::MatrixXd& covariance,
              const Refit& refit);

// How far an item lies above another, with the interval of that difference; absent where the scale
// has no pairs, or for an item and itself.
std::optional<ScaleStep> differenceOf(const ScaleResult& result, std::size_t from, std::size_t to);

// p of each step, and Holm's.
void correctSteps(ScaleResult& result);

// The items in their own order, or else by rising value.
std::vector<std::size_t> orderOf(const ScaleResult& result);

constexpr int fewestPeople = 8; // whose resampling says something

} // namespace obscura
