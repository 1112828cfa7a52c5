#include "analysis/prices/price_axes.h"

#include "analysis/scales/scale_panels.h"
#include "report/axis.h"
#include "report/gnuplot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace obscura {

namespace {

using fmt::format;

constexpr double edge = 0.22;   // inches between the outermost marks and the border
constexpr double column = 0.55; // from a column of its own to the milliseconds
constexpr double leastSpan = 4; // the greatest over the smallest time, at least
constexpr double reach = 2;     // how far intervals show, in multiples of how far values do

// Where the axis is broken: two slashes on a white ground.
std::string breakAt(double x, double width) {
    const double half = 0.035 / width, slope = 0.018 / width;
    std::string script = format("set arrow from graph {:.5f}, graph 0 to graph {:.5f}, graph 0 "
                                "nohead front linewidth 3 linecolor rgb 'white'\n",
                                x - half, x + half);
    for (const double at : {x - half, x + half})
        script += format("set arrow from graph {:.5f}, graph -0.018 to graph {:.5f}, graph 0.018 "
                         "nohead front linewidth 1 linecolor rgb '#555555'\n",
                         at - slope, at + slope);
    return script;
}

} // namespace

PriceAxes::PriceAxes(const std::vector<const PricedScale*>& scales, double width, double height,
                     double headroom)
    : width_(width), height_(height) {
    least_ = 1e300;
    double lowest = 0, highest = 0;
    for (const PricedScale* scale : scales)
        for (const Priced& one : scale->techniques) {
            hasFree_ = hasFree_ || one.milliseconds == 0;
            hasUntimed_ = hasUntimed_ || !one.milliseconds;
            if (one.milliseconds.value_or(0) > 0) {
                least_ = std::min(least_, *one.milliseconds);
                most_ = std::max(most_, *one.milliseconds);
            }
            lowest = std::min({lowest, one.people, one.predicted.value_or(0)});
            highest = std::max({highest, one.people, one.predicted.value_or(0)});
        }
    const double middle = std::sqrt(least_ * most_), half = std::sqrt(leastSpan);
    least_ = std::min(least_, middle / half);
    most_ = std::max(most_, middle * half);
    begin_ = edge + (hasFree_ ? column : 0);
    end_ = width - edge - (hasUntimed_ ? column : 0);

    const double far = reach * std::max(highest - lowest, 0.5);
    lowest_ = lowest;
    highest_ = highest;
    for (const PricedScale* scale : scales)
        for (const Priced& one : scale->techniques) {
            const double low = one.interval.low.value_or(one.people),
                         high = one.interval.high.value_or(one.people);
            lowest_ = std::min(lowest_, std::max(low, lowest - far));
            highest_ = std::max(highest_, std::min(high, highest + far));
        }
    const double margin = 0.06 * (highest_ - lowest_);
    lowest_ -= margin;
    highest_ += margin;
    highest_ += (highest_ - lowest_) * headroom / (height - headroom);
}

double PriceAxes::x(const Priced& priced) const {
    if (!priced.milliseconds)
        return width_ - edge;
    if (*priced.milliseconds == 0)
        return edge;
    return placeOf(*priced.milliseconds);
}

double PriceAxes::placeOf(double milliseconds) const {
    return begin_ + (end_ - begin_) * std::log(milliseconds / least_) / std::log(most_ / least_);
}

double PriceAxes::y(double jod) const { return height_ * (jod - lowest_) / (highest_ - lowest_); }

double PriceAxes::seen(double jod) const { return std::clamp(jod, lowest_, highest_); }

double PriceAxes::milliseconds(double x) const {
    return least_ * std::pow(most_ / least_, (x - begin_) / (end_ - begin_));
}

// 1, then 2 and 5, then the others have their labels as long as there is room.
std::vector<std::string> PriceAxes::ticks() const {
    const double room = 0.36;
    const double ends[] = {least_, most_};
    const std::vector<Tick> all = logarithmicAxis(ends).ticks;
    std::vector<double> labelled;
    if (hasFree_)
        labelled.push_back(edge);
    if (hasUntimed_)
        labelled.push_back(width_ - edge - 0.15);
    std::vector<std::string> texts(all.size());
    for (const std::string_view digits : {"1", "25", "346789"})
        for (std::size_t i = 0; i < all.size(); ++i) {
            const std::string text = format("{:g}", all[i].value);
            const double x = placeOf(all[i].value);
            if (digits.find(text[text.find_first_of("123456789")]) != digits.npos &&
                std::all_of(labelled.begin(), labelled.end(),
                            [&](double other) { return std::abs(other - x) > room; })) {
                labelled.push_back(x);
                texts[i] = text;
            }
        }
    std::vector<std::string> ticks;
    for (std::size_t i = 0; i < all.size(); ++i)
        ticks.push_back(format("'{}' {} {}", texts[i], all[i].value, texts[i].empty() ? 1 : 0));
    return ticks;
}

std::string PriceAxes::script() const {
    std::vector<std::string> marks = ticks();
    std::string script;
    if (hasFree_) {
        marks.push_back(format("'free' {}", milliseconds(edge)));
        script += breakAt((edge + begin_ - 0.1) / 2 / width_ + 0.05 / width_, width_);
    }
    if (hasUntimed_) {
        marks.push_back(format("'reference' {}", milliseconds(width_ - edge)));
        script += breakAt((end_ + width_ - edge) / 2 / width_, width_);
    }
    return script + format("set logscale x\nset xrange [{}:{}]\nset xtics nomirror out ({})\n"
                           "set yrange [{}:{}]\nset ytics nomirror out {}\n",
                           milliseconds(0), milliseconds(width_), fmt::join(marks, ", "), lowest_,
                           highest_, tickStep(0.6 * (highest_ - lowest_)));
}

} // namespace obscura
