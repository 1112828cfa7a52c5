#include "experiment/session.h"
#include "experiment/simulated.h"
#include "tests/experiment/shipped_studies.h"
#include "tests/experiment/tiny_study.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using test::Row;
using test::rowsOf;

class ShippedProtocol : public testing::TestWithParam<fs::path> {
  protected:
    test::TemporaryFolder folder;

    Study study() const {
        const Protocol protocol = readProtocol(GetParam());
        test::writeNoiseStimuli(protocol, folder.path() / "stimuli");
        return openStudy(GetParam(), folder.path() / "stimuli");
    }
};

// One row for each phase of each trial, and all refreshes of those that are counted.
void checkPhases(const Protocol& protocol, const std::vector<Row>& rows, std::size_t trials) {
    const std::vector<Phase> phases = phasesOf(protocol.trial);
    ASSERT_EQ(rows.size(), trials * phases.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Row& row = rows[i];
        const Phase& phase = phases[i % phases.size()];
        EXPECT_EQ(row.at("trial_index"), fmt::format("{}", i / phases.size() + 1));
        EXPECT_EQ(row.at("phase"), phase.name);
        EXPECT_EQ(row.at("frames_planned") != "0", phase.counted());
        if (phase.key) { // Space may end it sooner
            EXPECT_LE(std::stoi(row.at("frames_shown")), std::stoi(row.at("frames_planned")));
        } else {
            EXPECT_EQ(row.at("frames_shown"), row.at("frames_planned")) << phase.name;
        }
        EXPECT_EQ(row.at("interrupted"), "0");
        EXPECT_EQ(std::count(row.at("files").begin(), row.at("files").end(), '.'),
                  static_cast<std::ptrdiff_t>(phase.images.size()));
    }
}

void checkAnswers(const Protocol& protocol, const std::vector<Row>& rows, std::size_t trials) {
    std::vector<Question> questions;
    for (const Phase& phase : phasesOf(protocol.trial))
        questions.insert(questions.end(), phase.questions.begin(), phase.questions.end());
    ASSERT_EQ(rows.size(), trials * questions.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Question& question = questions[i % questions.size()];
        const std::string& value = rows[i].at("value");
        EXPECT_EQ(rows[i].at("question"), question.name);
        EXPECT_TRUE(question.optional || !value.empty()) << question.name;
        const bool ofImages = question.kind == Question::Kind::rank || question.images;
        EXPECT_EQ(!rows[i].at("role").empty(), ofImages && value != "unsure") << value;
    }
}

// Takes those of pages around the trials out: they are of trial 0.
std::vector<Row> takeAround(std::vector<Row>& rows) {
    std::vector<Row> around;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(around),
                 [](const Row& row) { return row.at("trial_index") == "0"; });
    std::erase_if(rows, [](const Row& row) { return row.at("trial_index") == "0"; });
    return around;
}

// The simulated participant consents, and answers whatever is asked.
void checkAround(const Protocol& protocol, const std::vector<Row>& rows) {
    std::size_t next = 0;
    for (const auto& [kind, pages] :
         {std::pair("before", protocol.before), std::pair("after", protocol.after)})
        for (const Phase& page : pages)
            for (const Question& question : page.questions) {
                ASSERT_LT(next, rows.size());
                const Row& row = rows[next++];
                EXPECT_EQ(row.at("trial_kind"), kind);
                EXPECT_EQ(row.at("question"), question.name);
                EXPECT_FALSE(row.at("value").empty());
                EXPECT_TRUE(admits(question, row.at("value")));
            }
    EXPECT_EQ(next, rows.size());
}

TEST_P(ShippedProtocol, SimulatedParticipantsReachTheEnd) {
    const Study tried = study();
    const Protocol& protocol = tried.protocol;
    const DataFolder data(folder.path() / "data", protocol);
    for (int slot = 1; slot <= 2; ++slot) {
        const SessionId session{fmt::format("S{:02}", slot), 1, true};
        SimulatedObserver observer(protocol, protocol.seed, session.participant);
        ASSERT_TRUE(runSession(tried, data, session, observer));

        std::vector<Row> answers = rowsOf(data.answers(session)),
                         phases = rowsOf(data.phases(session));
        checkAround(protocol, takeAround(answers));
        EXPECT_EQ(takeAround(phases).size(), protocol.before.size() + protocol.after.size());
        const auto trials = static_cast<std::size_t>(std::stoi(answers.back().at("trial_index")));
        if (adaptiveTrials(protocol.ordering) > 0) { // they end earlier, but not at once
            EXPECT_GT(trials, protocol.conditions.size());
            EXPECT_LE(trials, static_cast<std::size_t>(longest(protocol)));
        } else {
            EXPECT_EQ(trials, static_cast<std::size_t>(longest(protocol)));
        }
        checkPhases(protocol, phases, trials);
        checkAnswers(protocol, answers, trials);
    }
    EXPECT_EQ(Ledger(data.ledger()).records().size(), 2u);
}

INSTANTIATE_TEST_SUITE_P(Protocols, ShippedProtocol, testing::ValuesIn(test::shippedStudies()),
                         test::caseName);

} // namespace
} // namespace obscura
