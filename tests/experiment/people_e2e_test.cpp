#include "base/files.h"
#include "experiment/data_folder.h"
#include "experiment/ledger.h"
#include "tests/experiment/desktop.h"
#include "tests/experiment/presented_study.h"
#include "tests/experiment/program.h"
#include "tests/experiment/shipped_studies.h"

#include <X11/keysym.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace obscura {
namespace {

using test::Program;
using test::Row;
using testing::HasSubstr;

// What surrounds the trials, by real keys.
class PeopleTest : public test::PresentedStudy {
  protected:
    void openWith(const std::string& lines, const test::TinyOptions& options = {}) {
        open(options);
        writeFile(study.protocol.path, readFile(study.protocol.path) + lines);
        study = openStudy(study.protocol.path, study.manifest.folder);
    }
    DataFolder dataFolder() const { return {data, study.protocol}; }

    static void await(test::Desktop& desktop, Program& program, const std::string& title) {
        program.await(title, [&] { return desktop.title() == "Obscura: " + title; });
    }
};

constexpr const char* consent = R"(
[[before]]
name = "consent"
text = "start"
questions = [ { name = "consent", text = "question", options = ["first", "second"], endsUnless = ["first"] } ]
[[before]]
name = "about"
questions = [ { name = "age", kind = "number", least = 18, most = 99, optional = true } ]
)";

TEST_F(PeopleTest, WhoDoesNotConsentIsThankedAndGivesTheSlotBack) {
    openWith(consent);
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments({"--participant", "P01"}), output);
    await(desktop, program, "consent");
    desktop.tap(XK_2);
    await(desktop, program, "declined");
    desktop.tap(XK_space);
    EXPECT_EQ(program.wait(), 0);
    const std::vector<Row> answers = test::rowsOf(dataFolder().answers({"P01", 1, false}));
    ASSERT_EQ(answers.size(), 1u);
    EXPECT_EQ(answers[0].at("value"), "2");
    EXPECT_EQ(Ledger(dataFolder().ledger()).records().at(0).state, SlotState::returned);
    EXPECT_THAT(program.output(), HasSubstr("its slot has been given back"));
}

TEST_F(PeopleTest, WhoConsentsGoesOnToTheInstructions) {
    openWith(consent);
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments({"--participant", "P01"}), output);
    await(desktop, program, "consent");
    desktop.tap(XK_1);
    await(desktop, program, "about");
    desktop.type("17");
    desktop.tap(XK_Return); // too young, which the range does not admit
    desktop.tap(XK_BackSpace);
    desktop.tap(XK_8);
    desktop.tap(XK_Return);
    await(desktop, program, "instructions");
    program.kill();
    const std::vector<Row> answers = test::rowsOf(dataFolder().answers({"P01", 1, false}));
    ASSERT_EQ(answers.size(), 2u);
    EXPECT_EQ(answers[1].at("value"), "18");
}

constexpr const char* keys = R"(
[keys]
first = ["f"]
second = ["j"]
go = ["g"]
)";

TEST_F(PeopleTest, TheStudysKeysRunATrial) {
    openWith(keys);
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments({"--participant", "P01"}), output);
    const auto presses = [&](const std::string& title, unsigned long other, unsigned long key) {
        await(desktop, program, title);
        desktop.tap(other); // which must do nothing, or the next title is not waited for in vain
        desktop.tap(key);
    };
    presses("instructions", XK_space, XK_g);
    presses("pair 1 of 7, start", XK_space, XK_g);
    presses("pair 1 of 7, first image", XK_space, XK_g);
    presses("pair 1 of 7, second image", XK_space, XK_g);
    presses("pair 1 of 7, question", XK_1, XK_j);
    await(desktop, program, "pair 2 of 7, start");
    program.kill();
    const std::vector<Row> answers = test::rowsOf(dataFolder().answers({"P01", 1, false}));
    ASSERT_EQ(answers.size(), 1u);
    EXPECT_EQ(answers[0].at("value"), "2");
}

// 324 pixels, as at 96 to an inch, are where it begins.
TEST_F(PeopleTest, ACardHeldToTheScreenMeasuresIt) {
    open({});
    test::Desktop desktop(1280, 720);
    Program card(desktop.name(), {"card", "--data", data.string()}, output);
    await(desktop, card, "card, 323 pixels wide");
    desktop.tap(XK_Up);
    desktop.tap(XK_Right);
    desktop.tap(XK_Right);
    await(desktop, card, "card, 335 pixels wide");
    desktop.tap(XK_Down);
    desktop.tap(XK_Left);
    await(desktop, card, "card, 324 pixels wide");
    const Image8 screen = desktop.look(); // is the rectangle what the title says, and a card?
    int across = 0, down = 0;
    for (int x = 0; x < 1280; ++x)
        across += screen.pixels[static_cast<std::size_t>((120 * 1280 + x) * 3)] == 230;
    for (int y = 0; y < 480; ++y)
        down += screen.pixels[static_cast<std::size_t>((y * 1280 + 500) * 3)] == 230;
    EXPECT_EQ(across, 324 - 4);
    EXPECT_NEAR(down + 4, 324 * 53.98 / 85.60, 0.5);
    desktop.tap(XK_Return);
    EXPECT_EQ(card.wait(), 0);
    EXPECT_THAT(card.output(), HasSubstr("3.7850 pixels per mm"));

    openWith("\n[screen]\ndistanceCm = 60\npixelsPerDegree = { min = 39, max = 40 }\n");
    Program program(desktop.name(), arguments({"--participant", "P01"}), output);
    await(desktop, program, "instructions");
    program.kill();
    const auto sidecar =
        nlohmann::json::parse(readFile(dataFolder().sidecar({"P01", 1, false})))["viewing"];
    EXPECT_NEAR(sidecar["pixels_per_degree"], 39.6384,
                1e-3); // 2 * 600 * 3.78505 * tan(0.5 degrees)
    EXPECT_THAT(std::string(sidecar["size_source"]), HasSubstr("card on 20"));
}

