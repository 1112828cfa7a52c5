#include "matching/fit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

// A ramp of raw visibility from `low` to 1, as a technique renders it at intensity `probe`.
constexpr int pixels = 4096;
const std::vector<bool> all(pixels, true);

template <typename Function>
Image image(Function value) {
    Image result{pixels, 1, 1, {}};
    for (int i = 0; i < pixels; ++i)
        result.pixels.push_back(static_cast<float>(value(i / (pixels - 1.0))));
    return result;
}
Image ramp(double low, double probe) {
    return image([&](double t) { return 1 - probe * (1 - low) * (1 - t); });
}
Image target(double low, const Remap& remap) {
    return image([&](double t) { return remapped(1 - (1 - low) * (1 - t), remap); });
}

const Tunable bothFree{{1, 1}, Range{1e-4, 100}, Range{0.1, 64}};

TEST(Remap, IsTheTablesFormula) {
    EXPECT_DOUBLE_EQ(remapped(0.25, {1, 1}), 0.25);
    EXPECT_DOUBLE_EQ(remapped(0.5, {1.5, 2}), 0.0625); // (1 - 1.5 / 2)^2
    EXPECT_DOUBLE_EQ(remapped(0.2, {2, 1}), 0);        // 1 - 2 * 0.8 < 0
    EXPECT_DOUBLE_EQ(remapped(1.5, {1, 2}), 1);
    EXPECT_DOUBLE_EQ(remapped(0.25, {4, -2}), 0.0625); // (1 + 4 * 3 / 4)^-2
    EXPECT_DOUBLE_EQ(remapped(1.5, {3, -2}), 1);       // 1 - 3 / 2 < 0
    for (const double power : {64.0, -64.0})           // to either side it tends to exp()
        EXPECT_NEAR(remapped(0.2, {1.5 / 64, power}), std::exp(-1.5 * 0.8), 0.005);
}

TEST(Comparison, CountsAsTheImagesDo) {
    Comparison comparison;
    const Image raw = ramp(0.2, 1), wanted = target(0.2, {0.5, 3});
    comparison.add(raw, 1, wanted, all);
    const Remap remap{1.2, 0.7};
    double squares = 0, difference = 0;
    for (int i = 0; i < pixels; ++i) {
        const double d = remapped(static_cast<double>(raw.at(i, 0, 0)), remap) -
                         static_cast<double>(wanted.at(i, 0, 0));
        squares += d * d / pixels;
        difference += d / pixels;
    }
    EXPECT_NEAR(comparison.meanSquare(remap), squares, 1e-6);
    EXPECT_NEAR(comparison.meanDifference(remap), difference, 1e-6);
}

TEST(Comparison, WeighsViewsAlikeAndLeavesOutEmptyPixels) {
    // One pixel of the first view is off by 1; a hundred of the second by 0.5; the rest is empty.
    Image one{100, 1, 1, std::vector<float>(100, 1.0f)}, none = one, half = one;
    none.pixels.assign(100, 0.0f);
    half.pixels.assign(100, 0.5f);
    std::vector<bool> first(100, false);
    first[7] = true;
    Comparison comparison;
    comparison.add(one, 1, none, first);
    comparison.add(one, 1, half, std::vector<bool>(100, true));
    EXPECT_NEAR(comparison.meanSquare({1, 1}), (1 + 0.25) / 2, 1e-9);
    EXPECT_TRUE(comparison.constant());
}

TEST(FitRemap, RecoversWhatMadeTheTarget) {
    for (const Remap& truth : {Remap{1, 1}, Remap{0.6, 2.2}, Remap{1.7, 0.5}, Remap{0.12, 20},
                               Remap{0.3, -9}, Remap{3, -0.7}}) {
        Comparison comparison;
        comparison.add(ramp(0.1, 1), 1, target(0.1, truth), all);
        const FittedRemap fitted = fitRemap(comparison, bothFree, Criterion::leastSquares);
        EXPECT_NEAR(fitted.remap.intensity, truth.intensity, 0.01 * truth.intensity);
        EXPECT_NEAR(fitted.remap.power, truth.power, 0.01 * std::abs(truth.power));
        EXPECT_LT(fitted.error, 1e-5);
    }
}

