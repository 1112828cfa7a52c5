#pragma once

#include "analysis/scales/trial_answers.h"
#include "analysis/votes.h"
#include "protocols/reader/manifest.h"

#include "inference/mlds.h"
#include "inference/plackett_luce.h"
#include "inference/psychometric_model.h"
#include "inference/scales.h"
#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace obscura {

// A study's answers as scales want them: sorted by question, scene and level, items and people
// numbered from 0.

// What has one scale: the answers to one question, in one scene and level or in all of them
// together (scene and level are "" then).
struct ScaleGroup {
    std::string question, scene, level;
    std::vector<std::string> items; // techniques, in the protocol's order
    int people = 0;                 // 0 where nobody knows who answered
    int answers = 0;                // counted
    int open = 0;                   // questions that were left unanswered
    std::vector<std::string> notes = {};

    bool isPooled() const { return scene.empty() && level.empty(); }
};

// Which of two. wins(i, j): i was chosen over j; ties are symmetric.
struct Comparisons : ScaleGroup {
    Wins wins{};
    Eigen::MatrixXd ties{};
    bool mayTie = false;        // "not sure" could be answered
    std::vector<Wins> winsOf{}; // by person; empty where they are too many, or not known
    std::vector<Eigen::MatrixXd> tiesOf{};
    int second = 0, placed = 0; // the second place was chosen, of so many; 0 where not known here

    // Which was chosen because it differs more from a source; then plain and boosted trials apart.
    std::string source{}; // the source's technique; "" for other comparisons
    bool isBoosted = false;
};

// Numbers for single images, or for the second of two compared with the first.
struct Ratings : ScaleGroup {
    struct Rating {
        int person = 0, item = 0;
        int than = -1; // compared: `item` is so much better than this
        double value = 0;
        bool itemSecond = true; // compared: it was shown second
    };
    std::vector<Rating> ratings{};
    bool isComparison = false;
    std::optional<std::pair<int, int>> range{}; // of a scale of steps
};

struct Rankings : ScaleGroup {
    std::vector<Ranking> rankings{};
    std::vector<int> person{}; // of each
};

// Which difference is larger, that of a and b or that of b and c; items by rising amount.
struct Triads : ScaleGroup {
    std::vector<Quadruple> triads{};
    std::vector<int> person{};
};

// Answers against a number; guessing gives `guess` of them.
struct Ladder : ScaleGroup {  // items are the steps
    std::string axis{};       // what the number is
    bool isPredicted = false; // it is a difference in predicted JOD
    bool isOrder = false;     // it is only the place in the protocol's order
    bool isFalling = false;   // the share falls with it: levels are negated
    double guess = 0;
    PsychometricData data{};
    std::vector<std::string> labels{}; // of each level
    std::string success{};             // what is counted: "right answers"
    bool isAdaptive = false;
};

struct ScaleData {
    std::vector<Comparisons> comparisons{};
    std::vector<Ratings> ratings{};
    std::vector<Rankings> rankings{};
    std::vector<Triads> triads{};
    std::vector<Ladder> ladders{};
    std::vector<std::string> notes{}; // what has no scale, and why
};

// Of rows of pairs: wins from the tallies, people from `answers` (null for published counts) where
// they are few enough for resampling. Only groups of three techniques and more: of two, the table
// of votes says all. `stimuli` may be null.
ScaleData scaleData(const std::vector<Tally>& tallies, const std::vector<Answer>* answers,
                    const Manifest* stimuli);

// Of other trials: what each question is follows from its kind, its roles and the study's design.
ScaleData scaleData(const TrialAnswers& study, const Manifest* stimuli);

// How the images of two roles differ, as a number against which choices are held: the one place
// that knows which. Of a measure the value of b less that of a.
struct StimulusMeasure {
    const char* name;                                // of the difference
    std::optional<double> (*of)(const ImageRecord&); // absent where it is not known
    bool isPredicted;                                // JOD
};
// Those that stimuli have of all their images, the best first: predicted JOD and RMSE of visibility
// against the reference or, in manifests without these, mean occlusion. None without stimuli.
std::vector<const StimulusMeasure*> stimulusMeasures(const Manifest* stimuli);
std::optional<double> stimulusDifference(const Manifest& stimuli, const StimulusMeasure& measure,
                                         const std::string& condition, const std::string& a,
                                         const std::string& b);

} // namespace obscura
