#include "protocols/reader/ordering.h"

#include "protocols/reader/toml_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace obscura {

namespace {

constexpr int many = 1000; // conditions or trials; nobody sits through more

Place placeOf(TomlTable& table, std::string_view key) {
    return table.placeOf(*table.node(key), table.pathOf(key));
}

// A key that other schemes would ignore is a mistake.
void refuse(TomlTable& table, std::initializer_list<const char*> keys, OrderScheme scheme) {
    for (const char* key : keys)
        if (table.has(key))
            throw Error(placeOf(table, key),
                        fmt::format("means nothing to the scheme \"{}\"; remove it, or choose "
                                    "another scheme",
                                    orderSchemeNames()[static_cast<std::size_t>(scheme)]));
}

// The keys of other schemes.
void refuseForeign(TomlTable& table, OrderScheme scheme) {
    const bool stairs = scheme == OrderScheme::staircase, quest = scheme == OrderScheme::quest;
    const bool adaptive = quest || scheme == OrderScheme::information;
    if (scheme != OrderScheme::shuffle)
        refuse(table, {"apart"}, scheme);
    if (!stairs)
        refuse(table, {"down", "up", "reversals"}, scheme);
    if (stairs || adaptive)
        refuse(table, {"repeats", "blocks"}, scheme);
    else
        refuse(table, {"trials", "answer"}, scheme);
    if (!adaptive)
        refuse(table, {"width"}, scheme);
    if (!quest)
        refuse(table, {"scores", "guess"}, scheme);
}

// Likenesses from `scene` on, as many as there are `choices`.
std::optional<Likeness> parseLikeness(TomlTable& table, std::string_view key, std::size_t choices) {
    const auto& all = likenessNames();
    if (!table.has(key))
        return std::nullopt;
    return static_cast<Likeness>(
        table.choice(key, {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(choices)}, 0));
}

// Ids of conditions, each of which is taken out of `left`.
std::vector<std::string> take(TomlTable& table, std::string_view key,
                              std::vector<ConditionLabels>& left) {
    std::vector<std::string> taken;
    for (const PlacedText& id : table.texts(key, "a list of ids of conditions")) {
        const auto at = std::find_if(left.begin(), left.end(),
                                     [&](const ConditionLabels& one) { return one.id == id.text; });
        if (at == left.end()) {
            std::vector<std::string> known;
            known.reserve(left.size());
            for (const ConditionLabels& one : left)
                known.push_back(one.id);
            throw Error(id.place,
                        fmt::format("expected the id of a condition that is not yet named "
                                    "under \"practice\" or \"catch\", found \"{}\"{}",
                                    id.text, suggestion(id.text, known)));
        }
        left.erase(at);
        taken.push_back(id.text);
    }
    if (left.empty())
        throw Error(placeOf(table, key), "expected a condition that is left for main trials, found "
                                         "none; add one, or name fewer here");
    return taken;
}

// The question by whose answers the scheme goes.
const Question& parseAnswer(TomlTable& table, std::string& answer,
                            const std::vector<Question>& questions) {
    answer = table.text("answer", answer);
    std::vector<std::string> known;
    known.reserve(questions.size());
    for (const Question& question : questions) {
        if (question.name == answer)
            return question;
        known.push_back(question.name);
    }
    throw Error(placeOf(table, table.has("answer") ? "answer" : "scheme"),
                fmt::format("expected the name of a question of the trial, found \"{}\"{}", answer,
                            suggestion(answer, known)));
}

void checkRightAnswers(TomlTable& table, const std::vector<ConditionLabels>& conditions,
                       const Question& question, std::string_view scheme) {
    if (conditions.size() < 2)
        throw Error(placeOf(table, "scheme"),
                    fmt::format("expected a {} of two conditions or more, found one", scheme));
    for (const ConditionLabels& one : conditions) {
        if (question.images && !one.correct.empty() && one.correct != "a" && one.correct != "b")
            throw Error(placeOf(table, "scheme"),
                        fmt::format("expected \"a\" or \"b\" as the right answer to \"{}\", found "
                                    "\"{}\"",
                                    one.id, one.correct));
        if (one.correct.empty())
            throw Error(placeOf(table, "scheme"),
                        fmt::format("expected a right answer to each condition of a {}, found none "
                                    "to \"{}\"; give it the key \"correct\"",
                                    scheme, one.id));
    }
}

Staircase parseStaircase(TomlTable& table, const std::vector<ConditionLabels>& ladder,
                         const std::vector<Question>& questions) {
    Staircase stair;
    stair.down = table.integer("down", 1, 10, stair.down);
    stair.up = table.integer("up", 1, 10, stair.up);
    stair.reversals = table.integer("reversals", 1, 100, stair.reversals);
    stair.trials = table.integer("trials", 1, many, stair.trials);
    const Question& question = parseAnswer(table, stair.answer, questions);
    checkRightAnswers(table, ladder, question, "staircase");
    return stair;
}

void parseScores(TomlTable& table, Adaptive& adaptive, std::size_t conditions) {
    constexpr double most = 1e6;
    adaptive.scores = table.numbers("scores", -most, most);
    const std::set<double> different(adaptive.scores.begin(), adaptive.scores.end());
    if (different.size() != conditions || adaptive.scores.size() != conditions)
        throw Error(placeOf(table, table.has("scores") ? "scores" : "scheme"),
                    fmt::format("expected under \"scores\" {} different numbers, one for each "
                                "condition of main trials, found {} ({} of them different)",
                                conditions, adaptive.scores.size(), different.size()));
}

// Each condition is a pair that differs from all others, so that none is of no use.
void checkPairs(TomlTable& table, const std::vector<ConditionLabels>& conditions,
                const Question& question) {
    if (!question.images || question.kind != Question::Kind::choice)
        throw Error(placeOf(table, table.has("answer") ? "answer" : "scheme"),
                    fmt::format("expected a choice between images, found \"{}\", which is none",
                                question.name));
    std::map<std::pair<std::string, std::set<std::string>>, std::string> known;
    for (const ConditionLabels& one : conditions) {
        if (one.shown.size() != 2)
            throw Error(placeOf(table, "scheme"),
                        fmt::format("expected trials of two images, found {}; see \"order\" under "
                                    "[trial]",
                                    one.shown.size()));
        const auto [same, isNew] = known.try_emplace(
            {one.scene + "\n" + one.level, {one.shown.begin(), one.shown.end()}}, one.id);
        if (!isNew)
            throw Error(placeOf(table, "scheme"),
                        fmt::format("expected each pair of images once, found that of \"{}\" again "
                                    "as \"{}\"",
                                    same->second, one.id));
    }
}

Adaptive parseAdaptive(TomlTable& table, OrderScheme scheme,
                       const std::vector<ConditionLabels>& conditions,
                       const std::vector<Question>& questions) {
    constexpr double widest = 1e6;
    Adaptive adaptive;
    adaptive.trials = table.integer("trials", 1, many, adaptive.trials);
    if (table.has("width"))
        adaptive.width = table.number("width", 1e-6, widest);
    const Question& question = parseAnswer(table, adaptive.answer, questions);
    if (scheme == OrderScheme::information) {
        checkPairs(table, conditions, question);
        return adaptive;
    }
    checkRightAnswers(table, conditions, question, "quest");
    parseScores(table, adaptive, conditions.size());
    adaptive.guess = table.number("guess", 0, 0.9, adaptive.guess);
    return adaptive;
}

const std::string& labelOf(const ConditionLabels& condition, Likeness likeness) {
    const std::array labels = {&condition.scene, &condition.level, &condition.id};
    return *labels[static_cast<std::size_t>(likeness)];
}

using Block = std::pair<const std::string, std::vector<const ConditionLabels*>>;

// Trials alike in something can be kept apart when no kind is more than half of them; in one pass,
// it may be one more, first and last (schedule.h).
void checkApart(const Block& block, const Ordering& ordering, const Place& place) {
    std::map<std::string, std::size_t> counts;
    for (const ConditionLabels* condition : block.second)
        ++counts[labelOf(*condition, *ordering.apart)];
    const std::size_t trials = block.second.size(), spare = ordering.repeats == 1 ? 1 : 0;
    for (const auto& [label, count] : counts)
        if (2 * count > trials + spare)
            throw Error(place,
                        fmt::format("cannot be kept: {} of the {} conditions{} have the {} "
                                    "\"{}\"; add others, or keep something else apart",
                                    count, trials,
                                    ordering.blocks ? " of block \"" + block.first + "\"" : "",
                                    likenessNames()[static_cast<std::size_t>(*ordering.apart)],
                                    label));
}

void checkApart(const std::vector<ConditionLabels>& main, const Ordering& ordering,
                const Place& place) {
    std::map<std::string, std::vector<const ConditionLabels*>> blocks;
    for (const ConditionLabels& condition : main)
        blocks[ordering.blocks ? labelOf(condition, *ordering.blocks) : ""].push_back(&condition);
    for (const Block& block : blocks)
        checkApart(block, ordering, place);
}

// A number of main trials after which something comes that never comes last.
int parseEvery(TomlTable& table, std::string_view key, int mainTrials) {
    if (!table.has(key))
        return 0;
    const int every = table.integer(key, 1, many);
    if (every >= mainTrials)
        throw Error(placeOf(table, key),
                    fmt::format("expected fewer than the {} main trials of a session, found {}: it "
                                "would never come",
                                mainTrials, every));
    return every;
}

} // namespace

