#include "base/error.h"
#include "base/files.h"
#include "experiment/data_folder.h"
#include "experiment/ledger.h"
#include "experiment/pages.h"
#include "experiment/study.h"
#include "protocols/reader/responses.h"
#include "tests/experiment/desktop.h"
#include "tests/experiment/pair_pages.h"
#include "tests/experiment/presented_study.h"
#include "tests/experiment/program.h"
#include "tests/experiment/psych_ds.h"
#include "tests/experiment/tiny_study.h"

#include <X11/keysym.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>

namespace obscura {
namespace {

using test::questionPage;
using test::startPage;

namespace fs = std::filesystem;
using test::Program;
using testing::HasSubstr;
using testing::IsEmpty;

class PresenterTest : public test::PresentedStudy {
  protected:
    Texts& texts = study.protocol.texts;

    DataFolder dataFolder() const { return {data, study.protocol}; }
    std::vector<Response> rows(const std::string& participant) const {
        return readResponses(dataFolder().rows({participant, 1, false}), false).rows;
    }
    std::string journal(const std::string& participant) const {
        return readFile(dataFolder().journal({participant, 1, false}));
    }

    // What the screen must show, to the pixel.
    DrawnPage drawn(Page page) const {
        page.warning = texts.untimed;
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

    // Waits until the screen shows just that, and the window's title says that keys count for it.
    static void sees(test::Desktop& desktop, Program& program, const std::string& title,
                     const Image8& picture) {
        program.await("\"" + title + "\" on the screen", [&] {
            return desktop.title() == "Obscura: " + title &&
                   desktop.look().pixels == picture.pixels;
        });
    }
    static void seesGrey(test::Desktop& desktop, Program& program) {
        program.await("the mask", [&] { return desktop.look().pixels == grey().pixels; });
    }
    static std::string titleOf(int pair, const char* screen) {
        return fmt::format("pair {} of 7, {}", pair, screen);
    }
    void seesImage(test::Desktop& desktop, Program& program, int pair, int number) {
        const ConditionRecord& images = study.condition(pair - 1);
        sees(desktop, program, titleOf(pair, number == 1 ? "first image" : "second image"),
             image(number == 1 ? images.image("a") : images.image("b")));
    }
    void seesStart(test::Desktop& desktop, Program& program, int pair) {
        sees(desktop, program, titleOf(pair, "start"), drawn(startPage(texts, pair, 7)).image);
    }
    void seesQuestion(test::Desktop& desktop, Program& program, int pair) {
        sees(desktop, program, titleOf(pair, "question"), drawn(questionPage(texts)).image);
    }
    void seesLeave(test::Desktop& desktop, Program& program) {
        sees(desktop, program, "asked whether to end", drawn(leavePage(texts)).image);
    }
    void seesId(test::Desktop& desktop, Program& program, const std::string& typed,
                const std::string& objection = "") {
        const std::string title = "Obscura: who takes part?" + (typed.empty() ? "" : " " + typed) +
                                  (objection.empty() ? "" : " - " + objection);
        program.await(title, [&] { return desktop.title() == title; });
    }

    // Steps of a session; each waits for the screen it expects.
    void begin(test::Desktop& desktop, Program& program) {
        sees(desktop, program, "instructions", drawn(instructionsPage(texts)).image);
        desktop.tap(XK_space);
    }
    void toFirst(test::Desktop& desktop, Program& program, int pair) {
        seesStart(desktop, program, pair);
        desktop.tap(XK_space);
        seesImage(desktop, program, pair, 1);
    }
    void toQuestion(test::Desktop& desktop, Program& program, int pair) {
        toFirst(desktop, program, pair);
        desktop.tap(XK_space);
        seesImage(desktop, program, pair, 2);
        desktop.tap(XK_space);
        seesQuestion(desktop, program, pair);
    }
    void runPair(test::Desktop& desktop, Program& program, int pair, unsigned long answer) {
        toQuestion(desktop, program, pair);
        desktop.tap(answer);
    }
    void finish(test::Desktop& desktop, Program& program) {
        sees(desktop, program, "thanks", drawn(thanksPage(texts)).image);
        desktop.tap(XK_Return);
        EXPECT_EQ(program.wait(), 0) << program.output();
    }
};

// Slot 1 shows conditions 1 to 7 in order, member a first.
TEST_F(PresenterTest, AllSevenTrialsByKeysAndMouse) {
    open({.mask = 0.3});
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments({"--participant", "P01"}), output);
    begin(desktop, program);
    for (int pair = 1; pair <= 6; ++pair)
        runPair(desktop, program, pair, pair % 2 ? XK_1 : XK_Right);
    toQuestion(desktop, program, 7);
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

// Space pressed, held and let go in the mask, which is long enough for a busy machine to press in.
TEST_F(PresenterTest, SpaceDuringTheMaskChangesNothing) {
    open({.mask = 5});
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments({"--participant", "P01"}), output);
    begin(desktop, program);
    toFirst(desktop, program, 1);
    desktop.tap(XK_space);
    seesGrey(desktop, program);
    for (int i = 0; i < 3; ++i)
        desktop.tap(XK_space);
    desktop.press(XK_space); // held beyond the end of the mask
    seesImage(desktop, program, 1, 2);
    // The server's auto-repeat sets in after 0.66 s. What it would do is seen below, in view2Ms.
    std::this_thread::sleep_for(std::chrono::seconds(1));
    desktop.release(XK_space);
    seesImage(desktop, program, 1, 2);
    desktop.tap(XK_space);
    seesQuestion(desktop, program, 1);
    desktop.tap(XK_2);
    seesStart(desktop, program, 2);
    program.kill();

