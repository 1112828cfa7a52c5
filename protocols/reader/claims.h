#pragma once

#include "base/error.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace obscura {

class TomlTable;

// [[claims]]: what a study of pairs is made to show, declared before its data and hashed with its
// design. analysis/claims.h tests them.
struct Claim {
    // superior: one role's images are chosen more often over these conditions;
    // equivalent: in each of them, the share of b is within 1/2 -+ margin;
    // trend: the share of a role's images rises with the scores of the conditions.
    enum class Kind { superior, equivalent, trend };

    std::string name; // unique: a phrase that can stand in a report
    Kind kind = Kind::superior;
    std::vector<std::string> conditions; // ids
    std::string favours = "b";           // superior, trend: the role, "a" or "b"
    double margin = 0;                   // equivalent: 0.01 ... 0.49
    // trend: of each condition, such as its level's rank or its image's error
    std::vector<double> scores;
    std::string family; // claims of one family are corrected together; "": those that name none
    Place place;

    bool operator==(const Claim& other) const; // all but the place
};
const std::vector<std::string>& claimKindNames(); // in the order of the enumeration

// [exclusions]: whose answers do not count, and which. The defaults leave out but
// those whose place another takes.
struct ExclusionRules {
    double catches = 0;       // sessions with a smaller share of right answers to catch trials
    double onePosition = 1;   // people with a larger share of choices of one position
    double fastest = 0;       // answers given within fewer seconds after the question
    bool incomplete = false;  // sessions with fewer trials than the longest one
    bool interrupted = false; // trials during which the window lost the keyboard
    bool wrongMasks = false;  // trials whose mask had other than the planned refreshes
    bool voided = true;       // sessions whose slot went back: another person sees the same order

    bool operator==(const ExclusionRules&) const = default;
};

// What [[claims]] may speak of.
struct ClaimedCondition {
    std::string id, level;
    bool isPair = false; // a choice between a and b
};
std::vector<Claim> parseClaims(TomlTable& root, const std::vector<ClaimedCondition>& conditions);
ExclusionRules parseExclusions(TomlTable table);

// What the analysis asks of a study's design.
struct Declared {
    std::string sha256;             // as in the rows' design_sha256
    std::vector<std::string> order; // ids of conditions, as in the protocol
    std::vector<Claim> claims;
    ExclusionRules exclusions;
    std::map<std::string, std::string> correct; // the right answer to a condition, where it has one
};

// From design.json, which obscura-experiment keeps beside the answers. An Error names `file` when
// the text is none of it.
Declared declaredIn(std::string_view text, const std::string& file);

} // namespace obscura
