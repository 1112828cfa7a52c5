#pragma once

#include "image/image.h"

#include <string>
#include <vector>

namespace obscura {

struct MatchPictures {
    std::string title; // plain text
    Image raw, matched;
};

// One test view, a row for each technique, on as many pages as that takes: reference, raw, matched,
// and where the matched one is too dark (red) or too light (blue), full colour at a difference of
// 0.25.
std::vector<Image8> matchSheet(const std::string& title, const Image& reference,
                               const std::vector<MatchPictures>& techniques);

} // namespace obscura
