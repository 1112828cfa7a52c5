#include "experiment/data_folder.h"
#include "experiment/ledger.h"
#include "experiment/pages.h"
#include "experiment/study.h"
#include "protocols/error.h"
#include "protocols/files.h"
#include "protocols/responses.h"
#include "tests/experiment/desktop.h"
#include "tests/experiment/psych_ds.h"
#include "tests/experiment/tiny_study.h"

#include <X11/keysym.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <thread>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int width = 640, height = 400;
constexpr double patience = 20; // seconds for a screen to appear, on a busy machine
constexpr const char* banner = "Untimed display: not suitable for data collection";

// A program under test: started with arguments on a display, its output in a file.
class Program {
  public:
    Program(const std::string& display, std::vector<std::string> arguments,
            const fs::path& output) {
        process_ = ::fork();
        if (process_ != 0)
            return;
        ::setenv("DISPLAY", display.c_str(), 1);
        ::unsetenv("WAYLAND_DISPLAY");
        const int file = ::open(output.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0666);
        ::dup2(file, STDOUT_FILENO);
        ::dup2(file, STDERR_FILENO);
        std::vector<char*> raw{const_cast<char*>(OBSCURA_BIN "/obscura-experiment")};
        for (std::string& argument : arguments)
            raw.push_back(argument.data());
        raw.push_back(nullptr);
        ::execv(raw[0], raw.data());
        ::_exit(127);
    }
    ~Program() {
        if (process_ > 0)
            kill();
    }
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    void kill() {
        ::kill(process_, SIGKILL);
        wait();
    }
    int wait() { // its exit status
        int status = 0;
        ::waitpid(process_, &status, 0);
        process_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

  private:
    pid_t process_;
};

void pause(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

class PresenterTest : public testing::Test {
  protected:
    test::TemporaryFolder folder;
    fs::path data = folder.path() / "data", output = folder.path() / "output.txt";
    Study study;
    Texts& texts = study.protocol.texts;

    void open(const test::TinyOptions& options) {
        const test::TinyStudy tiny = test::writeTinyStudy(folder.path(), options);
        study = openStudy(tiny.protocol, tiny.stimuli);
    }
    std::vector<std::string> arguments(std::vector<std::string> more = {}) {
        std::vector<std::string> all = {"--protocol", study.protocol.path.string(),
                                        "--stimuli",  study.manifest.folder.string(),
                                        "--data",     data.string()};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }

    DataFolder dataFolder() const { return {data, study.protocol}; }
    std::vector<Response> rows(const std::string& participant) const {
        return readResponses(dataFolder().rows({participant, 1, false}), false).rows;
    }
    std::string journal(const std::string& participant) const {
        return readFile(dataFolder().journal({participant, 1, false}));
    }

    // What the screen must show, to the pixel.
    static DrawnPage drawn(Page page) {
        page.warning = banner;
        return drawPage(page, width, height, 128);
    }
    static Image8 grey() {
        return {width, height, 3, std::vector<std::uint8_t>(width * height * 3, 128)};
    }
    Image8 image(const ImageRecord& record) const {
        const Image8 stimulus = loadStimulus(study.manifest, record);
        Image8 screen = grey();
        const int left = (width - stimulus.width) / 2, top = (height - stimulus.height) / 2;
        for (int y = 0; y < stimulus.height; ++y)
            std::copy_n(stimulus.pixels.begin() + std::ptrdiff_t{y} * stimulus.width * 3,
                        stimulus.width * 3,
                        screen.pixels.begin() + (std::ptrdiff_t{top + y} * width + left) * 3);
        return screen;
    }

    // Steps of a session; each waits for the screen it expects.
    void begin(test::Desktop& desktop) {
        ASSERT_TRUE(desktop.awaits(drawn(instructionsPage(texts)).image, patience));
        desktop.tap(XK_space);
    }
    void startPair(test::Desktop& desktop, int pair) {
        ASSERT_TRUE(desktop.awaits(drawn(startPage(texts, pair, 7)).image, patience)) << pair;
        desktop.tap(XK_space);
    }
    void toMask(test::Desktop& desktop, int pair) {
        startPair(desktop, pair);
        ASSERT_TRUE(desktop.awaits(image(study.pair(pair - 1).a), patience)) << pair;
        desktop.tap(XK_space);
    }
    void toQuestion(test::Desktop& desktop, int pair) {
        toMask(desktop, pair);
        ASSERT_TRUE(desktop.awaits(image(study.pair(pair - 1).b), patience)) << pair;
        desktop.tap(XK_space);
        ASSERT_TRUE(desktop.awaits(drawn(questionPage(texts)).image, patience)) << pair;
    }
    void runPair(test::Desktop& desktop, int pair, unsigned long answer) {
        toQuestion(desktop, pair);
        desktop.tap(answer);
    }
    void finish(test::Desktop& desktop, Program& program) {
        ASSERT_TRUE(desktop.awaits(drawn(thanksPage(texts)).image, patience));
        desktop.tap(XK_space);
        EXPECT_EQ(program.wait(), 0) << readFile(output);
    }
};

// Slot 1 shows conditions 1 to 7 in order, member a first.
TEST_F(PresenterTest, AllSevenTrialsByKeysAndMouse) {
    open({.mask = 0.3});
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments({"--participant", "P01"}), output);
    begin(desktop);
    for (int pair = 1; pair <= 6; ++pair)
        runPair(desktop, pair, pair % 2 ? XK_1 : XK_Right);
    toQuestion(desktop, 7);
    const Box second = drawn(questionPage(texts)).options.at(1);
    desktop.click(second.x + second.width / 2, second.y + second.height / 2);
    finish(desktop, program);

    const auto answers = rows("P01");
    ASSERT_EQ(answers.size(), 7u);
    for (int i = 0; i < 7; ++i) {
        const Response& row = answers[static_cast<std::size_t>(i)];
        EXPECT_EQ(row.conditionId, fmt::format("c{}", i + 1));
        EXPECT_EQ(row.chosenPosition, i == 6 || i % 2 ? 2 : 1);
        EXPECT_EQ(row.firstIs, "a");
        EXPECT_FALSE(row.simulated);
        EXPECT_FALSE(row.interrupted);
        EXPECT_EQ(row.timestampSource, "none");
        EXPECT_EQ(row.maskFramesPlanned, 18);
        EXPECT_TRUE(row.maskFramesShown == 18 || row.missedFrames > 0);
        EXPECT_EQ(row.earlyPressesInMask, 0);
        EXPECT_NEAR(row.onset2Ms, row.onset1Ms + row.view1Ms + row.maskMs, 0.01);
        EXPECT_NEAR(row.questionOnsetMs, row.onset2Ms + row.view2Ms, 0.01);
    }
    EXPECT_EQ(Ledger(dataFolder().ledger()).records().front().state, SlotState::completed);
    EXPECT_THAT(journal("P01"), HasSubstr("\"reason\":\"completed\""));
    EXPECT_THAT(test::psychDsFaults(data / "tiny-study"), IsEmpty());
    EXPECT_THAT(readFile(output), HasSubstr("not suitable for data collection"));
    const auto sidecar = nlohmann::json::parse(readFile(dataFolder().sidecar({"P01", 1, false})));
    EXPECT_EQ(sidecar["display"]["framebuffer"], "640x400");
    EXPECT_EQ(sidecar["end_reason"], "completed");
}

// The two seconds of the thesis, with Space pressed, held and let go in them.
TEST_F(PresenterTest, SpaceDuringTheMaskChangesNothing) {
    open({.mask = 2});
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments({"--participant", "P01"}), output);
    begin(desktop);
    toMask(desktop, 1);
    ASSERT_TRUE(desktop.awaits(grey(), patience));
    for (int i = 0; i < 3; ++i) {
        pause(0.1);
        desktop.tap(XK_space);
    }
    desktop.press(XK_space); // held beyond the end of the mask
    const Image8 imageTwo = image(study.pair(0).b);
    ASSERT_TRUE(desktop.awaits(imageTwo, patience));
    pause(1); // the server's auto-repeat sets in after 0.66 s
    EXPECT_TRUE(desktop.awaits(imageTwo, 0));
    desktop.release(XK_space);
    pause(0.2);
    EXPECT_TRUE(desktop.awaits(imageTwo, 0));
    desktop.tap(XK_space);
    ASSERT_TRUE(desktop.awaits(drawn(questionPage(texts)).image, patience));
    desktop.tap(XK_2);
    ASSERT_TRUE(desktop.awaits(drawn(startPage(texts, 2, 7)).image, patience));
    program.kill();

