#include "bench/sweep/speed.h"

#include "base/percentile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace obscura {

namespace {

using Key = std::tuple<std::string, std::string, int, int, double>;
Key viewOf(const SweepRow& row) { return {row.scene, row.view, row.width, row.height, row.radius}; }

bool hasAnchor(const SweepRow& row) { return row.total.median > 0 && row.toStarcraft > 0; }
double anchorOf(const SweepRow& row) { return row.total.median / row.toStarcraft; }

// What the anchor takes in each view's median row.
std::map<Key, double> typicalAnchors(std::span<const SweepRow> rows) {
    std::map<Key, std::vector<double>> times;
    for (const SweepRow& row : rows)
        if (hasAnchor(row))
            times[viewOf(row)].push_back(anchorOf(row));
    std::map<Key, double> typical;
    for (auto& [view, milliseconds] : times)
        typical[view] = percentile(std::move(milliseconds), 0.5);
    return typical;
}

} // namespace

std::vector<SweepRow> atTypicalSpeed(std::vector<SweepRow> rows) {
    const std::map<Key, double> typical = typicalAnchors(rows);
    for (SweepRow& row : rows) {
        if (!hasAnchor(row))
            continue;
        const double factor = typical.at(viewOf(row)) / anchorOf(row);
        for (double* time : {&row.total.median, &row.total.low, &row.total.high, &row.gbuffer})
            *time *= factor;
        for (double& time : row.work)
            time *= factor;
    }
    return rows;
}

Straying strayingOf(std::span<const SweepRow> rows) {
    const std::map<Key, double> typical = typicalAnchors(rows);
    Straying all;
    double sum = 0, count = 0;
    for (const SweepRow& row : rows) {
        if (!hasAnchor(row))
            continue;
        const double speed = anchorOf(row) / typical.at(viewOf(row));
        const double repeat =
            std::isnan(row.starcraftRepeat) ? 0 : std::abs(row.starcraftRepeat - 1);
        const double own = std::max(std::abs(speed - 1), repeat);
        all.fastest = std::min(all.fastest, speed);
        all.slowest = std::max(all.slowest, speed);
        all.repeat = std::max(all.repeat, repeat);
        if (own > all.most) {
            all.most = own;
            all.view = row.view;
        }
        sum += own;
        ++count;
    }
    all.mean = count > 0 ? sum / count : 0;
    return all;
}

std::string warningOf(const Straying& straying) {
    if (!straying.isTooMuch())
        return {};
    const std::string repeat =
        straying.repeat > 0.05
            ? fmt::format(" Even within one group its odd rounds differ from its even ones by up "
                          "to {:.0f} %.",
                          100 * straying.repeat)
            : "";
    return fmt::format(
        "The machine was busy while this was timed: starcraft with 16 samples, which runs beside "
        "every configuration, took {:.0f} to {:.0f} % of its usual time (farthest off in view "
        "{}).{} Times are scaled by it, and are trusted to ±{:.1f} %, by which it was off on "
        "average: what is nearer than that in time is not told apart.",
        100 * straying.fastest, 100 * straying.slowest, straying.view, repeat, 100 * straying.mean);
}

} // namespace obscura
