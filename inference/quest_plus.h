#pragma once

#include "inference/psychometric_model.h"
#include "inference/result.h"

#include <vector>

namespace obscura {

// QUEST+ (Watson, "QUEST+: A general multidimensional Bayesian adaptive psychometric method",
// J. Vision 17(3):10, 2017): the posterior of a psychometric function on a grid, and the level
// whose answer is expected to leave the least entropy. Agrees, choice by choice, with the three
// runs of one stimulus dimension that Watson prints for a Weibull function. One step takes two
// products of a table of levels x combinations with the posterior: 0.1 ms for 16 x 2000.

// The values that are considered; every combination is, and all are equally likely at first.
// Threshold, slope and curve are those of Psychometric; levels and values rise.
struct QuestGrid {
    Sigmoid curve = Sigmoid::logistic;
    std::vector<double> levels; // of stimuli, at least one
    std::vector<double> thresholds, slopes;
    std::vector<double> guesses = {0.5}; // [0, 1)
    std::vector<double> lapses = {0};    // [0, 1); guess + lapse < 1
};

// A grid for levels of which little is known, at least two: a logistic curve with a threshold
// within their range R (61 values), a slope of 2/R to 64/R (11), a lapse rate of 0 to 0.06 (3).
QuestGrid questGrid(const std::vector<double>& levels, double guess);

enum class QuestParameter { threshold, slope, guess, lapse };

// Of the Weibull's threshold all is in log10 units. Each value of the grid stands for all that are
// nearer to it than to its neighbours, and all of these are equally likely. The median is less
// biased than the mean where slopes are not known (docs/measurement.md).
struct QuestEstimate {
    double median = 0, sd = 0;
    Interval interval; // with equal tails

    double width() const { return interval.high - interval.low; }
};

class QuestPlus {
  public:
    // Throws Error where a list is empty or does not rise, or a value is out of range.
    explicit QuestPlus(QuestGrid grid);

    int next() const; // index of the level to show: the first of those that are best
    // Of the posterior after one more answer at a level, in nats.
    double expectedEntropy(int level) const;
    void answer(int level, bool success);

    QuestEstimate estimate(QuestParameter parameter, double confidence = 0.95) const;
    double mode(QuestParameter parameter) const; // of the most likely combination

  private:
    Eigen::VectorXd gains() const;
    const std::vector<double>& valuesOf(QuestParameter parameter) const;
    int indexOf(QuestParameter parameter, Eigen::Index combination) const;

    QuestGrid grid_;
    Eigen::MatrixXd success_, noise_; // levels x combinations: P(success), entropy of the answer
    Eigen::VectorXd posterior_;
};

} // namespace obscura
