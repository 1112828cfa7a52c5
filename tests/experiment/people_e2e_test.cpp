#include "base/files.h"
#include "experiment/data_folder.h"
#include "experiment/ledger.h"
#include "tests/experiment/desktop.h"
#include "tests/experiment/presented_study.h"
#include "tests/experiment/program.h"
#include "tests/experiment/shipped_studies.h"

#include <X11/keysym.h>
#include <gmock/gmock.h>

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

} // namespace
} // namespace obscura