    const auto answers = rows("P01");
    ASSERT_EQ(answers.size(), 1u);
    EXPECT_EQ(answers[0].earlyPressesInMask, 4);
    EXPECT_EQ(answers[0].maskFramesPlanned, 120);
    EXPECT_TRUE(answers[0].maskFramesShown == 120 || answers[0].missedFrames > 0);
    EXPECT_TRUE(std::abs(answers[0].maskMs - 2000) < 5 || answers[0].missedFrames > 0);
    EXPECT_GT(answers[0].view2Ms, 1100);
}

TEST_F(PresenterTest, KilledInTheMiddleOfATrialLosesNoRow) {
    open({.mask = 2});
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments({"--participant", "P01"}), output);
    begin(desktop);
    runPair(desktop, 1, XK_1);
    runPair(desktop, 2, XK_2);
    toMask(desktop, 3);
    ASSERT_TRUE(desktop.awaits(grey(), patience));
    program.kill();

    EXPECT_EQ(rows("P01").size(), 2u);
    EXPECT_THAT(journal("P01"), HasSubstr("\"trial\":3,\"condition\":\"c3\""));
    EXPECT_THAT(journal("P01"), testing::Not(HasSubstr("session_ended")));
    EXPECT_TRUE(isOrphan(Ledger(dataFolder().ledger()).records().front()));

    // The same participant again: refused, and nothing touched.
    const std::string before = readFile(dataFolder().rows({"P01", 1, false}));
    Program again(desktop.name(), arguments({"--participant", "P01"}), output);
    EXPECT_EQ(again.wait(), 1);
    EXPECT_THAT(readFile(output), HasSubstr("there are data of P01, session 1"));
    EXPECT_EQ(readFile(dataFolder().rows({"P01", 1, false})), before);

    // Given back by a person, the slot goes to the next.
    Program ledger(desktop.name(),
                   {"ledger", "--protocol", study.protocol.path.string(), "--data", data.string(),
                    "--void", "1"},
                   output);
    EXPECT_EQ(ledger.wait(), 0);
    EXPECT_THAT(readFile(output), HasSubstr("1  void       P01"));
    Program next(desktop.name(), arguments({"--participant", "P02"}), output);
    begin(desktop);
    startPair(desktop, 1);
    next.kill();
    EXPECT_EQ(Ledger(dataFolder().ledger()).records().front().session.participant, "P02");
}