// No power gives this, but the largest are as good as it; from both sides, for 64 and -64 differ
// by next to nothing.
TEST(FitRemap, FindsTheExponential) {
    Comparison comparison;
    comparison.add(ramp(0.1, 1), 1, image([](double t) { return std::exp(-1.8 * (1 - t)); }), all);
    const Remap fitted = fitRemap(comparison, bothFree, Criterion::leastSquares).remap;
    EXPECT_EQ(std::abs(fitted.power), 64);
    EXPECT_NEAR(fitted.intensity * std::abs(fitted.power), 2, 0.02); // 1.8 / (1 - 0.1)
    EXPECT_LT(comparison.meanSquare(fitted), 1e-5);
}

// The mean of the truth where a technique sees full occlusion is often far from black, for much of
// that is false: the curve must be able to flatten.
TEST(FitRemap, FlattensWhereTheTargetDoes) {
    Comparison comparison;
    comparison.add(ramp(0, 1), 1, image([](double t) { return 0.4 + 0.6 * std::pow(t, 9); }), all);
    const FittedRemap fitted = fitRemap(comparison, bothFree, Criterion::leastSquares);
    EXPECT_LT(fitted.remap.power, 0);
    double exponential = 1;
    for (double product = 0.1; product < 10; product *= 1.01)
        exponential = std::min(exponential, comparison.meanSquare({product / 64, 64}));
    EXPECT_LT(fitted.error, 0.5 * exponential);
}

// What is a little nearer on training views by flattening is not on others.
TEST(FitRemap, FlattensForMoreThanALittle) {
    const auto fitTo = [](double noise) { // that no curve can follow
        Comparison comparison;
        comparison.add(ramp(0, 1), 1, image([&](double t) {
                           const bool odd = static_cast<int>(t * (pixels - 1) + 0.5) % 2 != 0;
                           return remapped(t, {0.3, -9}) + (odd ? noise : -noise);
                       }),
                       all);
        return fitRemap(comparison, bothFree, Criterion::leastSquares).remap;
    };
    EXPECT_NEAR(fitTo(0).power, -9, 0.1);
    EXPECT_EQ(fitTo(0.1).power, 64);
}

// Raw visibility down to -3: clamped at black it would no longer tell how much to lighten.
TEST(FitRemap, ReachesBelowBlackByProbing) {
    Comparison comparison;
    comparison.add(ramp(-3, 0.125), 0.125, target(-3, {0.25, 1.3}), all);
    const FittedRemap fitted = fitRemap(comparison, bothFree, Criterion::leastSquares);
    EXPECT_NEAR(fitted.remap.intensity, 0.25, 0.003);
    EXPECT_NEAR(fitted.remap.power, 1.3, 0.02);
}

TEST(FitRemap, LeavesWhatIsHeld) {
    Comparison comparison;
    comparison.add(ramp(0.1, 1), 1, target(0.1, {0.6, 2}), all);
    const FittedRemap fitted =
        fitRemap(comparison, {{1, 2}, Range{0.01, 100}, {}}, Criterion::leastSquares);
    EXPECT_EQ(fitted.remap.power, 2);
    EXPECT_NEAR(fitted.remap.intensity, 0.6, 0.01);
    const FittedRemap neither = fitRemap(comparison, {{1, 2}, {}, {}}, Criterion::leastSquares);
    EXPECT_EQ(neither.remap.intensity, 1);
    EXPECT_NEAR(neither.error, comparison.meanSquare({1, 2}), 1e-12);
}

