#include "base/files.h"
#include "experiment/data_folder.h"
#include "tests/experiment/desktop.h"
#include "tests/experiment/presented_study.h"
#include "tests/experiment/program.h"
#include "tests/experiment/receiver.h"
#include "tests/experiment/shipped_studies.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using test::Program;
using test::Row;

class VisualTest : public test::PresentedStudy {
  protected:
    int participants = 1;

    // Answers of simulated participant `number`, each "question of trial: value, role".
    std::vector<std::string> answers(const fs::path& results, int number) {
        const DataFolder where(results, study.protocol);
        std::vector<std::string> all;
        for (const Row& row :
             test::rowsOf(where.answers({"S0" + std::to_string(number), 1, true}))) {
            EXPECT_EQ(row.at("simulated"), "1");
            all.push_back(row.at("question") + " of " + row.at("trial_index") + ", " +
                          row.at("condition_id") + ": " + row.at("value") + ", " + row.at("role"));
        }
        return all;
    }

    void simulate(const fs::path& results, std::vector<std::string> more) {
        test::Desktop desktop(width, height);
        std::vector<std::string> all = {"--protocol", study.protocol.path.string(),
                                        "--stimuli",  study.manifest.folder.string(),
                                        "--data",     results.string(),
                                        "--seed",     "11",
                                        "--simulate", std::to_string(participants)};
        all.insert(all.end(), more.begin(), more.end());
        Program program(desktop.name(), all, output);
        EXPECT_EQ(program.wait(), 0) << program.output();
    }

    void bothAgree() {
        simulate(data / "data-only", {});
        simulate(data / "visual", {"--visual"});
        for (int number = 1; number <= participants; ++number) {
            const std::vector<std::string> expected = answers(data / "data-only", number);
            EXPECT_GE(expected.size(), 7u);
            EXPECT_EQ(answers(data / "visual", number), expected);
        }
        const auto sidecar = nlohmann::json::parse(
            readFile(DataFolder(data / "visual", study.protocol).sidecar({"S01", 1, true})));
        EXPECT_EQ(sidecar["model"]["seed"], 11);
        EXPECT_EQ(sidecar["display"]["framebuffer"], "640x400");
    }

    void change(const std::string& phases) {
        std::string text = readFile(study.protocol.path);
        const std::size_t trial = text.find("[trial]"), end = text.find("[ordering]");
        writeFile(study.protocol.path, text.replace(trial, end - trial, phases));
        study = openStudy(study.protocol.path, study.manifest.folder);
    }
};

constexpr const char* quick = "view = { mean = 0.1, deviation = 0.05, tail = 0.05 }\n"
                              "decision = { mean = 0.1, deviation = 0.05, tail = 0.05 }";

TEST_F(VisualTest, PairsAreAnsweredAsWithoutAWindow) {
    open({.positionBias = 0.1,
          .simulation = quick,
          .minimumView = 0.1,
          .ordering = "scheme = \"williams\"\nbreakEvery = 3"});
    participants = 2;
    bothAgree();
}

// A receiver of triggers hears of every phase of every trial, with the onset that the table has.
TEST_F(VisualTest, OnsetsAreTold) {
    open({.simulation = quick, .minimumView = 0.1});
    test::Receiver receiver(SOCK_STREAM);
    simulate(data, {"--visual", "--trigger", receiver.url()});
    const DataFolder where(data, study.protocol);
    const std::vector<Row> phases = test::rowsOf(where.phases({"S01", 1, true}));
    ASSERT_EQ(phases.size(), 35u);
    const std::vector<std::string> lines = receiver.lines(phases.size() + 1);
    ASSERT_EQ(lines.size(), phases.size()) << "and then the program has ended";
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const auto line = nlohmann::json::parse(lines[i]);
        EXPECT_EQ(line["phase"], phases[i].at("phase"));
        EXPECT_EQ(std::to_string(line["trial"].get<int>()), phases[i].at("trial_index"));
        EXPECT_NEAR(line["onset"].get<double>() * 1000, std::stod(phases[i].at("onset_ms")), 0.01);
        EXPECT_EQ(line["number"], i % 5 + 1);
    }
    const auto sidecar = nlohmann::json::parse(readFile(where.sidecar({"S01", 1, true})));
    EXPECT_EQ(sidecar["trigger"]["receiver"], receiver.url());
    EXPECT_EQ(sidecar["trigger"]["sent"], 35);
    EXPECT_EQ(sidecar["trigger"]["dropped"], 0);
    EXPECT_GT(sidecar["trigger"]["delay_max_ms"], 0);
}

TEST_F(VisualTest, NoSessionBeginsWithoutTheReceiver) {
    open({.simulation = quick});
    const std::string gone = test::Receiver(SOCK_STREAM).url();
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments({"--participant", "P01", "--trigger", gone}), output);
    EXPECT_EQ(program.wait(), 1);
    EXPECT_NE(program.output().find("no receiver could be reached"), std::string::npos)
        << program.output();
    EXPECT_FALSE(fs::exists(DataFolder(data, study.protocol).journal({"P01", 1, false})));
}

// Each kind of question, by its keys.
TEST_F(VisualTest, RatingsAreAnsweredAsWithoutAWindow) {
    open({.width = 160, .height = 90, .simulation = quick});
    change(R"([trial]
phases = [
    { name = "look", image = 1, seconds = 0.2 },
    { name = "rate", image = 1, questions = [
        { name = "scale", kind = "scale", text = "question", options = ["first", "second"] },
        { name = "slider", kind = "slider" },
        { name = "number", kind = "number", least = 0, most = 31 },
        { name = "words", kind = "text" } ] },
    { name = "rank", images = [1, 2], questions = [{ name = "rank", kind = "rank" }] },
]
)");
    bothAgree();
}

// A form that goes away by itself: what it gets is what was there in time.
TEST_F(VisualTest, TimedQuestionsAreAnsweredOrNot) {
    open({.simulation = "view = { mean = 0.1, deviation = 0, tail = 0 }\n"
                        "decision = { mean = 0.9, deviation = 0, tail = 0 }"});
    change(R"([trial]
phases = [
    { name = "late", image = 1, questions = [
        { name = "never", text = "question", options = ["first", "second"] } ], seconds = 0.4 },
    { name = "timely", questions = [
        { name = "always", text = "question", options = ["first", "second"] } ], seconds = 30 },
]
)");
    bothAgree();
    int open = 0, given = 0;
    for (const std::string& answer : answers(data / "visual", 1)) {
        open += answer.starts_with("never") && answer.ends_with(": , ");
        given += answer.starts_with("always") && !answer.ends_with(": , ");
    }
    EXPECT_EQ(open, 7);
    EXPECT_EQ(given, 7);
}

} // namespace
} // namespace obscura
