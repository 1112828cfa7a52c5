#pragma once

#include "analysis/answers.h"
#include "analysis/flow.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace obscura {

// How a study was run, as far as its rows show: who took part, whether the orders were balanced,
// what the display did, how long people looked. All counts are of counted trials, unless said.

struct Percentiles {
    double low = 0, median = 0, high = 0; // 5th, 50th and 95th percentile
};

// `values` is not empty.
Percentiles spread(const std::vector<double>& values);

struct Conduct {
    struct Sessions {
        int base = 0, exchanged = 0; // the images of every pair in the protocol's order, or swapped
    };
    struct Shown {
        int bFirst = 0, bSecond = 0;             // trials
        int bChosenFirst = 0, bChosenSecond = 0; // of those, with an answer for b
    };

    int files = 0, participants = 0, sessions = 0, trials = 0, simulated = 0, interrupted = 0;
    int incomplete = 0; // sessions with fewer trials than the longest one
    int mostVotes = 0;  // of one participant on one condition; the tests assume 1
    LeftOut leftOut;
    Flow flow;
    int earlierFiles = 0; // of an earlier version's format
    std::vector<BadRow> bad;

    int secondChosen = 0;               // trials in which the image shown second was chosen
    std::map<std::string, Shown> shown; // by condition
    std::map<int, Sessions> squares;    // by square
    std::map<int, int> slots;           // sessions by slot

    std::map<std::string, int> timestampSources; // trials by source
    double slowestHz = 0, fastestHz = 0;
    int wrongMasks = 0;   // trials whose mask lasted other than the planned number of refreshes
    int missedFrames = 0; // trials with a missed frame
    int earlyPresses = 0; // trials with a key press during the mask
    Percentiles maskMs, view1Ms, view2Ms, decisionMs;
    std::map<int, int> maskTimes;  // trials by duration of the mask, whole milliseconds
    std::map<int, int> maskFrames; // trials by refreshes of the mask beyond those planned
    std::map<int, int> missed;     // trials by missed frames

    std::set<std::string> changedImages; // conditions whose image files differ between trials
    std::set<std::string> protocols, programs, machines;
    std::string firstTime, lastTime; // UTC
};

Conduct conductOf(const Answers& answers);

// The same in words, for readers.
struct Fact {
    std::string name, text;
};
std::vector<Fact> factsOf(const Conduct& conduct);

} // namespace obscura
