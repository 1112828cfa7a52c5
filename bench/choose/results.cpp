#include "bench/choose/results.h"

#include "bench/choose/choose.h"
#include "bench/sweep/summary.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace obscura {

ViewResult resultOf(const PictureError& matched, const PictureError& lit) {
    ViewResult result;
    result.rmse = matched.rmse;
    result.flip = matched.flip;
    result.litFlip = lit.flip;
    result.jod = lit.jod;
    return result;
}

double promise(const Budget& budget, std::span<const ViewResult> views) {
    double worst = 0;
    for (const Measure& measure : measures())
        if (const auto limit = budget.*measure.limit;
            limit && measure.value != &ViewResult::flicker)
            worst = std::max(worst, measure.distance(meanOf(views, measure.value)) /
                                        std::max(measure.distance(*limit), 1e-9));
    const Measure& by = budget.best ? *budget.best : measureNamed("rmse");
    return worst > 0 ? worst : by.distance(meanOf(views, by.value));
}

double worth(const Budget& budget, const Candidate& candidate) {
    return budget.best ? budget.best->distance(meanOf(candidate.views, budget.best->value))
                       : candidate.milliseconds;
}

double costOf(const Candidate& candidate) {
    return std::isnan(candidate.milliseconds) ? candidate.glanceMilliseconds
                                              : candidate.milliseconds;
}

std::string chosenFrom(const Sweep& sweep, const Budget& budget) {
    std::map<std::string, Candidate> all;
    std::size_t most = 0;
    for (const SweepRow& row : atTypicalSpeed(sweep.rows)) {
        Candidate& candidate = all[row.configuration];
        candidate.milliseconds += row.total.median;
        candidate.views.push_back(resultOf(row.matched, row.litMatched));
        candidate.views.back().milliseconds = row.total.high;
        most = std::max(most, candidate.views.size());
    }
    std::string best;
    for (const auto& [name, candidate] : all)
        if (candidate.views.size() == most && excess(budget, candidate.views).empty() &&
            (best.empty() || worth(budget, candidate) < worth(budget, all[best])))
            best = name;
    return best;
}

} // namespace obscura
