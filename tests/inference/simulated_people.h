#pragma once

#include "tests/inference/trials_28x7.h"

#include "inference/link.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace obscura {

// Simulated people that R makes too: the generator of Park and Miller; person i answers rows(i)
// times, u01() < plogis(b0 + b1 x + sd qnorm(u01())), x = round(4 u01() - 2, 1).
class ParkMiller {
  public:
    explicit ParkMiller(std::uint64_t seed) : state_(seed) {}
    double uniform() {
        state_ = state_ * 16807 % 2147483647;
        return static_cast<double>(state_) / 2147483647;
    }

  private:
    std::uint64_t state_;
};

template <typename Rows>
Study simulatePeople(int persons, Rows rowsOf, double sd, double b0, double b1,
                     std::uint64_t seed) {
    ParkMiller random(seed);
    std::vector<double> x, y;
    Study study;
    for (int i = 0; i < persons; ++i) {
        const double b = sd * quantile(Link::probit, random.uniform());
        for (int j = 0; j < rowsOf(i); ++j) {
            x.push_back(std::round((4 * random.uniform() - 2) * 10) / 10);
            const double share = distribution(Link::logit, b0 + b1 * x.back() + b).below;
            y.push_back(random.uniform() < share ? 1 : 0);
            study.person.push_back(i);
        }
    }
    const auto n = static_cast<Eigen::Index>(x.size());
    study.data.design.resize(n, 2);
    study.data.design.col(0).setOnes();
    study.data.design.col(1) = Eigen::VectorXd::Map(x.data(), n);
    study.data.successes = Eigen::VectorXd::Map(y.data(), n);
    study.data.trials.setOnes(n);
    return study;
}

inline int unequalRows(int person) { return 1 + person * 7 % 9; }
inline Study unbalancedPeople() { return simulatePeople(20, unequalRows, 1.5, 0.3, 0.8, 4242); }

} // namespace obscura