const std::vector<std::string>& orderSchemeNames() {
    static const std::vector<std::string> names = {
        "thesis", "latin", "williams", "shuffle", "listed", "staircase", "quest", "information"};
    return names;
}

const std::vector<std::string>& likenessNames() {
    static const std::vector<std::string> names = {"scene", "level", "condition"};
    return names;
}

int adaptiveTrials(const Ordering& ordering) {
    switch (ordering.scheme) {
    case OrderScheme::staircase:
        return ordering.staircase.trials;
    case OrderScheme::quest:
    case OrderScheme::information:
        return ordering.adaptive.trials;
    case OrderScheme::thesis:
    case OrderScheme::latin:
    case OrderScheme::williams:
    case OrderScheme::shuffle:
    case OrderScheme::listed:
        break;
    }
    return 0;
}

Ordering parseOrdering(TomlTable& table, const std::vector<ConditionLabels>& conditions,
                       const std::vector<Question>& questions) {
    Ordering ordering;
    ordering.scheme = static_cast<OrderScheme>(
        table.choice("scheme", orderSchemeNames(), static_cast<std::size_t>(ordering.scheme)));
    ordering.participants = table.integer("participants", 1, 100000, ordering.participants);
    ordering.resumeMinutes = table.integer("resumeMinutes", 0, 525600, ordering.resumeMinutes);
    refuseForeign(table, ordering.scheme);

    std::vector<ConditionLabels> main = conditions;
    ordering.practice = take(table, "practice", main);
    ordering.catches = take(table, "catch", main);
    ordering.repeats = table.integer("repeats", 1, 100, 1);
    ordering.blocks = parseLikeness(table, "blocks", 2);
    ordering.apart = parseLikeness(table, "apart", 3);
    if (ordering.apart)
        checkApart(main, ordering, placeOf(table, "apart"));
    if (ordering.scheme == OrderScheme::staircase)
        ordering.staircase = parseStaircase(table, main, questions);
    else if (adaptiveTrials(ordering) > 0)
        ordering.adaptive = parseAdaptive(table, ordering.scheme, main, questions);

    const int most = adaptiveTrials(ordering);
    const int mainTrials = most > 0 ? most : ordering.repeats * static_cast<int>(main.size());
    ordering.breakEvery = parseEvery(table, "breakEvery", mainTrials);
    if (ordering.catches.empty() != !table.has("catchEvery"))
        throw Error(placeOf(table, ordering.catches.empty() ? "catchEvery" : "catch"),
                    "expected both \"catch\" and \"catchEvery\", found only one of them");
    ordering.catchEvery = parseEvery(table, "catchEvery", mainTrials);
    table.finish();
    return ordering;
}

} // namespace obscura
