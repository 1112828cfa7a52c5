#pragma once

#include "analysis/response_times.h"

#include "inference/observers.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

// Who answered, and how: nothing here leaves anybody out.
struct Person {
    Symbol study, participant;
    int sessions = 0;
    Votes places;           // a: first chosen, b: second chosen
    double p = 1, holm = 1; // exact, of those; adjusted for the number of people
    Votes repeats;          // pairs of answers to one condition: a disagree, b agree
    double view1Ms = 0, view2Ms = 0, decisionMs = 0; // medians
    int flaggedTimes = 0;                            // decisions, by the default rule
    std::optional<ObserverTraits> observer;          // where the model is fitted

    std::int64_t trials() const { return places.total(); }
};

// What to look at: "position" (one place is chosen more than chance, after Holm), "repeats"
// (of five pairs or more, at most half agree), "times" (a fifth of the decisions or more is
// flagged).
std::vector<std::string> flagsOf(const Person& person);

struct People {
    std::vector<Person> persons; // in the order of their first answers
    ResponseTimes times;
    // By tally, the share of b for a typical observer without bias and lapses (observerModel, all
    // conditions together), and 95 %; empty where the model is not fitted.
    std::vector<std::optional<EstimatedShare>> observers;
};

// Of at least one answer; `tallies` are theirs. Takes time that grows with the answers, except for
// the observers' model, which more than 100,000 answers do without.
People peopleOf(const std::vector<Answer>& answers, const std::vector<Tally>& tallies);

} // namespace obscura
