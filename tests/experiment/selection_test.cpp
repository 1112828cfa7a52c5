#include "base/random.h"
#include "experiment/selection.h"
#include "tests/experiment/order_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace obscura {
namespace {

using test::orderOf;
using test::orderStudy;
using Kind = PlannedTrial::Kind;
using Trials = std::vector<PlannedTrial>;

constexpr OrderScheme fixedSchemes[] = {OrderScheme::thesis, OrderScheme::latin,
                                        OrderScheme::williams, OrderScheme::shuffle,
                                        OrderScheme::listed};

// Nine conditions: p1 for practice, k1 and k2 to catch, and of six main ones three of each scene
// and two of each level.
Protocol richStudy(OrderScheme scheme, std::uint64_t seed = 1) {
    Protocol study = orderStudy(scheme, 9, seed);
    for (std::size_t i = 0; i < 9; ++i) {
        study.conditions[i].view = i % 2 ? "hall" : "box";
        study.conditions[i].level = std::vector<std::string>{"low", "middle", "high"}[i % 3];
    }
    study.conditions[6].id = "p1";
    study.conditions[7].id = "k1";
    study.conditions[8].id = "k2";
    study.ordering.practice = {"p1"};
    study.ordering.catches = {"k1", "k2"};
    study.ordering.catchEvery = 2;
    study.ordering.breakEvery = 4;
    return study;
}

// A session asked for trial by trial; answers by `answer`.
template <typename Answer>
std::vector<PastTrial> run(const Protocol& study, int slot, Answer answer,
                           std::vector<PastTrial> history = {}) {
    while (const auto trial = next(study, slot, history))
        history.push_back({*trial, {{"choice", answer(*trial)}}, false});
    return history;
}

Trials trialsOf(const std::vector<PastTrial>& history) {
    Trials trials;
    for (const PastTrial& past : history)
        trials.push_back(past.trial);
    return trials;
}

std::string kindsOf(const Trials& trials) {
    std::string kinds;
    for (const PlannedTrial& trial : trials)
        kinds += nameOf(trial.kind)[0];
    return kinds;
}

TEST(Selection, AskingTrialByTrialGivesThePlan) {
    for (const OrderScheme scheme : fixedSchemes)
        for (const int slot : {1, 2, 17, 100}) {
            const Protocol study = richStudy(scheme);
            const auto a = [](const PlannedTrial&) { return "a"; };
            const auto b = [](const PlannedTrial&) { return "b"; };
            EXPECT_EQ(trialsOf(run(study, slot, a)), planned(study, slot));
            EXPECT_EQ(trialsOf(run(study, slot, b)), planned(study, slot));
        }
}

TEST(Selection, SlotsInAnyOrderAreTheSame) {
    for (const OrderScheme scheme : fixedSchemes) {
        const Protocol study = richStudy(scheme);
        std::map<int, Trials> forwards;
        for (int slot = 1; slot <= 60; ++slot)
            forwards[slot] = planned(study, slot);
        for (int slot = 60; slot >= 1; --slot)
            EXPECT_EQ(planned(study, slot), forwards[slot]);
    }
}

TEST(Selection, PracticeCatchAndBreaksComeWhereTheyWereAskedFor) {
    const Protocol study = richStudy(OrderScheme::williams);
    const Trials trials = planned(study, 3);
    EXPECT_EQ(kindsOf(trials), "pmmcmmcbmm") << "neither after the last";
    EXPECT_EQ(longest(study), 9) << "a break is no trial of theirs";
    EXPECT_EQ(trials.front().condition, 6);
    EXPECT_EQ(trials[7].condition, -1);
    EXPECT_TRUE(trials[7].roles.empty());
    EXPECT_EQ(std::set<int>({trials[3].condition, trials[6].condition}), std::set<int>({7, 8}));
    std::vector<int> order = orderOf(study, 3);
    std::sort(order.begin(), order.end());
    EXPECT_EQ(order, (std::vector<int>{1, 2, 3, 4, 5, 6}));
}

// Over four slots each catch condition comes first twice, and with each order of its pair.
TEST(Selection, CatchTrialsGoRoundFromSlotToSlot) {
    const Protocol study = richStudy(OrderScheme::williams);
    std::map<std::pair<int, bool>, int> first;
    for (int slot = 1; slot <= 4; ++slot) {
        const PlannedTrial trial = planned(study, slot)[3];
        ++first[{trial.condition, trial.reversed()}];
    }
    EXPECT_EQ(first.size(), 4u);
}

TEST(Selection, CatchTrialsCountTheirPresentations) {
    Protocol study = richStudy(OrderScheme::williams);
    study.ordering.catches = {"k1"};
    study.conditions.pop_back();
    std::vector<int> repeats;
    std::vector<bool> reversed;
    for (const PlannedTrial& trial : planned(study, 1))
        if (trial.kind == Kind::catchTrial) {
            repeats.push_back(trial.repeat);
            reversed.push_back(trial.reversed());
        }
    EXPECT_EQ(repeats, (std::vector<int>{1, 2}));
    EXPECT_NE(reversed[0], reversed[1]);
}

TEST(Selection, RepeatsHaveTheRolesReversed) {
    for (const OrderScheme scheme : fixedSchemes) {
        Protocol study = orderStudy(scheme, 7);
        study.ordering.repeats = 3;
        EXPECT_EQ(longest(study), 21);
        for (const int slot : {1, 8, 20}) {
            std::map<int, std::vector<bool>> reversed;
            for (const PlannedTrial& trial : planned(study, slot)) {
                auto& before = reversed[trial.condition];
                EXPECT_EQ(trial.repeat, static_cast<int>(before.size()) + 1);
                before.push_back(trial.reversed());
            }
            ASSERT_EQ(reversed.size(), 7u);
            for (const auto& [condition, each] : reversed)
                EXPECT_EQ(each, (std::vector<bool>{each[0], !each[0], each[0]}));
        }
    }
}

TEST(Selection, ShufflesAreOfTheirSeedAndSlot) {
    const Protocol study = orderStudy(OrderScheme::shuffle, 7, 1);
    EXPECT_NE(orderOf(study, 1), orderOf(study, 2));
    EXPECT_NE(orderOf(study, 1), orderOf(orderStudy(OrderScheme::shuffle, 7, 2), 1));
}

// Each of the six orders of three has one chance in six: within 4.5 standard errors of 6000 slots.
TEST(Selection, ShufflesAreEven) {
    const Protocol study = orderStudy(OrderScheme::shuffle, 3);
    std::map<std::vector<int>, int> counts;
    std::map<std::pair<int, bool>, int> exchanged;
    for (int slot = 1; slot <= 6000; ++slot) {
        ++counts[orderOf(study, slot)];
        for (const PlannedTrial& trial : planned(study, slot))
            ++exchanged[{trial.condition, trial.reversed()}];
    }
    EXPECT_EQ(counts.size(), 6u);
    for (const auto& [order, count] : counts)
        EXPECT_NEAR(count, 1000, 4.5 * 29);
    for (const auto& [key, count] : exchanged)
        EXPECT_EQ(count, 3000);
}

std::string labelOf(const Protocol& study, int condition, Likeness likeness) {
    const Condition& one = study.conditions[static_cast<std::size_t>(condition)];
    return likeness == Likeness::scene   ? one.view
           : likeness == Likeness::level ? one.level
                                         : one.id;
}

// The tightest there are: four of seven in one scene (one pass), three of six (two passes).
TEST(Selection, WhatIsToBeApartIsApartForAThousandSeeds) {
    for (std::uint64_t seed = 0; seed < 1000; ++seed)
        for (const auto likeness : {Likeness::scene, Likeness::level, Likeness::condition})
            for (const int repeats : {1, 2}) {
                Protocol study = richStudy(OrderScheme::shuffle, seed);
                study.ordering.repeats = repeats;
                study.ordering.apart = likeness;
                if (repeats == 1)
                    study.ordering.practice.clear(); // p1 is a fourth of its scene
                Trials trials = planned(study, 5);
                std::erase_if(trials, [](const auto& t) { return t.kind != Kind::main; });
                ASSERT_EQ(trials.size(), repeats == 1 ? 7u : 12u);
                for (std::size_t i = 1; i < trials.size(); ++i)
                    ASSERT_NE(labelOf(study, trials[i].condition, likeness),
                              labelOf(study, trials[i - 1].condition, likeness))
                        << "seed " << seed;
            }
}

// Without a constraint neighbours of one scene are common, so the test above can fail.
TEST(Selection, ApartIsNotKeptByChance) {
    int kept = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const Protocol study = richStudy(OrderScheme::shuffle, seed);
        const std::vector<int> order = orderOf(study, 5);
        bool apart = true;
        for (std::size_t i = 1; i < order.size(); ++i)
            apart = apart && order[i] % 2 != order[i - 1] % 2;
        kept += apart;
    }
    EXPECT_LT(kept, 50); // 2 * 3! * 3! / 6! is a tenth
}

