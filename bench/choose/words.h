#pragma once

#include "bench/choose/choose.h"

#include <string>
#include <vector>

namespace obscura {

// A choice in words, for the terminal and its picture.

const std::string& nameOf(const Candidate& candidate);

// "RMSE at most 0.1, predicted JOD at least 9"
std::string inWords(const Budget& budget);

// The answer, and the numbers that are the reason for it; each a sentence or two.
struct Headline {
    std::string answer, reason;
};
Headline headlineOf(const SweepStudy& study, const Budget& budget, const Choice& choice);

// What became of a measured candidate, in a word or two: "chosen", "over RMSE", "dearer".
std::string fateOf(const Budget& budget, const Choice& choice, const Candidate& candidate);

// The measured candidates, the one that misses its limits by the least first.
std::vector<const Candidate*> nearestFirst(const Budget& budget, const Choice& choice);

// What would admit a measured candidate that missed limits on numbers: "rmse=0.113 would admit it;
// so might 9 views instead of 4 that scatter like these, for its mean meets the limit".
std::string whatWouldAdmit(const Budget& budget, const Candidate& candidate);

} // namespace obscura