    const auto answers = rows("P01");
    ASSERT_EQ(answers.size(), 1u);
    EXPECT_EQ(answers[0].earlyPressesInMask, 4);
    EXPECT_EQ(answers[0].maskFramesPlanned, 300);
    EXPECT_TRUE(answers[0].maskFramesShown == 300 || answers[0].missedFrames > 0);
    EXPECT_TRUE(std::abs(answers[0].maskMs - 5000) < 5 || answers[0].missedFrames > 0);
    EXPECT_GT(answers[0].view2Ms, 1000);
}

// Two quick taps start a pair and lose its first image for good, were it not for minimumView.
TEST_F(PresenterTest, TapsOfSpaceLoseNoImage) {
    open({.mask = 0.3, .minimumView = 1});
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments({"--participant", "P01"}), output);
    begin(desktop, program);
    seesStart(desktop, program, 1);
    program.await("the question", [&] {
        desktop.tap(XK_space);
        return desktop.title() == "Obscura: " + titleOf(1, "question");
    });
    desktop.tap(XK_1);
    seesStart(desktop, program, 2);

    const auto answers = rows("P01");
    ASSERT_EQ(answers.size(), 1u);
    EXPECT_GE(answers[0].view1Ms, 1000);
    EXPECT_GE(answers[0].view2Ms, 1000);
    EXPECT_FALSE(answers[0].interrupted);
    EXPECT_THAT(journal("P01"), HasSubstr("\"event\":\"presses_ignored\""));
}

TEST_F(PresenterTest, KilledInTheMiddleOfATrialLosesNoRow) {
    open({.mask = 0.3});
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments({"--participant", "P01"}), output);
    begin(desktop, program);
    runPair(desktop, program, 1, XK_1);
    runPair(desktop, program, 2, XK_2);
    toFirst(desktop, program, 3);
    program.kill();

    EXPECT_EQ(rows("P01").size(), 2u);
    EXPECT_THAT(journal("P01"), HasSubstr("\"trial\":3,\"condition\":\"c3\""));
    EXPECT_THAT(journal("P01"), testing::Not(HasSubstr("session_ended")));
    EXPECT_TRUE(isOrphan(Ledger(dataFolder().ledger()).records().front()));