// Three levels of two conditions: blocks follow each other in all six orders of a Williams square,
// crossed with the rows within.
TEST(Selection, BlocksAreWholeAndBalanced) {
    for (const OrderScheme scheme : {OrderScheme::latin, OrderScheme::williams}) {
        Protocol study = richStudy(scheme);
        study.ordering.blocks = Likeness::level;
        study.ordering.repeats = 2;
        std::map<std::pair<std::string, int>, int> places;
        std::map<std::pair<std::string, std::string>, int> neighbours;
        std::map<std::tuple<int, std::size_t, bool>, int> all;
        constexpr int slots = 6 * 4;
        for (int slot = 1; slot <= slots; ++slot) {
            Trials trials = planned(study, slot);
            std::erase_if(trials, [](const auto& t) { return t.kind != Kind::main; });
            ASSERT_EQ(trials.size(), 12u);
            for (std::size_t i = 0; i < trials.size(); ++i) {
                EXPECT_EQ(trials[i].block, static_cast<int>(i) / 4 + 1);
                const std::string level = labelOf(study, trials[i].condition, Likeness::level);
                ++places[{level, trials[i].block}];
                const std::string& before =
                    labelOf(study, trials[i > 0 ? i - 1 : 0].condition, Likeness::level);
                if (before != level)
                    ++neighbours[{before, level}];
                ++all[{trials[i].condition, i, trials[i].reversed()}];
            }
        }
        EXPECT_EQ(places.size(), 9u);
        for (const auto& [key, count] : places)
            EXPECT_EQ(count, slots / 3 * 4);
        EXPECT_EQ(neighbours.size(), 6u);
        for (const auto& [key, count] : neighbours)
            EXPECT_EQ(count, slots * 2 / 6);
        EXPECT_EQ(all.size(), 6u * 12 * 2) << "every condition everywhere, in both orders";
        for (const auto& [key, count] : all)
            EXPECT_EQ(count, slots / 12);
    }
}

