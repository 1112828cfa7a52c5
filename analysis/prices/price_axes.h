#pragma once

#include "analysis/prices/prices.h"

#include <string>
#include <vector>

namespace obscura {

// The plot of a chart of prices: milliseconds along a logarithmic axis, with columns of their own
// for what is free, at the left, and for a reference that nobody timed, at the right; JOD upwards.
// Lengths are inches from the plot's lower left corner.
class PriceAxes {
  public:
    // `headroom`: inches above all data.
    PriceAxes(const std::vector<const PricedScale*>& scales, double width, double height,
              double headroom);

    double x(const Priced& priced) const;
    double y(double jod) const;
    // Within the axis, for what reaches beyond it.
    double seen(double jod) const;
    // The number that the axis of milliseconds has at such a place.
    double milliseconds(double x) const;

    double width() const { return width_; }
    double height() const { return height_; }
    // Ranges, ticks and the breaks before and after the milliseconds, for gnuplot.
    std::string script() const;

  private:
    double placeOf(double milliseconds) const;
    std::vector<std::string> ticks() const;

    double width_, height_;
    double least_ = 0, most_ = 0;     // milliseconds
    double begin_ = 0, end_ = 0;      // where these stand
    double lowest_ = 0, highest_ = 0; // JOD
    bool hasFree_ = false, hasUntimed_ = false;
};

} // namespace obscura