    // The same participant again: refused, and nothing touched.
    const std::string before = readFile(dataFolder().rows({"P01", 1, false}));
    Program again(desktop.name(), arguments({"--participant", "P01"}), output);
    EXPECT_EQ(again.wait(), 1);
    EXPECT_THAT(readFile(output), HasSubstr("session 1 broke off; --resume goes on with it"));
    EXPECT_EQ(readFile(dataFolder().rows({"P01", 1, false})), before);

    // Given back by a person, the slot goes to the next.
    Program ledger(desktop.name(),
                   {"ledger", "--protocol", study.protocol.path.string(), "--data", data.string(),
                    "--void", "1"},
                   output);
    EXPECT_EQ(ledger.wait(), 0);
    EXPECT_THAT(readFile(output), HasSubstr("1  void       P01"));
    Program next(desktop.name(), arguments({"--participant", "P02"}), output);
    begin(desktop, next);
    seesStart(desktop, next, 1);
    next.kill();
    EXPECT_EQ(Ledger(dataFolder().ledger()).records().front().session.participant, "P02");
}

TEST_F(PresenterTest, ASecondPresenterGetsAnotherSlot) {
    open({.mask = 0.3});
    test::Desktop one(width, height), two(width, height);
    Program first(one.name(), arguments({"--participant", "P01"}), output);
    begin(one, first);
    runPair(one, first, 1, XK_1);
    Program second(two.name(), arguments({"--participant", "P02"}), folder.path() / "second.txt");
    begin(two, second);
    seesStart(two, second, 1);
    two.tap(XK_space);
    // Slot 2 begins with condition 2.
    sees(two, second, titleOf(1, "first image"), image(study.condition(1).image("a")));

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
    begin(desktop, program);
    runPair(desktop, program, 1, XK_1);
    toFirst(desktop, program, 2);
    desktop.tap(XK_Escape);
    seesLeave(desktop, program);
    desktop.tap(XK_1);
    seesImage(desktop, program, 2, 1);
    desktop.tap(XK_space);
    seesImage(desktop, program, 2, 2);
    desktop.tap(XK_space);
    seesQuestion(desktop, program, 2);
    desktop.tap(XK_2);
    seesStart(desktop, program, 3);
    desktop.tap(XK_Escape);
    seesLeave(desktop, program);
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
    begin(desktop, program);
    toFirst(desktop, program, 1);
    desktop.takeFocus();
    desktop.tap(XK_space); // goes nowhere
    desktop.returnFocus();
    seesImage(desktop, program, 1, 1);
    desktop.tap(XK_space);
    seesImage(desktop, program, 1, 2);
    desktop.tap(XK_space);
    seesQuestion(desktop, program, 1);
    desktop.tap(XK_1);
    runPair(desktop, program, 2, XK_1);
    seesStart(desktop, program, 3);

    const DataFolder rehearsals(data, study.protocol, true); // as a window's always are
    const auto answers = readResponses(rehearsals.rows({"P01", 1}), false).rows;
    ASSERT_EQ(answers.size(), 2u);
    EXPECT_TRUE(answers[0].interrupted);
    EXPECT_FALSE(answers[1].interrupted);
    EXPECT_TRUE(answers[0].rehearsal);
    EXPECT_FALSE(fs::exists(dataFolder().ledger())) << "no slot";
}

TEST_F(PresenterTest, APageWithoutTheKeyboardSaysSo) {
    open({.mask = 0.3});
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments({"--participant", "P01"}), output);
    const auto comesAndGoes = [&](const std::string& title, Page page) {
        sees(desktop, program, title, drawn(page).image);
        desktop.takeFocus();
        page.warning = texts.untimed;
        sees(desktop, program, title, drawPage(unfocused(page, texts), width, height, 128).image);
        desktop.returnFocus();
        sees(desktop, program, title, drawn(page).image);
    };
    comesAndGoes("instructions", instructionsPage(texts));
    desktop.tap(XK_space);
    comesAndGoes(titleOf(1, "start"), startPage(texts, 1, 7));
    toQuestion(desktop, program, 1);
    comesAndGoes(titleOf(1, "question"), questionPage(texts));
    desktop.tap(XK_1);
    seesStart(desktop, program, 2);
    EXPECT_FALSE(rows("P01").at(0).interrupted) << "no image was on view";
}

