#include "experiment/data_folder.h"
#include "experiment/form.h"
#include "experiment/selection.h"
#include "experiment/study.h"
#include "tests/experiment/desktop.h"
#include "tests/experiment/program.h"
#include "tests/experiment/shipped_studies.h"
#include "tests/experiment/tiny_study.h"

#include <X11/keysym.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using test::Program;
using test::Row;

// One who answers every question by keys, and looks no longer than it takes to press one.
class Participant {
  public:
    Participant(test::Desktop& desktop, Program& program, const Protocol& protocol)
        : desktop_(desktop), program_(program), phases_(phasesOf(protocol.trial)),
          before_(protocol.before), after_(protocol.after),
          images_(static_cast<int>(protocol.trial.order.size())), count_(longest(protocol)) {}

    void takePart() {
        attend(before_);
        await("instructions");
        desktop_.tap(XK_space);
        for (int trial = 1; trial <= count_ && !ended_; ++trial)
            for (const Phase& phase : phases_)
                if (!phase.counted() && !ended_)
                    attend(phase, trial);
        attend(after_);
        if (!ended_)
            await("thanks");
        desktop_.tap(XK_Return);
        EXPECT_EQ(program_.wait(), 0) << program_.output();
    }

  private:
    // Pages around the trials: to what can end the session the answer is the first option.
    void attend(const std::vector<Phase>& pages) {
        for (const Phase& page : pages) {
            await(page.name);
            if (page.questions.empty())
                desktop_.tap(XK_space);
            else
                answer(page.questions);
        }
    }

    // Breaks are taken on the way, and a staircase may end before its last trial.
    void attend(const Phase& phase, int trial) {
        const char* kind = phase.questions.empty() && phase.text.empty() ? " image" : "";
        const std::string title =
            fmt::format("pair {} of {}, {}{}", trial, count_, phase.name, kind);
        program_.await(title, [&] {
            if (desktop_.title() == "Obscura: break")
                desktop_.tap(XK_space);
            ended_ = desktop_.title() == "Obscura: thanks";
            return ended_ || desktop_.title() == "Obscura: " + title;
        });
        if (ended_)
            return;
        if (phase.questions.empty())
            desktop_.tap(XK_space);
        else
            answer(phase.questions);
    }

    void answer(const std::vector<Question>& questions) {
        for (const Question& question : questions) {
            if (question.kind == Question::Kind::rank)
                for (int image = images_; image > 0; --image)
                    desktop_.tap(XK_0 + static_cast<unsigned long>(image));
            else if (question.kind == Question::Kind::number)
                desktop_.type(fmt::format("{:g}", question.least));
            else
                desktop_.tap(question.endsUnless.empty() ? XK_2 : XK_1);
            if (!Form(questions, images_).alone())
                desktop_.tap(XK_Return);
        }
    }

    void await(const std::string& title) {
        program_.await(title, [&] { return desktop_.title() == "Obscura: " + title; });
    }

    test::Desktop& desktop_;
    Program& program_;
    std::vector<Phase> phases_, before_, after_;
    int images_, count_;
    bool ended_ = false;
};

std::string expectedValue(const Row& answer, const Protocol& protocol) {
    for (const Phase& phase : phasesOf(protocol.trial))
        for (const Question& question : phase.questions)
            if (question.name == answer.at("question") && question.kind == Question::Kind::scale)
                return fmt::format("{}", question.lowest + 1);
    std::string reversed; // of a ranking, the last image first
    for (std::size_t image = protocol.trial.order.size(); image > 0; --image)
        reversed += fmt::format("{}{}", reversed.empty() ? "" : ">", image);
    return answer.at("kind") == "rank" ? reversed : "2";
}

class Method : public testing::TestWithParam<fs::path> {
  protected:
    test::TemporaryFolder folder;
};

TEST_P(Method, RunsToItsEndByKeys) {
    const fs::path protocol = folder.path() / "study.toml", stimuli = folder.path() / "stimuli";
    writeFile(protocol, test::hastened(readFile(GetParam())));
    test::writeNoiseStimuli(readProtocol(protocol), stimuli);
    const Study study = openStudy(protocol, stimuli);
    test::Desktop desktop(1280, 720);
    std::vector<std::string> arguments = {"--protocol",    protocol.string(),
                                          "--stimuli",     stimuli.string(),
                                          "--data",        (folder.path() / "data").string(),
                                          "--participant", "P01"};
    if (!study.protocol.translations.empty())
        arguments.insert(arguments.end(), {"--language", study.protocol.texts.language});
    Program program(desktop.name(), arguments, folder.path() / "output.txt");
    Participant(desktop, program, study.protocol).takePart();

    const DataFolder data(folder.path() / "data", study.protocol);
    std::vector<Row> answers = test::rowsOf(data.answers({"P01", 1, false}));
    std::erase_if(answers, [](const Row& row) { return row.at("trial_index") == "0"; });
    EXPECT_FALSE(answers.empty());
    for (const Row& answer : answers)
        EXPECT_EQ(answer.at("value"), expectedValue(answer, study.protocol));
    if (adaptiveTrials(study.protocol.ordering) == 0) {
        EXPECT_EQ(answers.back().at("trial_index"), fmt::format("{}", longest(study.protocol)));
    }
    for (const Row& phase : test::rowsOf(data.phases({"P01", 1, false}))) {
        EXPECT_TRUE(phase.at("frames_shown") == phase.at("frames_planned") ||
                    phase.at("missed_frames") != "0")
            << phase.at("phase");
        EXPECT_EQ(phase.at("interrupted"), "0");
    }
}

std::vector<fs::path> methods() {
    std::vector<fs::path> all = test::shippedStudies();
    std::erase_if(all, [](const fs::path& path) { // the pair of presenter_e2e_test
        return path.stem() == "aalborg-2010" || path.stem() == "demo";
    });
    return all;
}

INSTANTIATE_TEST_SUITE_P(Protocols, Method, testing::ValuesIn(methods()), test::caseName);

} // namespace
} // namespace obscura
