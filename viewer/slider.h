#pragma once

#include "renderer/techniques/technique.h"

#include <string>
#include <string_view>

namespace obscura {

// What a parameter of the technique table is as a slider, without drawing it.

// Between `low` and `high`. A slider is even in the value; or in its logarithm, where the range is
// above zero and spans more than two decades; or in its inverse hyperbolic sine, where the range
// has zero in it and reaches to 10 or more: that is fine near zero and coarse far away, to both
// sides.
struct Scale {
    enum class Kind { even, logarithmic, aroundZero };
    Kind kind = Kind::even;
    double low = 0, high = 1;
    bool whole = false;
};
Scale scaleOf(const Parameter& parameter);
Scale scaleBetween(double low, double high, bool whole = false);

double positionOf(const Scale& scale, double value); // 0 ... 1
double valueAt(const Scale& scale, double position); // rounded to three digits, or whole

// Three significant digits and no more noughts than needed ("0.025", "1.7", "16384"), with the
// unit's sign ("1.7 m", "30°", "4 px").
std::string valueText(double value, Unit unit);

// A name of the table as people read it: "radiusMultiplier" is "Radius multiplier".
std::string inWords(std::string_view name);

// What a tooltip says: meaning, then key, unit, range and default, then the source.
std::string meaningOf(const Parameter& parameter);

} // namespace obscura
