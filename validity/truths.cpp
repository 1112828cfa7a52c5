#include "validity/truths.h"

#include "inference/tails.h"
#include <fmt/format.h>

#include <cmath>

namespace obscura {

namespace {

constexpr const char* text = R"(name = "validity"
title = "Known answers"
seed = 13
[scenes.s]
builtin = "sculpture"
camera = { position = [0, 1, 3], target = [0, 0.5, 0] }
radius = 0.5
[levels.low]
ambient = [1, 1, 1]
[levels.moderate]
ambient = [1, 1, 1]
[levels.high]
ambient = [1, 1, 1]
[techniques.x]
technique = "none"
[techniques.y]
technique = "crytek"
[trial]
mask = 0.1
[texts]
instructions = "i"
thanks = "t"
start = "s"
question = "q"
first = "1"
second = "2"
)";

constexpr const char* claims = R"([[claims]]
name = "one condition"
kind = "superior"
conditions = ["c1"]
[[claims]]
name = "four conditions"
kind = "superior"
conditions = ["c1", "c2", "c3", "c4"]
[[claims]]
name = "trend over two"
kind = "trend"
conditions = ["c1", "c7"]
scores = [1, 3]
[[claims]]
name = "trend over three"
kind = "trend"
conditions = ["c1", "c4", "c7"]
scores = [1, 2, 3]
[[claims]]
name = "equivalence"
kind = "equivalent"
conditions = ["c5"]
margin = 0.25
)";

// For two conditions: with repeats these are other tests.
constexpr const char* claimsOfTwo = R"([[claims]]
name = "one condition"
kind = "superior"
conditions = ["c1"]
[[claims]]
name = "trend over two"
kind = "trend"
conditions = ["c1", "c2"]
scores = [1, 2]
)";

// One that compares techniques a and b.
std::string condition(std::size_t number, std::string_view level, char a, char b) {
    return fmt::format("[[conditions]]\nid = \"c{}\"\nscene = \"s\"\nlevel = \"{}\"\n"
                       "pair = [\"{}\", \"{}\"]\nhypothesis = \"H\"\n",
                       number, level, a, b);
}

bool isOf(const std::string& test, std::initializer_list<std::string_view> kinds) {
    for (const std::string_view kind : kinds)
        if (test.find(kind) != std::string::npos)
            return true;
    return false;
}

bool isEquivalence(const std::string& test) { return isOf(test, {"equivalence"}); }

constexpr std::string_view ladder = "xyvw"; // its techniques

// Shares by Thurstone's Case V, in the order of the ladder's pairs.
Truth onScale(const std::vector<double>& scale) {
    Truth truth;
    for (std::size_t b = 1; b < scale.size(); ++b)
        for (std::size_t a = 0; a < b; ++a)
            truth.shares.push_back(
                0.5 * std::erfc(-(scale[b] - scale[a]) * probit(0.75) / std::sqrt(2.0)));
    return truth;
}

// All conditions alike, but for c5, which the claim of equivalence names.
Truth alike(double share, double spread, double bias) {
    return {std::vector<double>(7, share), spread, bias};
}

} // namespace

Protocol validityProtocol() {
    std::string all;
    const char* levels[] = {"low", "low", "low", "moderate", "moderate", "high", "high"};
    for (std::size_t i = 0; i < std::size(levels); ++i)
        all += condition(i + 1, levels[i], 'x', 'y');
    return parseProtocol(fmt::format("{}[ordering]\nparticipants = 28\n{}{}", text, claims, all),
                         "validity.toml");
}

Protocol repeatedProtocol() {
    return parseProtocol(fmt::format("{}[ordering]\nparticipants = 28\nrepeats = 2\n{}{}{}", text,
                                     claimsOfTwo, condition(1, "low", 'x', 'y'),
                                     condition(2, "high", 'x', 'y')),
                         "repeated.toml");
}

Protocol ladderProtocol() {
    std::string all = "[techniques.v]\ntechnique = \"crytek\"\n"
                      "[techniques.w]\ntechnique = \"crytek\"\n";
    std::size_t number = 0;
    for (std::size_t b = 1; b < ladder.size(); ++b)
        for (std::size_t a = 0; a < b; ++a)
            all += condition(++number, "low", ladder[a], ladder[b]);
    return parseProtocol(fmt::format("{}[ordering]\nparticipants = 24\n{}", text, all),
                         "ladder.toml");
}

std::vector<World> worlds() {
    const std::vector<double> equal(4, 0), rising = {0, 0.5, 1, 1.5};
    const auto everything = [](const std::string&) { return true; };
    return {
        {"guessing", "everybody guesses", alike(0.5, 0, 0),
         [](const std::string& test) { return !isEquivalence(test); }},
        {"people differ",
         "each condition splits evenly, but people lean towards b or a by 1 JOD (standard "
         "deviation)",
         alike(0.5, 1, 0),
         [](const std::string& test) {
             return !isEquivalence(test) && !isOf(test, {"test people"});
         }},
        {"position bias", "nobody prefers b or a, but the second image is chosen in 60 %",
         alike(0.5, 0, 0.1),
         [](const std::string& test) { return !isEquivalence(test) && !isOf(test, {"position"}); }},
        {"effect", "b is chosen in 75 % of all conditions, people differ by 1 JOD",
         alike(0.75, 1, 0),
         [](const std::string& test) {
             return isEquivalence(test) || // at its very margin
                    isOf(test, {"trend", "cochran", "mcnemar", "homogeneity", "position",
                                ", conditions"});
         }},
        {"guessing twice",
         "everybody guesses, at two levels, each answered twice",
         {{0.5, 0.5}, 0, 0},
         everything,
         repeatedProtocol},
        {"people differ, twice",
         "the same, but people lean towards b or a by 1 JOD (standard deviation)",
         {{0.5, 0.5}, 1, 0},
         [](const std::string& test) {
             return !isOf(test, {"test people", "repeats"});
         },
         repeatedProtocol},
        {"ladder, guessing", "all pairs of four techniques that look alike, everybody guesses",
         onScale(equal), everything, ladderProtocol, 24, 10, equal},
        {"ladder",
         "all pairs of four techniques that lie at 0, 0.5, 1, and 1.5 JOD by Thurstone's Case V",
         onScale(rising),
         [](const std::string& test) {
             return isOf(test, {"position", "place", "fit"});
         },
         ladderProtocol, 24, 10, rising},
    };
}

} // namespace obscura