TEST_F(PresenterTest, AsksForTheParticipantOnScreen) {
    open({.mask = 0.3});
    writeFile(dataFolder().rows({"p01", 1, false}), responseHeader());
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments(), output);
    seesId(desktop, program, "");
    desktop.tap(XK_Return);
    seesId(desktop, program, "", texts.idMalformed);
    desktop.type("p01");
    seesId(desktop, program, "p01");
    desktop.tap(XK_Return);
    seesId(desktop, program, "p01", texts.idTaken);
    desktop.tap(XK_BackSpace);
    desktop.type("2");
    seesId(desktop, program, "p02");
    desktop.tap(XK_Return);
    begin(desktop, program);
    seesStart(desktop, program, 1);
    EXPECT_THAT(journal("p02"), HasSubstr("session_started"));
}

// Killed while the first image of pair 2 is on view; the experimenter types the id once more, is
// asked, thinks better of it, and types it again.
TEST_F(PresenterTest, ASessionThatBrokeOffGoesOnOnceConfirmed) {
    open({});
    test::Desktop desktop(width, height);
    {
        Program program(desktop.name(), arguments({"--participant", "p01"}), output);
        begin(desktop, program);
        runPair(desktop, program, 1, XK_2);
        toFirst(desktop, program, 2);
    } // killed
    Program program(desktop.name(), arguments(), output);
    seesId(desktop, program, "");
    const Image8 question = drawn(resumePage(texts, 2, 7)).image;
    for (const unsigned long answer : {XK_2, XK_1}) {
        desktop.type("p01");
        seesId(desktop, program, "p01");
        desktop.tap(XK_Return);
        sees(desktop, program, "go on?", question);
        desktop.tap(answer);
        if (answer == XK_2)
            seesId(desktop, program, "");
    }
    begin(desktop, program);
    for (int pair = 3; pair <= 7; ++pair)
        runPair(desktop, program, pair, XK_1);
    finish(desktop, program);
    EXPECT_THAT(program.output(), HasSubstr("session 1 of p01 broke off"));
    std::vector<int> numbers;
    for (const Response& row : rows("p01"))
        numbers.push_back(row.trialIndex);
    EXPECT_THAT(numbers, testing::ElementsAre(1, 3, 4, 5, 6, 7));
    EXPECT_THAT(journal("p01"), HasSubstr("\"trials\":2,\"half_seen\":[\"c2\"]"));
    const auto slots = Ledger(dataFolder().ledger()).records();
    ASSERT_EQ(slots.size(), 1u);
    EXPECT_EQ(slots[0].state, SlotState::completed);
}

// On the command line it is to be asked for.
TEST_F(PresenterTest, GoingOnIsConfirmedOnTheCommandLine) {
    open({});
    test::Desktop desktop(width, height);
    {
        Program program(desktop.name(), arguments({"--participant", "P01"}), output);
        begin(desktop, program);
        seesStart(desktop, program, 1);
    }
    {
        Program program(desktop.name(), arguments({"--participant", "P01"}), output);
        EXPECT_EQ(program.wait(), 1);
        EXPECT_THAT(program.output(), HasSubstr("session 1 broke off; --resume goes on with it"));
    }
    Program program(desktop.name(), arguments({"--participant", "P01", "--resume"}), output);
    begin(desktop, program);
    seesStart(desktop, program, 1);
}

