#include "inference/fisher.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace obscura {

namespace {

constexpr std::int64_t mostVotes = 5000, mostNodes = 20'000'000;

// Logarithms throughout. A table's probability is the product of C(votes, b) over its conditions,
// divided by C(all votes, all b). A node is a condition and how many b are left for it and those
// behind it.
class FisherSum {
  public:
    FisherSum(const std::vector<std::int64_t>& votes, std::int64_t b) : votes_(votes) {
        const auto conditions = static_cast<std::int64_t>(votes.size());
        behind_.assign(votes.size() + 1, 0);
        for (std::int64_t i = conditions; i-- > 0;)
            behind_[i] = behind_[i + 1] + votes[i];
        factorial_.assign(behind_[0] + 1, 0);
        for (std::int64_t i = 1; i <= behind_[0]; ++i)
            factorial_[i] = factorial_[i - 1] + std::log(static_cast<long double>(i));
        likeliest_.assign(votes.size() + 1, std::vector<double>(b + 1, 0));
        unlikeliest_ = likeliest_;
        for (std::int64_t i = conditions; i-- > 0;)
            for (std::int64_t left = 0; left <= std::min(b, behind_[i]); ++left)
                bound(i, left);
    }

    double choices(std::int64_t n, std::int64_t k) const {
        return static_cast<double>(factorial_[n] - factorial_[k] - factorial_[n - k]);
    }

    // The sum over all tables of at most the product `most`; NaN where there are too many.
    double of(double most, std::int64_t b) {
        most_ = most, all_ = choices(behind_[0], b), nodes_ = 0, sum_ = 0;
        visit(0, b, 0);
        return nodes_ > mostNodes ? std::numeric_limits<double>::quiet_NaN() : sum_;
    }

  private:
    struct Range {
        std::int64_t first, last;
    };
    Range rangeOf(std::int64_t condition, std::int64_t left) const {
        return {std::max<std::int64_t>(0, left - behind_[condition + 1]),
                std::min(left, votes_[condition])};
    }

    void bound(std::int64_t condition, std::int64_t left) {
        double most = -std::numeric_limits<double>::infinity(), least = -most;
        const Range range = rangeOf(condition, left);
        for (std::int64_t b = range.first; b <= range.last; ++b) {
            const double here = choices(votes_[condition], b);
            most = std::max(most, here + likeliest_[condition + 1][left - b]);
            least = std::min(least, here + unlikeliest_[condition + 1][left - b]);
        }
        likeliest_[condition][left] = most, unlikeliest_[condition][left] = least;
    }

    void visit(std::int64_t condition, std::int64_t left, double past) {
        if (++nodes_ > mostNodes || past + unlikeliest_[condition][left] > most_)
            return;
        if (past + likeliest_[condition][left] <= most_) {
            sum_ += std::exp(past + choices(behind_[condition], left) - all_);
            return;
        }
        const Range range = rangeOf(condition, left);
        for (std::int64_t b = range.first; b <= range.last; ++b)
            visit(condition + 1, left - b, past + choices(votes_[condition], b));
    }

    const std::vector<std::int64_t>& votes_;
    std::vector<std::int64_t> behind_;   // votes of a condition and those behind it
    std::vector<long double> factorial_; // log n!
    std::vector<std::vector<double>> likeliest_, unlikeliest_;
    double most_ = 0, all_ = 0, sum_ = 0;
    std::int64_t nodes_ = 0;
};

} // namespace

std::optional<double> fisherP(std::span<const Votes> conditions) {
    std::vector<Votes> used;
    std::copy_if(conditions.begin(), conditions.end(), std::back_inserter(used),
                 [](const Votes& votes) { return votes.total() > 0; });
    std::sort(used.begin(), used.end(),
              [](const Votes& one, const Votes& other) { return one.total() > other.total(); });
    std::int64_t a = 0, b = 0;
    std::vector<std::int64_t> totals;
    for (const Votes& votes : used) {
        a += votes.a, b += votes.b;
        totals.push_back(votes.total());
        if (a + b > mostVotes)
            return std::nullopt;
    }
    if (used.size() < 2 || a == 0 || b == 0)
        return std::nullopt;
    FisherSum sum(totals, b);
    double seen = 0;
    for (const Votes& votes : used)
        seen += sum.choices(votes.total(), votes.b);
    const double p = sum.of(seen + 1e-7, b);
    return std::isnan(p) ? std::nullopt : std::optional(std::min(p, 1.0));
}

} // namespace obscura
