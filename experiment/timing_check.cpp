#include "experiment/timing_check.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

std::string bufferingOf(const DisplayCheck& check) {
    if (!check.queued)
        return "unknown";
    return *check.queued == 0   ? "double"
           : *check.queued == 1 ? "triple"
                                : fmt::format("{} buffers", *check.queued + 2);
}

std::string compositorOf(const DisplayCheck& check) {
    if (!check.compositor)
        return "unknown";
    return *check.compositor ? "runs; asked to leave the window alone" : "none";
}

std::string rateOf(const DisplayCheck& check) {
    if (!check.variable)
        return "unknown";
    return *check.variable ? "was asked for by the driver; forbidden" : "not asked for";
}

std::string vsyncOf(const DisplayCheck& check) {
    return check.unsynchronised.empty() ? "honoured" : "not honoured: " + check.unsynchronised;
}

int percent(double scale) { return static_cast<int>(std::lround(100 * scale)); }

} // namespace

std::optional<int> queuedSwaps(const std::vector<double>& intervalsAfterPause, double hz) {
    const auto waits = [&](double interval) { return interval * hz > 0.5; };
    const auto first = std::find_if(intervalsAfterPause.begin(), intervalsAfterPause.end(), waits);
    if (first == intervalsAfterPause.end())
        return std::nullopt;
    return static_cast<int>(first - intervalsAfterPause.begin());
}

bool plausible(const std::vector<gl::Onset>& onsets, const std::vector<double>& now,
               int reportedHz) {
    for (std::size_t i = 0; i < onsets.size(); ++i) {
        if (onsets[i].blanks <= 0 || onsets[i].time > now[i])
            return false;
        if (i == 0)
            continue;
        const auto blanks = static_cast<double>(onsets[i].blanks - onsets[i - 1].blanks);
        const double expected = blanks / reportedHz;
        if (blanks < 1 ||
            std::abs(onsets[i].time - onsets[i - 1].time - expected) > 0.05 * expected)
            return false;
    }
    return !onsets.empty();
}

std::string objectionTo(const DisplayCheck& check) {
    if (percent(check.contentScale) != 100)
        return fmt::format(
            "the desktop is scaled to {} %, with which images may be enlarged or shown late. Set "
            "it to 100 % in the desktop's display settings (or Xft.dpi to 96) and start again",
            percent(check.contentScale));
    if (check.colourBits != std::array{8, 8, 8})
        return fmt::format("the window has {}, {} and {} bits of red, green and blue, but images "
                           "have 8 of each. Set the screen to 24 bits a pixel and start again",
                           check.colourBits[0], check.colourBits[1], check.colourBits[2]);
    return "";
}

nlohmann::ordered_json spell(const DisplayCheck& check) {
    return {{"flips", check.flips.count},
            {"mean_ms", 1000 * check.flips.mean},
            {"deviation_ms", 1000 * check.flips.deviation},
            {"least_ms", 1000 * check.flips.least},
            {"most_ms", 1000 * check.flips.most},
            {"vsync", vsyncOf(check)},
            {"buffering", bufferingOf(check)},
            {"compositor", compositorOf(check)},
            {"content_scale", check.contentScale},
            {"colour_bits", check.colourBits},
            {"variable_refresh", rateOf(check)}};
}

std::string inWords(const DisplayCheck& check) {
    return fmt::format(
        "{} swaps took {:.3f} ms each (sd {:.3f}; the mode says {} Hz); v-sync {}; buffering: {}; "
        "compositor: {}; scale {} %; {} bits a pixel; variable refresh: {}",
        check.flips.count, 1000 * check.flips.mean, 1000 * check.flips.deviation, check.reportedHz,
        vsyncOf(check), bufferingOf(check), compositorOf(check), percent(check.contentScale),
        check.colourBits[0] + check.colourBits[1] + check.colourBits[2], rateOf(check));
}

} // namespace obscura
