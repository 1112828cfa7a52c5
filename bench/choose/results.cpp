#include "bench/choose/results.h"

#include <algorithm>

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

} // namespace obscura
