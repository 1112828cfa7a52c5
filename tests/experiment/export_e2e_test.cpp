// obscura-analysis export, of what the presenter itself has recorded of every shipped study; judged
// by others' rules: the validator of BIDS where it is installed, and checkers that read nothing by
// our readers.

#include "experiment/session.h"
#include "experiment/simulated.h"
#include "tests/experiment/bids.h"
#include "tests/experiment/psych_ds.h"
#include "tests/experiment/shipped_studies.h"
#include "tests/experiment/tiny_study.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <fstream>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using test::Row;
using test::rowsOf;
using testing::HasSubstr;
using testing::IsEmpty;

class Export : public testing::Test {
  protected:
    // Three participants of a study with noise for images; the second left in the middle, so that
    // her tables end early.
    void record(const fs::path& file) {
        const Protocol protocol = readProtocol(file);
        test::writeNoiseStimuli(protocol, stimuli());
        const Study study = openStudy(file, stimuli());
        const DataFolder data(folder.path() / "data", protocol);
        for (const char* id : {"S01", "S02", "S03"}) {
            SimulatedObserver observer(protocol, protocol.seed, id);
            runSession(study, data, {id, 1, true}, observer);
        }
        recorded = data.path();
        std::copy_if(protocol.name.begin(), protocol.name.end(), std::back_inserter(label),
                     [](unsigned char c) { return std::isalnum(c); });
        pairs = fs::exists(data.rows({"S01", 1, true}));
        breakOff(data, {"S02", 1, true});
    }

    // Trials after the second are gone, as when a session is ended early.
    void breakOff(const DataFolder& data, const SessionId& session) const {
        for (const fs::path& path :
             {data.rows(session), data.phases(session), data.answers(session)}) {
            if (!fs::exists(path))
                continue;
            const std::string text = readFile(path);
            std::string kept;
            const std::vector<Row> rows = rowsOf(path);
            std::size_t at = text.find('\n') + 1;
            kept = text.substr(0, at);
            for (const Row& row : rows) {
                const std::size_t end = text.find('\n', at) + 1;
                if (std::stoi(row.at("trial_index")) <= 2)
                    kept += text.substr(at, end - at);
                at = end;
            }
            writeFile(path, kept);
        }
    }

    // Its output; a failure when the status is another.
    std::string exported(const std::string& format, const std::string& more = {}) {
        const std::string command =
            fmt::format("'{}/obscura-analysis' export '{}' --format {} --out '{}' {} 2>&1",
                        OBSCURA_BIN, recorded.string(), format, out(format).string(), more);
        std::FILE* pipe = ::popen(command.c_str(), "r");
        std::string output;
        char buffer[4096];
        while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, pipe))
            output.append(buffer, count);
        status = ::pclose(pipe);
        return output;
    }

    fs::path out(const std::string& format) const { return folder.path() / "out" / format; }
    fs::path stimuli() const { return folder.path() / "stimuli"; }

    test::TemporaryFolder folder;
    fs::path recorded;
    std::string label; // the study's name without hyphens
    bool pairs = false;
    int status = 0;
};

class Exports : public Export, public testing::WithParamInterface<fs::path> {
  protected:
    // Every answer is in the events, at the instant that the tables say.
    void expectEveryAnswer() const {
        for (const std::string id : {"S01", "S02", "S03"}) {
            std::string events;
            for (const auto& file :
                 fs::directory_iterator(out("bids") / ("sub-" + id) / "ses-1/beh"))
                if (file.path().string().ends_with("_events.tsv"))
                    events = readFile(file.path());
            const std::string stem =
                fmt::format("sessions/study-{}_subject-{}_session-1", label, id);
            std::map<std::string, double> onsets;
            for (const Row& row : rowsOf(recorded / (stem + "_phases.csv")))
                onsets[row.at("trial_index") + row.at("phase")] = std::stod(row.at("onset_ms"));
            const std::vector<Row> answers = rowsOf(recorded / (stem + "_answers.csv"));
            EXPECT_FALSE(answers.empty());
            for (const Row& row : answers) {
                const double response = std::stod(row.at("response_ms"));
                const double onset = onsets.at(row.at("trial_index") + row.at("phase")) + response;
                EXPECT_THAT(events, HasSubstr(fmt::format(
                                        "\n{:.6f}\t0.000000\tanswer\t{:.6f}\tn/a\t{}\t",
                                        onset / 1000, response / 1000, row.at("row_id"))));
            }
        }
    }
};

