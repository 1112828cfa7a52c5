#pragma once

#include "analysis/findings.h"

#include <string>

namespace obscura {

// A line for each person; and one for each measure of time, with the flags of each rule. Of
// findings that know people.
std::string peopleCsv(const Findings& findings);
std::string timesCsv(const Findings& findings);

} // namespace obscura
