#include "base/files.h"
#include "experiment/data_folder.h"
#include "tests/experiment/desktop.h"
#include "tests/experiment/presented_study.h"
#include "tests/experiment/program.h"

#include <X11/keysym.h>
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using test::Program;
using testing::HasSubstr;

// What can happen to the world around a session: it ends with a message, and what was answered is
// kept.
class Mishaps : public test::PresentedStudy {
  protected:
    test::Desktop desktop{width, height};

    std::vector<std::string> asP01() {
        return arguments({"--participant", "P01", "--allow-untimed"});
    }
    void sees(Program& program, const std::string& title) {
        program.await(title, [&] { return desktop.title() == "Obscura: " + title; });
    }
    void toImage(Program& program, int pair) {
        sees(program, fmt::format("pair {} of 7, start", pair));
        desktop.tap(XK_space);
        sees(program, fmt::format("pair {} of 7, first image", pair));
    }
    void answerFirstPair(Program& program) {
        sees(program, "instructions");
        desktop.tap(XK_space);
        toImage(program, 1);
        desktop.tap(XK_space);
        sees(program, "pair 1 of 7, second image");
        desktop.tap(XK_space);
        sees(program, "pair 1 of 7, question");
        desktop.tap(XK_1);
    }
    std::string journal() const {
        return readFile(DataFolder(data, study.protocol).journal({"P01", 1, false}));
    }
};

TEST_F(Mishaps, AMonitorThatIsUnpluggedEndsTheSessionAndItGoesOn) {
    open({});
    {
        Program program(desktop.name(), asP01(), output);
        answerFirstPair(program);
        toImage(program, 2);
        desktop.unplug();
        EXPECT_EQ(program.wait(), 1);
        EXPECT_THAT(program.output(), HasSubstr("the monitor screen was disconnected"));
        EXPECT_THAT(journal(), HasSubstr("\"trial_finished\""));
        EXPECT_THAT(journal(), HasSubstr("stopped: the monitor screen was disconnected"));
    }
    test::Desktop other(width, height);
    std::vector<std::string> resumed = asP01();
    resumed.emplace_back("--resume");
    Program program(other.name(), resumed, output);
    program.await("instructions", [&] { return other.title() == "Obscura: instructions"; });
    other.tap(XK_space);
    program.await("pair 3", [&] { return other.title() == "Obscura: pair 3 of 7, start"; });
}

TEST_F(Mishaps, AFolderThatVanishesIsNoticedBeforeTheNextImage) {
    open({});
    ::setenv("TMPDIR", folder.path().c_str(), 1);
    Program program(desktop.name(), asP01(), output);
    answerFirstPair(program);
    sees(program, "pair 2 of 7, start");
    const std::string before = journal();
    fs::remove_all(data);
    desktop.tap(XK_space);
    EXPECT_EQ(program.wait(), 1);
    ::unsetenv("TMPDIR");
    const fs::path rescued =
        folder.path() / "obscura-rescued-1-study-tinystudy_subject-P01_session-1_journal.jsonl";
    EXPECT_THAT(program.output(),
                HasSubstr("was moved or removed while it was in use; all that it held is in " +
                          rescued.string()));
    EXPECT_TRUE(readFile(rescued).starts_with(before));
    EXPECT_THAT(before, HasSubstr("\"trial_finished\""));
}

} // namespace
} // namespace obscura