TEST_F(PresenterTest, ASecondPresenterGetsAnotherSlot) {
    open({.mask = 0.3});
    test::Desktop one(width, height), two(width, height);
    Program first(one.name(), arguments({"--participant", "P01"}), output);
    begin(one);
    runPair(one, 1, XK_1);
    Program second(two.name(), arguments({"--participant", "P02"}), folder.path() / "second.txt");
    begin(two);
    ASSERT_TRUE(two.awaits(drawn(startPage(texts, 1, 7)).image, patience));
    two.tap(XK_space);
    EXPECT_TRUE(two.awaits(image(study.pair(1).a), patience)) << "slot 2 begins with condition 2";

    const auto slots = Ledger(dataFolder().ledger()).records();
    ASSERT_EQ(slots.size(), 2u);
    EXPECT_EQ(slots[0].session.participant, "P01");
    EXPECT_EQ(slots[1].session.participant, "P02");
    EXPECT_EQ(slots[1].state, SlotState::reserved);
}

TEST_F(PresenterTest, EscapeAsksThenEndsKeepingRows) {
    open({.mask = 0.3});
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments({"--participant", "P01"}), output);
    begin(desktop);
    runPair(desktop, 1, XK_1);
    startPair(desktop, 2);
    const Image8 imageOne = image(study.pair(1).a);
    ASSERT_TRUE(desktop.awaits(imageOne, patience));
    desktop.tap(XK_Escape);
    ASSERT_TRUE(desktop.awaits(drawn(leavePage()).image, patience));
    desktop.tap(XK_1);
    ASSERT_TRUE(desktop.awaits(imageOne, patience)) << "continues";
    desktop.tap(XK_space);
    ASSERT_TRUE(desktop.awaits(image(study.pair(1).b), patience));
    desktop.tap(XK_space);
    ASSERT_TRUE(desktop.awaits(drawn(questionPage(texts)).image, patience));
    desktop.tap(XK_2);
    ASSERT_TRUE(desktop.awaits(drawn(startPage(texts, 3, 7)).image, patience));
    desktop.tap(XK_Escape);
    ASSERT_TRUE(desktop.awaits(drawn(leavePage()).image, patience));
    desktop.tap(XK_2);
    EXPECT_EQ(program.wait(), 0);

    const auto answers = rows("P01");
    ASSERT_EQ(answers.size(), 2u);
    EXPECT_FALSE(answers[0].interrupted);
    EXPECT_TRUE(answers[1].interrupted);
    EXPECT_EQ(Ledger(dataFolder().ledger()).records().front().state, SlotState::returned);
    EXPECT_THAT(journal("P01"), HasSubstr("left before the last trial"));
}

