#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace obscura {

// What is good enough, and whether a configuration is; all functions are pure.

struct Measure;

// The limits: the most that each measure may be, of JOD the least. A measure without a limit does
// not matter.
struct Budget {
    std::optional<double> rmse;         // of matched visibility, 0 ... 1
    std::optional<double> flip;         // of matched visibility shown as sRGB grey
    std::optional<double> litFlip;      // of the lit image
    std::optional<double> flicker;      // 99th percentile of reference-relative change, worst path
    std::optional<double> milliseconds; // in 95 of 100 frames, on the dearest view
    std::vector<std::string> failures;  // ids of failure tests that must pass
    std::optional<double> jod;          // predicted, of the lit image
    const Measure* best = nullptr;      // by which the best of those within the limits is chosen;
                                        // nullptr: the cheapest of them is
};

// What a configuration gave on one held-out view. NaN: not measured.
struct ViewResult {
    double rmse = 0, flip = 0, litFlip = 0;
    double milliseconds = 0;                               // 95th percentile
    double flicker = 0;                                    // as in Budget
    double jod = std::numeric_limits<double>::quiet_NaN(); // as in Budget
};

// A measure that has a mean over views: a limit is met when a bound of that mean meets it.
struct Measure {
    const char* name;  // as options spell it
    const char* spelt; // as people read it
    std::optional<double> Budget::*limit;
    double ViewResult::*value;
    double perfect; // the truth's own value: 0, or 10 where more is better
    bool lit;       // of the lit image, which a study without [light] has not

    bool moreIsBetter() const { return perfect > 0; }
    double distance(double measured) const { // from perfect; less is better
        return moreIsBetter() ? perfect - measured : measured;
    }
};
std::span<const Measure> measures();
const Measure& measureNamed(std::string_view name); // which must be there

// "rmse=0.1" and the like, as --limit has them; an Error lists the names. `within` is --budget's
// "ms=2" or "": then the best by `best` is asked for. An Error for a limit on time alone, unless
// there will be `others`: the cheapest within any time is always no occlusion.
Budget budgetOf(std::span<const std::string> limits, const std::string& within = "",
                const Measure* best = nullptr, bool others = false);

// The answer is to hold with 95 % confidence although many candidates are tried. They are tried in
// an order that other views have set, each with a bound at 1 - 0.05/3, until three have failed. Of
// those that truly fail at most three are then tried, so one passes in at most 5 of 100 searches,
// however their errors depend on one another (Hommel and Kropf 2005,
// Biometrical Journal 47).
constexpr double confidence = 0.95;
constexpr int failuresAllowed = 3;
constexpr double boundLevel = 1 - (1 - confidence) / failuresAllowed;

// The upper end of the one-sided confidence interval of a mean over views (Student's t; views are
// the sample). One value alone bounds nothing: infinity.
double upperBound(std::span<const double> values, double level = boundLevel);

double meanOf(std::span<const ViewResult> views, double ViewResult::*value);

// How results stand to one limit.
struct Standing {
    const Measure* measure = nullptr; // nullptr: milliseconds, whose mean is the dearest view's
    double limit = 0, mean = 0;
    double bound = 0;   // the end of the mean's interval that decides
    double ratio = 0;   // of the bound's distance from perfect to the limit's: above 1 it fails
    double scatter = 0; // standard deviation over views
    int views = 0;      //
    int unknown = 0;    // views that have no value; any fails
};

// One for each limit, the worst first.
std::vector<Standing> standings(const Budget& budget, std::span<const ViewResult> views);

// "RMSE 0.132 (at most 0.135 with 98.3 % confidence), limit 0.100"
std::string inWords(const Standing& standing);

// Why the results do not meet the budget, the worst excess first; "" when they do.
std::string excess(const Budget& budget, std::span<const ViewResult> views);

// The limits that would have to be others for these results to meet all, as the command line has
// them, rounded to the lax side: "rmse=0.136 ms=3.1"; "" when none has to, or no number would do.
std::string admitting(const Budget& budget, std::span<const ViewResult> views);

// With so many views that scatter as these do, the bound would meet the limit; none when the mean
// itself does not.
std::optional<int> viewsNeeded(const Standing& standing);

} // namespace obscura
