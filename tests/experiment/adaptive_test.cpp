// Orders that go by the answers through inference/: sessions of people with known answers.
#include "base/random.h"
#include "tests/experiment/order_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <set>

namespace obscura {
namespace {

using Answer = std::function<std::string(const Condition&, int trial)>;

// A session to its end.
std::vector<PastTrial> session(const Protocol& protocol, int slot, const Answer& answer) {
    std::vector<PastTrial> history;
    while (const auto trial = next(protocol, slot, history)) {
        const auto& condition = protocol.conditions[static_cast<std::size_t>(trial->condition)];
        history.push_back(
            {*trial, {{"choice", answer(condition, static_cast<int>(history.size()))}}});
    }
    return history;
}

std::string ids(const Protocol& protocol, std::span<const PastTrial> history) {
    std::string text;
    for (const PastTrial& past : history)
        text += protocol.conditions[static_cast<std::size_t>(past.trial.condition)].id + " ";
    return text;
}

// Seven conditions of rising score, listed in a mixed order.
Protocol questStudy() {
    Protocol protocol = test::orderStudy(OrderScheme::quest, 7);
    protocol.ordering.adaptive.trials = 40;
    protocol.ordering.adaptive.scores = {0, 6, 1, 5, 2, 4, 3};
    for (Condition& condition : protocol.conditions)
        condition.correct = "b";
    return protocol;
}

double scoreOf(const Protocol& protocol, const PastTrial& past) {
    return protocol.ordering.adaptive.scores[static_cast<std::size_t>(past.trial.condition)];
}

double meanOfLastTen(const Protocol& protocol, const std::vector<PastTrial>& history) {
    double sum = 0;
    for (std::size_t i = history.size() - 10; i < history.size(); ++i)
        sum += scoreOf(protocol, history[i]);
    return sum / 10;
}

// Who is always right is led to low scores, who never is above guessing to high ones, and who sees
// what scores above 3 to 3.
TEST(QuestOrder, GoesWhereTheAnswersLead) {
    const Protocol protocol = questStudy();
    const auto right = session(protocol, 1, [](const auto&, int) { return "b"; });
    const auto guessing =
        session(protocol, 1, [](const auto&, int trial) { return trial % 2 ? "a" : "b"; });
    std::vector<PastTrial> seeing;
    while (const auto trial = next(protocol, 1, seeing)) {
        seeing.push_back({*trial, {}});
        const bool sees = scoreOf(protocol, seeing.back()) > 2.5;
        seeing.back().answers["choice"] = sees || seeing.size() % 2 ? "b" : "a";
    }
    EXPECT_EQ(right.size(), 40u);
    EXPECT_LT(meanOfLastTen(protocol, right), 1);
    EXPECT_GT(meanOfLastTen(protocol, guessing), 5);
    EXPECT_NEAR(meanOfLastTen(protocol, seeing), 3, 1);
}

TEST(QuestOrder, EndsWhenTheIntervalIsNarrow) {
    Protocol protocol = questStudy();
    const auto sees = [&](const Condition& condition, int trial) {
        const int index = condition.id.back() - '1';
        const double score = protocol.ordering.adaptive.scores[static_cast<std::size_t>(index)];
        return score > 2.5 || trial % 2 ? "b" : "a";
    };
    std::size_t before = 40;
    for (const double width : {1.5, 3.0, 5.0}) {
        protocol.ordering.adaptive.width = width;
        const std::size_t trials = session(protocol, 1, sees).size();
        EXPECT_LT(trials, before) << width;
        EXPECT_GT(trials, 2u);
        before = trials;
    }
}

// Interrupted, or without an answer: the same condition is the best still.
TEST(QuestOrder, InterruptedTrialsTeachNothingButCount) {
    Protocol protocol = questStudy();
    std::vector<PastTrial> history;
    const PlannedTrial first = next(protocol, 1, history).value();
    history.push_back({first, {{"choice", "b"}}, true});
    history.push_back({first, {}});
    EXPECT_EQ(next(protocol, 1, history)->condition, first.condition);
    EXPECT_EQ(next(protocol, 1, history)->repeat, 3);
    history.back().answers["choice"] = "b";
    EXPECT_NE(next(protocol, 1, history)->condition, first.condition);
    protocol.ordering.adaptive.trials = 2;
    EXPECT_EQ(next(protocol, 1, history), std::nullopt);
}

const std::vector<std::string> techniques = {"t0", "t1", "t2", "t3", "t4"};

// All pairs of five techniques, in each of the levels.
Protocol pairsStudy(const std::vector<std::string>& levels = {"low"}) {
    Protocol protocol = test::orderStudy(OrderScheme::information, 0);
    protocol.ordering.adaptive.trials = 48;
    for (const std::string& level : levels)
        for (std::size_t i = 0; i < techniques.size(); ++i)
            for (std::size_t j = i + 1; j < techniques.size(); ++j) {
                Condition condition;
                condition.id = fmt::format("{}-{}{}", level, i, j);
                condition.view = "box";
                condition.level = level;
                condition.roles = {{"a", techniques[i]}, {"b", techniques[j]}};
                protocol.conditions.push_back(condition);
            }
    return protocol;
}

// The later technique wins by so many JOD for each place.
Answer people(double step, std::uint64_t seed) {
    return [step, random = Random(seed, "answers")](const Condition& condition, int) mutable {
        const int places =
            condition.roles[1].technique.back() - condition.roles[0].technique.back();
        const double p = std::erfc(-places * step * 0.6744897501960817 / std::sqrt(2.0)) / 2;
        return random.uniform() < p ? "b" : "a";
    };
}

// The items that a batch connects to the first.
std::size_t reached(const Protocol& protocol, std::span<const PastTrial> batch) {
    std::set<std::string> known = {"t0"};
    for (std::size_t round = 0; round < batch.size(); ++round)
        for (const PastTrial& past : batch) {
            const auto& roles =
                protocol.conditions[static_cast<std::size_t>(past.trial.condition)].roles;
            if (known.contains(roles[0].technique) || known.contains(roles[1].technique))
                known.insert({roles[0].technique, roles[1].technique});
        }
    return known.size();
}

TEST(InformationOrder, TheFirstBatchConnectsAllImages) {
    const Protocol protocol = pairsStudy();
    for (int slot = 1; slot <= 8; ++slot) {
        const auto history = session(protocol, slot, people(1, 1));
        EXPECT_EQ(reached(protocol, std::span(history).first(4)), 5u) << slot;
    }
}

TEST(InformationOrder, NoPairComesTwiceInABatch) {
    const Protocol protocol = pairsStudy();
    const auto history = session(protocol, 3, people(4, 1));
    ASSERT_EQ(history.size(), 48u);
    for (std::size_t i = 0; i < history.size(); i += 4) {
        std::set<int> shown;
        for (const PastTrial& past : std::span(history).subspan(i, 4))
            shown.insert(past.trial.condition);
        EXPECT_EQ(shown.size(), 4u) << i;
    }
}

// Neighbours are hard to tell apart, and those far apart are certain after a few answers.
TEST(InformationOrder, PairsAlikeComeMoreOftenThanCertainOnes) {
    const Protocol protocol = pairsStudy();
    std::map<std::string, int> counts;
    for (int slot = 1; slot <= 20; ++slot)
        for (const PastTrial& past :
             session(protocol, slot, people(4, static_cast<std::uint64_t>(slot))))
            ++counts[protocol.conditions[static_cast<std::size_t>(past.trial.condition)].id];
    for (const char* near : {"low-01", "low-12", "low-23", "low-34"})
        for (const char* far : {"low-03", "low-14", "low-04"})
            EXPECT_GT(counts[near], 2 * counts[far]) << near << " " << far;
}

// Batches go by the answers before them, and not by those within. All answers of the first batch
// the other way round mirror the scale, and lead to the same second one.
TEST(InformationOrder, AnswersDecideTheNextBatchAlone) {
    const Protocol protocol = pairsStudy();
    const auto one = session(protocol, 1, people(3, 1));
    auto other = one;
    for (PastTrial& past : std::span(other).first(4))
        past.answers["choice"] = past.answers["choice"] == "a" ? "b" : "a";
    const auto asked = [&](std::size_t trials) {
        return next(protocol, 1, std::span(other).first(trials));
    };
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(asked(i), one[i].trial);
    bool differs = false;
    for (std::size_t i = 8; i < 12; ++i)
        differs |= asked(i) != one[i].trial;
    EXPECT_TRUE(differs);
}

TEST(InformationOrder, SlotsBeginWithOtherPairs) {
    const Protocol protocol = pairsStudy();
    std::set<std::string> begins;
    for (int slot = 1; slot <= 8; ++slot) {
        const auto history = session(protocol, slot, people(1, 1));
        begins.insert(ids(protocol, std::span(history).first(4)));
    }
    EXPECT_GT(begins.size(), 5u);
}

TEST(InformationOrder, EndsWhenAllIntervalsAreNarrow) {
    Protocol protocol = pairsStudy();
    protocol.ordering.adaptive.trials = 400;
    std::size_t before = 400;
    for (const double width : {1.0, 1.5, 2.0}) {
        protocol.ordering.adaptive.width = width;
        const std::size_t trials = session(protocol, 1, people(0.5, 1)).size();
        EXPECT_LT(trials, before) << width;
        EXPECT_EQ(trials % 4, 0u) << "whole batches";
        before = trials;
    }
}

// Nobody ever knows: "not sure" is half a vote for each, which narrows intervals as a choice does.
TEST(InformationOrder, NotSureIsHalfAVoteForEach) {
    Protocol protocol = pairsStudy();
    protocol.ordering.adaptive.trials = 400;
    protocol.ordering.adaptive.width = 2;
    const auto end = [&](const std::string& answer) {
        return session(protocol, 1, [&](const auto&, int) { return answer; }).size();
    };
    EXPECT_LT(end("unsure"), 200u);
    EXPECT_EQ(end(""), 400u) << "no answer narrows nothing";
}

// Two levels are two scales, that share each batch; the first has a tree of each.
TEST(InformationOrder, EachLevelHasAScale) {
    const Protocol protocol = pairsStudy({"low", "high"});
    const auto history = session(protocol, 1, people(1, 1));
    ASSERT_EQ(history.size(), 48u);
    std::map<std::string, std::vector<PastTrial>> shown;
    for (const PastTrial& past : std::span(history).first(8))
        shown[protocol.conditions[static_cast<std::size_t>(past.trial.condition)].level].push_back(
            past);
    EXPECT_EQ(reached(protocol, shown["low"]), 5u);
    EXPECT_EQ(reached(protocol, shown["high"]), 5u);
}

} // namespace
} // namespace obscura
