#include "base/files.h"
#include "experiment/data_folder.h"
#include "experiment/pages.h"
#include "protocols/reader/responses.h"
#include "tests/experiment/desktop.h"
#include "tests/experiment/pair_pages.h"
#include "tests/experiment/presented_study.h"
#include "tests/experiment/program.h"
#include "tests/experiment/shipped_studies.h"

#include <X11/keysym.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using test::Program;
using testing::HasSubstr;

constexpr const char* languages = R"(language = "en"
[languages.ar]
instructions = "ترى صورتين واحدة بعد الأخرى."
start = "اضغط مفتاح المسافة."
question = "أي صورة بدت أكثر واقعية؟"
first = "الأولى"
second = "الثانية"
thanks = "شكرا لكم!"
[languages.de]
instructions = "Es folgen zwei Bilder."
start = "Leertaste."
question = "Welches?"
first = "Das erste"
second = "Das zweite"
thanks = "Danke."
)";

class LanguageTest : public test::PresentedStudy {
  protected:
    void SetUp() override { open({.mask = 0.1, .texts = languages}); }

    void sees(test::Desktop& desktop, Program& program, const std::string& title, Page page,
              std::string Texts::*warning = &Texts::untimed) {
        page.warning = study.texts().*warning;
        const Image8 picture = drawPage(page, width, height, 128).image;
        program.await(title, [&] {
            return desktop.title() == "Obscura: " + title &&
                   desktop.look().pixels == picture.pixels;
        });
    }
    void seesChoice(test::Desktop& desktop, Program& program, std::size_t offered) {
        sees(desktop, program, "which language?", languagePage(study.protocol, offered));
    }
    // From then on in this language: past the experimenter's page, the participant's first.
    void goesOnIn(test::Desktop& desktop, Program& program, const std::string& language,
                  std::string Texts::*warning = &Texts::untimed) {
        study.language = language;
        ASSERT_EQ(study.texts().language, language);
        const std::string title = "Obscura: who takes part?";
        program.await(title, [&] { return desktop.title() == title; });
        desktop.type("p01");
        program.await("the id", [&] { return desktop.title() == title + " p01"; });
        desktop.tap(XK_Return);
        sees(desktop, program, "instructions", instructionsPage(study.texts()), warning);
    }
    nlohmann::json sidecar(const std::string& participant) const {
        const DataFolder own(data, study.protocol);
        return nlohmann::json::parse(readFile(own.sidecar({participant, 1, false})));
    }
};

TEST_F(LanguageTest, IsChosenByNumberAndKeptInTheSidecar) {
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments(), output);
    seesChoice(desktop, program, 0);
    desktop.tap(XK_4); // there is none
    desktop.tap(XK_space);
    seesChoice(desktop, program, 0);
    desktop.tap(XK_2);
    goesOnIn(desktop, program, "ar");
    EXPECT_EQ(sidecar("p01").at("language"), "ar");
}

TEST_F(LanguageTest, IsChosenByArrowsAndEnter) {
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments(), output);
    seesChoice(desktop, program, 0);
    desktop.tap(XK_Up); // is at the top
    desktop.tap(XK_Down);
    seesChoice(desktop, program, 1);
    desktop.tap(XK_Down);
    seesChoice(desktop, program, 2);
    desktop.tap(XK_Down); // is at the bottom
    desktop.tap(XK_Up);
    seesChoice(desktop, program, 1);
    desktop.tap(XK_Down);
    seesChoice(desktop, program, 2);
    desktop.tap(XK_Return);
    goesOnIn(desktop, program, "de");
}

TEST_F(LanguageTest, IsChosenByMouse) {
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments(), output);
    seesChoice(desktop, program, 0);
    Page page = languagePage(study.protocol, 0);
    page.warning = study.texts().untimed;
    const Box box = drawPage(page, width, height, 128).options.at(2);
    desktop.click(box.x - 5, box.y + 5); // beside it
    desktop.click(box.x + 5, box.y + 5);
    goesOnIn(desktop, program, "de");
}

TEST_F(LanguageTest, WithoutTheKeyboardThePageSaysSoAndEscapeEnds) {
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments(), output);
    seesChoice(desktop, program, 0);
    desktop.takeFocus();
    Page page = languagePage(study.protocol, 0);
    page.warning = study.texts().untimed;
    const Image8 picture = drawPage(unfocused(page, study.texts()), width, height, 128).image;
    program.await("the page without the keyboard",
                  [&] { return desktop.look().pixels == picture.pixels; });
    desktop.returnFocus();
    seesChoice(desktop, program, 0);
    desktop.tap(XK_Escape);
    EXPECT_EQ(program.wait(), 0) << program.output();
    EXPECT_FALSE(fs::exists(data)) << "no slot was claimed";
}

TEST_F(LanguageTest, IsNotAskedForWhenItIsGiven) {
    test::Desktop desktop(width, height);
    Program program(desktop.name(),
                    arguments({"--language", "DE", "--rehearse", "--allow-untimed"}), output);
    goesOnIn(desktop, program, "de", &Texts::rehearsal);
    program.kill();
    Program wrong("", arguments({"--language", "fr"}), output);
    EXPECT_EQ(wrong.wait(), 1);
    EXPECT_THAT(wrong.output(), HasSubstr("--language: expected a language of the study, found "
                                          "\"fr\"; it has en, ar, de"));
}

