#pragma once

#include "protocols/reader/screen.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>

namespace obscura {

// How large a screen is, by somebody's word: the person who held a card to it, or a ruler. What the
// monitor itself reports is not believed: it may be that of another panel, or of a paper size.
struct ScreenSize {
    double pixelsPerMm = 0;
    std::string source; // "card on 2026-11-29T...", "--screen-mm"
};

// Of "598x336" and the monitor's mode. An Error when it is no size, or its pixels would not be
// square to 3 %.
ScreenSize screenSizeOf(const std::string& millimetres, int width, int height);

// A session's images as an eye in front of the middle of the screen has them.
struct Viewing {
    ScreenNeeds needs;
    std::optional<ScreenSize> size; // none: not known
    int width = 0, height = 0;      // of an image, pixels

    bool known() const { return size && needs.distanceCm > 0; }
    // Of the middle degree, half of it to either side of the line of sight: 2 d tan(1/2 degree), d
    // being the distance in pixels.
    double pixelsPerDegree() const;
    double degrees(int pixels) const; // 2 atan(pixels / 2 d)
};

// What a study wants of it and does not get, and at what distance it would; "" if nothing. Degrees
// may be off by 5 %.
std::string objectionTo(const Viewing& viewing);

std::string inWords(const Viewing& viewing); // "" where nothing is known
void describe(const Viewing& viewing, nlohmann::ordered_json& sidecar);

} // namespace obscura
