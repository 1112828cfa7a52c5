#include "inference/thurstone_observer.h"

#include "inference/link.h"

#include <algorithm>

namespace obscura {

double ThurstoneObserver::advantage() const {
    constexpr double sure = 1e-12;
    return quantile(Link::probit, std::clamp(0.5 + bias, sure, 1 - sure)) / jodUnit;
}

PairShares ThurstoneObserver::shares(double first, double second, bool mayTie) const {
    const double difference = second - first + advantage();
    const double threshold = mayTie ? unsureWithin : 0;
    const auto answered = [&](double jod) {
        return lapse / (mayTie ? 3 : 2) +
               (1 - lapse) * distribution(Link::probit, jod * jodUnit).below;
    };
    PairShares shares{answered(-difference - threshold), answered(difference - threshold), 0};
    if (mayTie)
        shares.unsure = 1 - shares.first - shares.second;
    return shares;
}

} // namespace obscura
