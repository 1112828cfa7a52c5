#include "validity/truths.h"

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
[ordering]
participants = 28
[texts]
instructions = "i"
thanks = "t"
start = "s"
question = "q"
first = "1"
second = "2"
[[claims]]
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

bool isOf(const std::string& test, std::initializer_list<std::string_view> kinds) {
    for (const std::string_view kind : kinds)
        if (test.find(kind) != std::string::npos)
            return true;
    return false;
}

bool isEquivalence(const std::string& test) { return isOf(test, {"equivalence"}); }

// All conditions alike, but for c5, which the claim of equivalence names.
Truth alike(double share, double spread, double bias) {
    return {std::vector<double>(7, share), spread, bias};
}

} // namespace

Protocol validityProtocol() {
    std::string conditions;
    const char* levels[] = {"low", "low", "low", "moderate", "moderate", "high", "high"};
    for (int i = 0; i < 7; ++i)
        conditions += std::string("[[conditions]]\nid = \"c") + std::to_string(i + 1) +
                      "\"\nscene = \"s\"\nlevel = \"" + levels[i] +
                      "\"\npair = [\"x\", \"y\"]\nhypothesis = \"H\"\n";
    return parseProtocol(text + conditions, "validity.toml");
}

std::vector<World> worlds() {
    return {
        {"guessing", "everybody guesses", alike(0.5, 0, 0),
         [](const std::string& test) { return !isEquivalence(test); }},
        {"people differ",
         "each condition splits evenly, but people lean towards b or a by 1 JOD (standard "
         "deviation)",
         alike(0.5, 1, 0),
         [](const std::string& test) {
             return !isEquivalence(test) && !isOf(test, {"test people:"});
         }},
        {"position bias", "nobody prefers b or a, but the second image is chosen in 60 %",
         alike(0.5, 0, 0.1),
         [](const std::string& test) { return !isEquivalence(test) && !isOf(test, {"position"}); }},
        {"effect", "b is chosen in 75 % of all conditions, people differ by 1 JOD",
         alike(0.75, 1, 0),
         [](const std::string& test) {
             return isEquivalence(test) || // at its very margin
                    isOf(test, {"trend", "cochran", "mcnemar", "homogeneity", "position",
                                "conditions differ"});
         }},
    };
}

} // namespace obscura
