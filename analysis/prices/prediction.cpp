#include "analysis/prices/prediction.h"

#include "analysis/scales/scale_words.h"

#include <set>

namespace obscura {

Prediction predictionOf(const std::vector<PricedScale>& scales) {
    Prediction prediction;
    std::vector<double> predicted, people;
    std::set<std::string> places;
    for (const PricedScale& scale : scales) {
        if (scale.group.isPooled())
            continue;
        for (std::size_t i = 0; i < scale.techniques.size(); ++i) {
            const Priced& one = scale.techniques[i];
            if (i == scale.reference || !one.predicted)
                continue;
            const std::string place = placeOf(scale.group);
            places.insert(place);
            prediction.points.push_back(
                {place, one.name, *one.predicted, one.people, one.interval});
            predicted.push_back(*one.predicted);
            people.push_back(one.people);
        }
    }
    prediction.places = places.size();
    prediction.line = pearson(predicted, people);
    prediction.ranks = spearman(predicted, people);
    return prediction;
}

} // namespace obscura
