#pragma once

#include "image/image.h"

#include <functional>
#include <optional>
#include <vector>

namespace obscura {

// The arithmetic of matching: pure, no OpenGL. docs/techniques.md says what it means and hides.

struct Range {
    double low = 0, high = 0;
};

// The last step of every technique (renderer/techniques/technique.h): visibility v becomes
// max(0, 1 - intensity (1 - v))^power, or with a power below 0 (1 + intensity (1 - v))^power, at
// most 1.
struct Remap {
    double intensity = 1, power = 1;
};
double remapped(double visibility, const Remap& remap);

// A technique's raw visibility beside a target, over the pixels of several views, each view
// weighing the same. It is kept as one histogram, so that trying a remap costs a few thousand calls
// of pow() and no rendering.
class Comparison {
  public:
    // `image` was rendered with intensity `probe` and power 1. A probe below 1 keeps apart what the
    // last pass would have clamped at black, down to a visibility of 1 - 1 / probe.
    void add(const Image& image, double probe, const Image& target, const std::vector<bool>& shown);

    double meanSquare(const Remap& remap) const;     // of remapped minus target
    double meanDifference(const Remap& remap) const; // remapped minus target
    bool constant() const; // raw visibility is the same everywhere, so that no remap tells anything
    int views() const { return views_; }

  private:
    struct Bin {
        double weight = 0, occlusion = 0,
               target = 0; // sums; of pixels that weigh 1 / pixels of view
    };
    std::vector<Bin> bins_;
    double squares_ = 0; // of the target
    int views_ = 0;
};

enum class Criterion {
    leastSquares,
    equalMean // least squares among the remaps that give the target's mean
};

// Which values may change, and between which bounds; the others stay as they are in `start`. The
// power's are of its size: it keeps its sign where the intensity is held. Where both are free they
// are fitted as their product and 1 / power, which is 0 for exp(); the bound of the power's size
// stands for that. Powers below 0 are taken where they save a tenth of the error.
struct Tunable {
    Remap start;
    std::optional<Range> intensity, power;
};

struct FittedRemap {
    Remap remap;
    // Mean square, a ninth more for a power below 0, with a penalty for a mean that cannot be met.
    double error = 0;
};
FittedRemap fitRemap(const Comparison& comparison, const Tunable& tunable, Criterion criterion);

// The argument inside `range` with the least error, on a logarithmic scale: octaves around `start`
// until the least is bracketed, then Brent's method to a few percent. Each evaluation is expensive.
double fitMultiplier(const std::function<double(double)>& error, double start, Range range);
constexpr int fitMultiplierEvaluations = 13; // about

// The same for several arguments that depend on each other, nearby: at most that many evaluations
// of NLopt's Nelder-Mead from `start`, which stays unless something is better.
std::vector<double> fitScales(const std::function<double(const std::vector<double>&)>& error,
                              const std::vector<double>& start, const std::vector<Range>& ranges);
constexpr int fitScalesEvaluations = 30;

} // namespace obscura