TEST(Selection, CatchTrialsAndBreaksBelongToTheBlockThatTheyFollow) {
    Protocol study = richStudy(OrderScheme::williams);
    study.ordering.blocks = Likeness::level;
    std::vector<int> blocks;
    for (const PlannedTrial& trial : planned(study, 1))
        blocks.push_back(trial.block);
    EXPECT_EQ(blocks, (std::vector<int>{1, 1, 1, 1, 2, 2, 2, 2, 3, 3})); // pmmcmmcbmm
}

Protocol staircaseStudy(int levels) {
    Protocol study = orderStudy(OrderScheme::staircase, levels);
    for (Condition& condition : study.conditions)
        condition.correct = "b";
    return study;
}

// Resuming: any beginning of a session, fed back, goes on as the session did.
TEST(Selection, ReplayedHistoriesGoOnAlike) {
    Protocol staircase = staircaseStudy(5);
    staircase.ordering.breakEvery = 3;
    for (const Protocol& study : {staircase, richStudy(OrderScheme::williams)}) {
        const auto answer = [](const PlannedTrial& trial) {
            return (trial.condition + trial.repeat) % 3 ? "b" : "a";
        };
        const auto whole = run(study, 4, answer);
        ASSERT_GT(whole.size(), 9u);
        for (std::size_t length = 0; length <= whole.size(); ++length) {
            const std::vector<PastTrial> part(whole.begin(),
                                              whole.begin() + static_cast<std::ptrdiff_t>(length));
            EXPECT_EQ(trialsOf(run(study, 4, answer, part)), trialsOf(whole));
        }
    }
}

// Fixed orders do not show a half-seen pair again.
TEST(Selection, AnInterruptedTrialIsNotShownAgain) {
    const Protocol study = orderStudy(OrderScheme::williams, 3);
    const Trials plan = planned(study, 1);
    EXPECT_EQ(next(study, 1, std::vector<PastTrial>{{plan[0], {}, true}}), plan[1]);
}

TEST(Selection, AStaircaseGoesByRightAnswersAndLeavesInterruptedOnesOut) {
    Protocol study = staircaseStudy(4);
    std::vector<PastTrial> history;
    const auto level = [&](const char* answer, bool interrupted = false) {
        history.push_back({*next(study, 1, history), {{"choice", answer}}, interrupted});
        return next(study, 1, history)->condition;
    };
    EXPECT_EQ(next(study, 1, history)->condition, 0);
    EXPECT_EQ(level("b"), 0);
    EXPECT_EQ(level("a", true), 0);
    EXPECT_EQ(level("b"), 1) << "two right in a row, the interrupted one apart";
    EXPECT_EQ(level("a"), 0);
    study.ordering.staircase.answer = "confidence";
    EXPECT_EQ(level("b"), 0) << "of the answer that is asked for";
    EXPECT_TRUE(planned(study, 1).empty());
    EXPECT_EQ(longest(study), 100);
    study.ordering.staircase.trials = 5;
    EXPECT_FALSE(next(study, 1, history));
}

// Over two slots every trial's pair is in both orders; within one, nobody can foresee it.
TEST(Selection, AStaircasesPairsAreExchangedAtRandomAndBalanced) {
    Protocol study = staircaseStudy(4);
    const auto answer = [](const PlannedTrial&) { return "a"; };
    study.ordering.staircase.trials = 60;
    const Trials one = trialsOf(run(study, 1, answer)), other = trialsOf(run(study, 2, answer));
    ASSERT_EQ(one.size(), 60u);
    int reversed = 0;
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_NE(one[i].reversed(), other[i].reversed());
        EXPECT_EQ(one[i].repeat, static_cast<int>(i) + 1);
        reversed += one[i].reversed();
    }
    EXPECT_NEAR(reversed, 30, 4.5 * 3.9);
}

} // namespace
} // namespace obscura