// The program is stopped while it loads, and started again until it could be.
TEST_F(PresenterTest, WhileLoadingItSaysSoAndDropsKeys) {
    open({});
    const Image8 loading = drawPage(loadingPage(texts, 0, 14), width, height, 128).image;
    test::Desktop desktop(width, height);
    for (int attempt = 0; attempt < 50; ++attempt) {
        Program program(desktop.name(), arguments(), output);
        bool caught = false;
        program.await("its loading", [&] {
            program.freeze();
            const std::string title = desktop.title();
            caught = title == "Obscura" && desktop.hasKeyboard() &&
                     desktop.look().pixels == loading.pixels;
            if (!caught)
                program.thaw();
            return caught || title.starts_with("Obscura:");
        });
        if (!caught)
            continue;
        desktop.type("abc");
        program.thaw();
        seesId(desktop, program, "");
        desktop.type("p01");
        seesId(desktop, program, "p01");
        return;
    }
    FAIL() << "it was never seen loading";
}

TEST_F(PresenterTest, AllThatAParticipantReadsIsTranslated) {
    open({.texts = "progress = \"Paar {pair} von {pairs}\"\nspace = \"Leertaste\"\n"
                   "anyKey = \"Weiter mit jeder Taste.\"\nloading = \"Bilder werden geladen.\"\n"
                   "unfocused = \"Bitte hier klicken\"\nleave = \"Abbrechen?\"\n"
                   "leaveNote = \"Antworten bleiben erhalten.\"\nstay = \"Weiter\"\n"
                   "end = \"Abbrechen\"\nrest = \"Pause\"\nid = \"Pseudonym, dann Eingabe\"\n"
                   "enter = \"Eingabe\"\ndone = \"Fertig\"\nbetween = \"Hinauf und hinunter.\"\n"
                   "idNote = \"Buchstaben\"\nidMalformed = \"Nein\"\nidTaken = \"Vergeben\"\n"
                   "rehearsal = \"Probe\"\nuntimed = \"Ungenau\"\n"
                   "resume = \"Weiter nach {pair} von {pairs}?\"\notherId = \"Anderes\"\n"
                   "declined = \"Hier endet es.\"\n"});
    for (const TextKey& key : textKeys()) {
        const std::string usual = Texts().*key.text;
        EXPECT_TRUE(usual.empty() || texts.*key.text != usual) << key.name;
    }
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments(), output);
    seesId(desktop, program, "");
    desktop.tap(XK_Return);
    seesId(desktop, program, "", "Nein");
    desktop.type("p01");
    seesId(desktop, program, "p01");
    desktop.tap(XK_Return);
    begin(desktop, program);
    EXPECT_EQ(startPage(texts, 1, 7).heading, "Paar 1 von 7");
    seesStart(desktop, program, 1);
    desktop.tap(XK_Escape);
    seesLeave(desktop, program);
    EXPECT_EQ(leavePage(texts).options.at(1).label, "Abbrechen");
}

// Killed after the first pair, and its tables damaged besides: the next start completes them.
TEST_F(PresenterTest, ASessionThatBrokeOffIsCompletedFromItsJournal) {
    open({.mask = 0.3});
    test::Desktop desktop(width, height);
    {
        Program program(desktop.name(), arguments({"--participant", "P01"}), output);
        begin(desktop, program);
        runPair(desktop, program, 1, XK_2);
        seesStart(desktop, program, 2);
        program.kill();
    }
    const std::string whole = readFile(dataFolder().rows({"P01", 1, false}));
    ASSERT_EQ(rows("P01").size(), 1u);
    std::ofstream(dataFolder().rows({"P01", 1, false}), std::ios::trunc) << responseHeader();
    Program second(desktop.name(), arguments({"--participant", "P02"}), output);
    sees(desktop, second, "instructions", drawn(instructionsPage(texts)).image);
    EXPECT_EQ(readFile(dataFolder().rows({"P01", 1, false})), whole);
    EXPECT_THAT(second.output(), testing::HasSubstr("session 1 of P01 broke off"));
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
