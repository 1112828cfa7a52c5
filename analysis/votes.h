#pragma once

#include "analysis/answers.h"
#include "protocols/reader/manifest.h"

#include "inference/counts.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

// The votes of one condition: which of its two techniques looked more realistic.
struct Tally {
    std::string condition, level, scene, hypothesis, techniqueA, techniqueB;
    Votes votes;
    // The conditions that are corrected together have the same; at first the hypothesis.
    std::string family = hypothesis;
    std::string fault = {}; // why its votes cannot be believed, whatever they are; "" for none
    // Where people voted several times on it, so that their votes depend on each other: the test of
    // their shares against 1/2 (centreTest), and the interval of the mean share.
    struct People {
        double p = 1;
        Interval share;
    };
    std::optional<People> people = {};
    double margin = 0; // declared: within 1/2 -+ that, a split is as good as even; 0: none
    // The same votes by the place that b was shown in; none for published counts.
    Votes bFirst = {}, bSecond = {};
};

// One tally per condition, in the order of the stimuli's manifest (then every condition has one,
// even without votes) or, without a manifest, in `order` and then that
// of their first rows; conditions of one level together.
// Rows that name a condition but describe another pair are an Error, and so, given a manifest, are
// rows whose images are not the manifest's.
std::vector<Tally> tallyVotes(const std::vector<Answer>& answers, const Manifest* stimuli,
                              const std::vector<std::string>& order = {});

// Published counts: condition_id,level,scene,tech_a,tech_b,hypothesis,votes_a,votes_b; or a table
// that this program wrote (votes.csv), of which the same columns are read. In the order of the
// file.
std::vector<Tally> readCounts(const std::filesystem::path& path);

} // namespace obscura