TEST(FitRemap, MeetsAMeanExactly) {
    Comparison comparison;
    const Image wanted = image([](double t) { return 0.3 + 0.6 * t * t; }); // no remap gives this
    comparison.add(ramp(0, 1), 1, wanted, all);
    const FittedRemap fitted = fitRemap(comparison, bothFree, Criterion::equalMean);
    EXPECT_NEAR(comparison.meanDifference(fitted.remap), 0, 1e-6);
    for (const double power : {0.5, 1.0, 2.0}) { // none of equal mean is nearer
        const FittedRemap other =
            fitRemap(comparison, {{1, power}, Range{0.01, 100}, {}}, Criterion::equalMean);
        if (std::abs(comparison.meanDifference(other.remap)) < 1e-5) {
            EXPECT_LE(comparison.meanSquare(fitted.remap),
                      comparison.meanSquare(other.remap) + 1e-6);
        }
    }
}

TEST(FitRemap, ConstantVisibilityIsNoTrouble) {
    const Image open = image([](double) { return 1; }), grey = image([](double) { return 0.5; });
    Comparison nothing, some;
    nothing.add(open, 1, grey, all);
    some.add(grey, 1, target(0.5, {1, 1}), all); // mean 0.75
    for (const Criterion criterion : {Criterion::leastSquares, Criterion::equalMean}) {
        const FittedRemap untold = fitRemap(nothing, bothFree, criterion);
        EXPECT_TRUE(std::isfinite(untold.error));
        const FittedRemap told = fitRemap(some, bothFree, criterion);
        EXPECT_NEAR(remapped(0.5, told.remap), 0.75, 2e-3);
    }
    EXPECT_TRUE(nothing.constant());
    EXPECT_EQ(fitRemap(nothing, bothFree, Criterion::leastSquares).remap.intensity, 1);
    EXPECT_EQ(fitRemap(Comparison(), bothFree, Criterion::leastSquares).remap.power, 1);
}

TEST(FitMultiplier, FindsTheLeastWithFewRenderings) {
    for (const double truth : {0.06, 0.4, 1.0, 1.457, 2.3, 11.0}) {
        int evaluations = 0;
        const auto error = [&](double multiplier) {
            ++evaluations;
            const double octaves = std::log2(multiplier / truth);
            return 0.01 + 1 - std::exp(-octaves * octaves / 4);
        };
        const double found = fitMultiplier(error, 1, {0.05, 20});
        EXPECT_NEAR(std::log2(found / truth), 0, 0.05) << truth;
        EXPECT_LE(evaluations, 18) << truth;
    }
}

// A valley that lies across the axes, as reach and falloff do.
TEST(FitScales, FollowsAValley) {
    int evaluations = 0;
    const auto error = [&](const std::vector<double>& at) {
        ++evaluations;
        const double sum = std::log2(at[0]) + std::log2(at[1]),
                     difference = std::log2(at[0]) - std::log2(at[1]) - 1.2;
        return 0.01 + 0.1 * sum * sum + 0.01 * difference * difference;
    };
    const std::vector<double> found = fitScales(error, {1.5, 0.6}, {{0.05, 20}, {0.04, 1}});
    EXPECT_NEAR(std::log2(found[0]), 0.6, 0.15);
    EXPECT_NEAR(std::log2(found[1]), -0.6, 0.15);
    EXPECT_LE(evaluations, fitScalesEvaluations + 1);
}

TEST(FitScales, KeepsTheStartAndTheRanges) {
    const std::vector<double> start{1.5, 0.6};
    EXPECT_EQ(fitScales([](const auto&) { return 1.0; }, start, {{0.05, 20}, {0.04, 1}}), start);
    const auto found =
        fitScales([](const auto& at) { return at[0] - at[1]; }, start, {{1.2, 20}, {0.04, 0.8}});
    EXPECT_NEAR(found[0], 1.2, 1e-9);
    EXPECT_NEAR(found[1], 0.8, 1e-9);
}

TEST(FitMultiplier, KeepsTheStartAndTheRange) {
    EXPECT_EQ(fitMultiplier([](double) { return 1.0; }, 1.5, {0.05, 20}), 1.5);
    EXPECT_DOUBLE_EQ(fitMultiplier([](double m) { return m; }, 1, {0.3, 4}), 0.3);
    EXPECT_DOUBLE_EQ(fitMultiplier([](double m) { return -m; }, 1, {0.3, 4}), 4);
}

} // namespace
} // namespace obscura
