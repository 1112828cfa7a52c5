#pragma once

#include "analysis/people.h"
#include "analysis/study_tests.h"

#include <string>
#include <vector>

namespace obscura {

// What stands above all results: that people lean to one place, and which shares are others once
// that is allowed for.
std::vector<std::string> peopleCautions(const People& people, const std::vector<Tally>& tallies,
                                        const std::vector<Tested>& tests);

// In words: whether even splits are guessing or camps, flagged times, and whether results stand if
// people's reliability is allowed for.
std::vector<std::string> peopleSentences(const People& people, const std::vector<Tally>& tallies,
                                         const std::vector<Tested>& tests);

} // namespace obscura
