#include "base/csv.h"
#include "base/files.h"
#include "experiment/session.h"
#include "protocols/reader/study_parts.h"
#include "tests/experiment/tiny_study.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace obscura {
namespace {

namespace fs = std::filesystem;

// Every protocol that is a study of people: those of techniques have no conditions.
std::vector<fs::path> shippedStudies() {
    std::vector<fs::path> studies;
    for (const fs::directory_entry& entry : fs::directory_iterator(OBSCURA_SOURCE "/protocols")) {
        const fs::path& path = entry.path();
        if (path.extension() == ".toml" &&
            parseToml(readFile(path), path.string()).contains("conditions"))
            studies.push_back(path);
    }
    std::sort(studies.begin(), studies.end());
    return studies;
}

using Row = std::map<std::string, std::string>;

std::vector<Row> rowsOf(const fs::path& path) {
    const std::string text = readFile(path);
    const std::vector<CsvRecord> records = splitCsv(text);
    std::vector<Row> rows;
    for (std::size_t i = 1; i < records.size(); ++i) {
        const CsvRecord &record = records[i], &header = records.front();
        EXPECT_EQ(faultOf(record, header.cells.size()), "") << path << ", line " << record.line;
        Row row;
        for (std::size_t cell = 0; cell < record.cells.size(); ++cell)
            row[header.cells.at(cell)] = record.cells[cell];
        rows.push_back(std::move(row));
    }
    return rows;
}

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
        EXPECT_EQ(row.at("frames_shown"), row.at("frames_planned")) << phase.name;
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

TEST_P(ShippedProtocol, SimulatedParticipantsReachTheEnd) {
    const Study tried = study();
    const Protocol& protocol = tried.protocol;
    const DataFolder data(folder.path() / "data", protocol);
    for (int slot = 1; slot <= 2; ++slot) {
        const SessionId session{fmt::format("S{:02}", slot), 1, true};
        SimulatedObserver observer(protocol, protocol.seed, session.participant);
        ASSERT_TRUE(runSession(tried, data, session, observer));

        const std::vector<Row> answers = rowsOf(data.answers(session));
        const auto trials = static_cast<std::size_t>(std::stoi(answers.back().at("trial_index")));
        if (protocol.ordering.scheme == OrderScheme::staircase) {
            EXPECT_GT(trials, static_cast<std::size_t>(protocol.ordering.staircase.reversals));
        } else {
            EXPECT_EQ(trials, static_cast<std::size_t>(longest(protocol)));
        }
        checkPhases(protocol, rowsOf(data.phases(session)), trials);
        checkAnswers(protocol, answers, trials);
    }
    EXPECT_EQ(Ledger(data.ledger()).records().size(), 2u);
}

std::string nameOf(const testing::TestParamInfo<fs::path>& protocol) {
    std::string name = protocol.param.stem().string();
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Protocols, ShippedProtocol, testing::ValuesIn(shippedStudies()), nameOf);

} // namespace
} // namespace obscura