TEST_P(Exports, FollowTheStandards) {
    record(GetParam());
    std::string output = exported("psych-ds");
    ASSERT_EQ(status, 0) << output;
    EXPECT_THAT(test::psychDsFaults(out("psych-ds")), IsEmpty());
    const auto files = std::distance(fs::directory_iterator(out("psych-ds") / "data"), {});
    EXPECT_EQ(files, pairs ? 9 : 6);

    output = exported("bids", "--stimuli '" + stimuli().string() + "'");
    ASSERT_EQ(status, 0) << output;
    expectEveryAnswer();
    EXPECT_THAT(test::bidsFaults(out("bids")), IsEmpty());
    bool installed = false;
    EXPECT_THAT(test::validatorFaults(out("bids"), installed), IsEmpty());
    if (!installed)
        GTEST_SKIP() << "bids-validator is not installed: only our own checker has looked. npm "
                        "install bids-validator@1, and OBSCURA_BIDS_VALIDATOR=.../bids-validator";
}

INSTANTIATE_TEST_SUITE_P(Protocols, Exports, testing::ValuesIn(test::shippedStudies()),
                         test::caseName);

// Each of these is found by our checker, and by the validator, which so can be seen to look.
class Faults : public Export, public testing::WithParamInterface<std::string> {};

TEST_P(Faults, AreFound) {
    record(OBSCURA_SOURCE "/protocols/p910-acr.toml");
    exported("bids", "--stimuli '" + stimuli().string() + "'");
    ASSERT_EQ(status, 0);
    const fs::path root = out("bids");
    const fs::path events = root / "sub-S01/ses-1/beh/sub-S01_ses-1_task-p910acr_events.tsv";
    const std::string kind = GetParam();
    std::string text = readFile(events);
    if (kind == "onset")
        writeFile(events, "start" + text.substr(5));
    else if (kind == "cell")
        writeFile(events, text.replace(text.find("n/a"), 3, ""));
    else if (kind == "length")
        writeFile(events, text + "1\t2\n");
    else if (kind == "name")
        fs::rename(events, events.parent_path() / "sub-S01_ses-1_task-p910-acr_events.tsv");
    else if (kind == "participant")
        writeFile(root / "participants.tsv", "participant_id\nsub-S01\n");
    else if (kind == "image")
        fs::remove(fs::directory_iterator(root / "stimuli")->path());
    else if (kind == "column")
        writeFile(root / "task-p910acr_events.json", "{}");
    EXPECT_THAT(test::bidsFaults(root), testing::Not(IsEmpty()));
    bool installed = false;
    const auto faults = test::validatorFaults(root, installed);
    if (!installed)
        GTEST_SKIP() << "bids-validator is not installed";
    if (kind != "participant") { // which 1.15 does not compare with the folders
        EXPECT_THAT(faults, testing::Not(IsEmpty()));
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Faults,
                         testing::Values(std::string("onset"), "cell", "length", "name",
                                         "participant", "image", "column"),
                         [](const auto& kind) { return kind.param; });

TEST_F(Export, OwnersAuthorsAndLicenceAreKept) {
    record(OBSCURA_SOURCE "/protocols/relaxed-2afc.toml");
    const fs::path path = recorded / "dataset_description.json";
    auto json = nlohmann::ordered_json::parse(readFile(path));
    json["author"] = {{{"@type", "Person"}, {"name", "A. Author"}}, "B. Other"};
    json["license"] = "CC0";
    writeFile(path, json.dump());
    exported("bids");
    ASSERT_EQ(status, 0);
    auto described = nlohmann::json::parse(readFile(out("bids") / "dataset_description.json"));
    EXPECT_EQ(described["Authors"], nlohmann::json({"A. Author", "B. Other"}));
    EXPECT_EQ(described["License"], "CC0");
    exported("psych-ds");
    described = nlohmann::json::parse(readFile(out("psych-ds") / "dataset_description.json"));
    EXPECT_EQ(described["author"], nlohmann::json(json["author"]));
}

} // namespace
} // namespace obscura
