#pragma once

#include "analysis/prices/prediction.h"
#include "analysis/prices/prices.h"

#include <string>
#include <vector>

namespace obscura {

// Prices in words.

// "free", "1.2 ms" or "not timed".
std::string priceText(const Priced& priced);

// From where on more milliseconds bought nothing, or that they always did: one sentence.
std::string plateauSentence(const PricedScale& scale);

// How closely predictions and people go together; "" where there are too few techniques.
std::string predictionSentence(const Prediction& prediction);

// One sentence for each scale, that of all scenes first, or why there is no chart; then that of
// predictions.
std::vector<std::string> priceSentences(const std::vector<PricedScale>& scales);

} // namespace obscura
