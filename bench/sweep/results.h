#pragma once

#include "bench/sweep/row.h"

#include <map>
#include <string>
#include <vector>

namespace obscura {

// What the units of a sweep leave (units.h), as JSON and back: no names of what was measured, for
// the plan has those. Numbers are read back exactly; null is NaN. An Error says that a text is
// none of these.

using Fitted = std::map<std::string, double>; // values of settings
std::string fitResult(const Fitted& fitted);
Fitted fitIn(const std::string& result);

// Errors and thumbnail of one row, and the renderer that they were measured with.
struct ErrorsResult {
    SweepErrors errors;
    std::string renderer;
};
std::string errorsResult(const ErrorsResult& errors);
ErrorsResult errorsIn(const std::string& result);

// Times of the rows of a group, or how cost grows, and what they were measured on.
struct TimesResult {
    TimedOn machine;
    std::vector<SweepTimes> rows;
    std::vector<GrowthRow> growth;
};
std::string timesResult(const TimesResult& times);
TimesResult timesIn(const std::string& result);

} // namespace obscura