TEST_F(PresenterTest, LosingTheKeyboardMarksTheTrial) {
    open({.mask = 0.3});
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments({"--participant", "P01", "--windowed", "640x400"}),
                    output);
    begin(desktop);
    startPair(desktop, 1);
    ASSERT_TRUE(desktop.awaits(image(study.pair(0).a), patience));
    desktop.takeFocus();
    desktop.tap(XK_space); // goes nowhere
    pause(0.3);
    desktop.returnFocus();
    EXPECT_TRUE(desktop.awaits(image(study.pair(0).a), 0));
    desktop.tap(XK_space);
    ASSERT_TRUE(desktop.awaits(image(study.pair(0).b), patience));
    desktop.tap(XK_space);
    ASSERT_TRUE(desktop.awaits(drawn(questionPage(texts)).image, patience));
    desktop.tap(XK_1);
    runPair(desktop, 2, XK_1);
    ASSERT_TRUE(desktop.awaits(drawn(startPage(texts, 3, 7)).image, patience));

    const DataFolder rehearsals(data, study.protocol, true); // as a window's always are
    const auto answers = readResponses(rehearsals.rows({"P01", 1}), false).rows;
    ASSERT_EQ(answers.size(), 2u);
    EXPECT_TRUE(answers[0].interrupted);
    EXPECT_FALSE(answers[1].interrupted);
    EXPECT_TRUE(answers[0].rehearsal);
    EXPECT_FALSE(fs::exists(dataFolder().ledger())) << "no slot";
}

TEST_F(PresenterTest, AsksForTheParticipantOnScreen) {
    open({.mask = 0.3});
    writeFile(dataFolder().rows({"p01", 1, false}), responseHeader());
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments(), output);
    ASSERT_TRUE(desktop.awaits(drawn(idPage("", "")).image, patience));
    desktop.type("p01");
    ASSERT_TRUE(desktop.awaits(drawn(idPage("p01", "")).image, patience));
    desktop.tap(XK_Return);
    ASSERT_TRUE(desktop.awaits(
        drawn(idPage("p01", objection(dataFolder(), {"p01", 1, false}))).image, patience));
    desktop.tap(XK_BackSpace);
    desktop.type("2");
    ASSERT_TRUE(desktop.awaits(drawn(idPage("p02", "")).image, patience));
    desktop.tap(XK_Return);
    begin(desktop);
    startPair(desktop, 1);
    EXPECT_THAT(journal("p02"), HasSubstr("session_started"));
}

TEST_F(PresenterTest, AnImageLargerThanTheScreenIsRefused) {
    open({.width = 641});
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments({"--participant", "P01"}), output);
    EXPECT_EQ(program.wait(), 1);
    EXPECT_THAT(readFile(output), HasSubstr("images of 641x180 pixels do not fit on a screen of "
                                            "640x400, and are never scaled"));
    EXPECT_FALSE(fs::exists(data)) << "no slot was claimed";
}

TEST_F(PresenterTest, WithoutAScreenItSaysSo) {
    open({});
    Program program("", arguments({"--participant", "P01"}), output);
    EXPECT_EQ(program.wait(), 1);
    EXPECT_THAT(readFile(output), HasSubstr("no screen to open a window on"));
}

TEST_F(PresenterTest, SimulatesWithoutAScreen) {
    open({});
    Program program("", arguments({"--simulate", "--seed", "5"}), output);
    EXPECT_EQ(program.wait(), 0) << readFile(output);
    EXPECT_EQ(Ledger(dataFolder().ledger()).records().size(), 3u) << "as the protocol plans";
    Program again("", arguments({"--simulate", "1"}), output);
    EXPECT_EQ(again.wait(), 1);
    EXPECT_THAT(readFile(output), HasSubstr("there are data of S01, session 1"));
    Program real("", arguments({"--participant", "P01"}), output);
    EXPECT_EQ(real.wait(), 1);
}

} // namespace
} // namespace obscura