TEST_F(PeopleTest, AStudyThatWantsAnAngleIsRefusedWithoutIt) {
    openWith("\n[screen]\ndistanceCm = 60\ndegrees = [8, 4.5]\n");
    test::Desktop desktop(width, height);
    const auto said = [&](std::vector<std::string> more) {
        more.insert(more.end(), {"--participant", "P01"});
        Program program(desktop.name(), arguments(more), output);
        EXPECT_EQ(program.wait(), 1);
        return program.output();
    };
    EXPECT_THAT(said({}), HasSubstr("the size of this screen is not known"));
    EXPECT_THAT(
        said({"--screen-mm", "320x200"}),
        HasSubstr("expected images 8 degrees wide, found 15.19 at 60 cm; at 114.4 cm they"));
    EXPECT_THAT(said({"--screen-mm", "32"}), HasSubstr("--screen-mm: expected"));
    EXPECT_FALSE(std::filesystem::exists(data)) << "no slot was claimed";
    Program rehearsal(desktop.name(), arguments({"--participant", "P01", "--rehearse"}), output);
    await(desktop, rehearsal, "instructions");
    EXPECT_THAT(rehearsal.output(), HasSubstr("no session but a rehearsal"));
}

TEST_F(PeopleTest, TheStartScreenKnowsHowFarTheStudyIs) {
    open({});
    test::Desktop desktop(1280, 720);
    Program program(desktop.name(), arguments(), output);
    await(desktop, program, "who takes part?");
    desktop.type("a-b");
    desktop.tap(XK_Return);
    await(desktop, program, "who takes part? a-b - " + study.protocol.texts.idMalformed);
    desktop.tap(XK_BackSpace);
    desktop.tap(XK_BackSpace);
    await(desktop, program, "who takes part? a");
    desktop.tap(XK_Tab); // there is no other monitor
    desktop.tap(XK_Return);
    await(desktop, program, "instructions");
}

// A photometer before a display of gamma 2, white 100 and black 1 cd/m2.
TEST_F(PeopleTest, ACalibrationKeepsItsReadings) {
    open({});
    test::Desktop desktop(1280, 720);
    Program program(desktop.name(), {"calibrate", "--data", data.string()}, output);
    const auto type = [&](const std::string& text) {
        for (const char c : text)
            desktop.tap(c == '.' ? XK_period : static_cast<unsigned long>(c));
    };
    await(desktop, program, "match grey 186");
    desktop.tap(XK_Down);
    desktop.tap(XK_Left);
    await(desktop, program, "match grey 177");
    desktop.tap(XK_Return);
    for (const char* channel : {"red", "green", "blue"}) {
        await(desktop, program, fmt::format("match {} 186", channel));
        desktop.tap(XK_Return);
    }
    for (int code = 0; code <= 255; code += code == 240 ? 15 : 16) {
        await(desktop, program, fmt::format("patch {} ", code));
        const Image8 screen = desktop.look();
        EXPECT_EQ(screen.pixels[(360 * 1280 + 640) * 3], code) << "in the middle of the screen";
        const std::string reading = fmt::format("{:.6f}", 1 + 99.0 * code * code / 255 / 255);
        type(reading);
        await(desktop, program, fmt::format("patch {} {}", code, reading));
        desktop.tap(XK_Return);
    }
    await(desktop, program, "the curve");
    desktop.tap(XK_Return);
    EXPECT_EQ(program.wait(), 0);
    EXPECT_THAT(program.output(), HasSubstr("gamma 2.000, white 100 cd/m²"));

    Program session(desktop.name(), arguments({"--participant", "P01"}), output);
    await(desktop, session, "instructions");
    session.kill();
    const auto sidecar =
        nlohmann::json::parse(readFile(dataFolder().sidecar({"P01", 1, false})))["calibration"];
    EXPECT_EQ(sidecar["luminance"]["readings"].size(), 17u);
    EXPECT_NEAR(sidecar["luminance"]["gamma"], 2, 1e-4);
    EXPECT_EQ(sidecar["gamma_by_eye"]["grey"]["code"], 177);
}

} // namespace
} // namespace obscura