// Whichever is chosen: that it cannot be shown is no surprise for a participant.
TEST_F(LanguageTest, EveryOneMustBeShowable) {
    std::string text = readFile(study.protocol.path);
    text.replace(text.find("Danke."), 6, "Danke \\u0378");
    writeFile(study.protocol.path, text);
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments({"--language", "en", "--participant", "P01"}),
                    output);
    EXPECT_EQ(program.wait(), 1);
    EXPECT_THAT(program.output(), HasSubstr("tiny.toml:"));
    EXPECT_THAT(program.output(), HasSubstr("languages.de.thanks: no installed font can show "
                                            "U+0378 (the language is \"de\")"));
    EXPECT_FALSE(fs::exists(data)) << "no slot was claimed";
}

// A session that broke off goes on as it was.
TEST_F(LanguageTest, OfABrokenSessionIsTaken) {
    test::Desktop desktop(width, height);
    study.language = "de";
    {
        Program program(desktop.name(), arguments({"--language", "de", "--participant", "P01"}),
                        output);
        sees(desktop, program, "instructions", instructionsPage(study.texts()));
        desktop.tap(XK_space);
        sees(desktop, program, "pair 1 of 7, start", test::startPage(study.texts(), 1, 7));
        program.kill();
    }
    Program again(desktop.name(), arguments({"--participant", "P01", "--resume"}), output);
    sees(desktop, again, "instructions", instructionsPage(study.texts()));
    EXPECT_EQ(sidecar("P01").at("language"), "de");
}

// "The first" is on the right of an Arabic page: so is its key.
TEST_F(LanguageTest, ArrowsMeanWhatIsOnTheirSideOfThePage) {
    study.language = "ar";
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments({"--language", "ar", "--participant", "P01"}),
                    output);
    sees(desktop, program, "instructions", instructionsPage(study.texts()));
    desktop.tap(XK_space);
    for (const unsigned long key : {XK_Right, XK_Left}) {
        const std::string pair = key == XK_Right ? "pair 1 of 7, " : "pair 2 of 7, ";
        for (const char* screen : {"start", "first image", "second image"}) {
            program.await(screen, [&] { return desktop.title() == "Obscura: " + pair + screen; });
            desktop.tap(XK_space);
        }
        sees(desktop, program, pair + "question", test::questionPage(study.texts()));
        desktop.tap(key);
    }
    sees(desktop, program, "pair 3 of 7, start", test::startPage(study.texts(), 3, 7));
    desktop.tap(XK_Escape); // and of the page that asks whether to end, on which 2 is "end"
    sees(desktop, program, "asked whether to end", leavePage(study.texts()));
    desktop.tap(XK_Left);
    EXPECT_EQ(program.wait(), 0) << program.output();
    const auto rows =
        readResponses(DataFolder(data, study.protocol).rows({"P01", 1, false}), false).rows;
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].chosenPosition, 1);
    EXPECT_EQ(rows[1].chosenPosition, 2);
}

// A slider's low end is on the right of an Arabic page, for keys and mouse; but images, and the
// options that stand for them, are where they are on any page.
TEST_F(LanguageTest, SlidersAndImagesOnAPageFromRightToLeft) {
    std::string text = readFile(study.protocol.path);
    const std::size_t trial = text.find("[trial]"), end = text.find("[ordering]");
    text.replace(trial, end - trial, R"([[trial.phases]]
name = "rate"
image = 1
questions = [ { name = "s", kind = "slider", text = "question" }, { name = "t", kind = "slider", text = "question" } ]
[[trial.phases]]
name = "which"
images = [1, 2]
questions = [ { name = "c", text = "question", options = ["first", "second"], images = true } ]
)");
    for (const std::string size : {"320", "180"})
        text.replace(text.find("= " + size) + 2, 3, "100");
    writeFile(folder.path() / "form.toml", text);
    const Protocol protocol = readProtocol(folder.path() / "form.toml");
    test::writeNoiseStimuli(protocol, folder.path() / "small");
    study = openStudy(protocol.path, folder.path() / "small");
    study.language = "ar";
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments({"--language", "ar", "--participant", "P01"}),
                    output);
    program.await("instructions", [&] { return desktop.title() == "Obscura: instructions"; });
    desktop.tap(XK_space);
    program.await("sliders", [&] { return desktop.title() == "Obscura: pair 1 of 7, rate"; });
    desktop.tap(XK_Left); // from the middle, up by one
    desktop.tap(XK_Down);
    const auto phases = phasesOf(study.protocol.trial);
    Page page = formPage(study.texts(), Form(phases[0].questions, 2), roomFor(phases[0], 100, 100));
    page.warning = study.texts().untimed;
    const Box box = drawPage(page, width, height, 128).options.at(1);
    desktop.click(box.x + box.width * 3 / 4, box.y + box.height / 2);
    desktop.tap(XK_Return);
    program.await("images", [&] { return desktop.title() == "Obscura: pair 1 of 7, which"; });
    desktop.tap(XK_Right);
    program.await("next", [&] { return desktop.title() == "Obscura: pair 2 of 7, rate"; });
    const auto answers = test::rowsOf(DataFolder(data, study.protocol).answers({"P01", 1, false}));
    ASSERT_EQ(answers.size(), 3u);
    EXPECT_EQ(answers[0].at("value"), "51");
    EXPECT_EQ(answers[1].at("value"), "25");
    EXPECT_EQ(answers[2].at("value"), "2") << "the right image";
}

} // namespace
} // namespace obscura
