#include "base/files.h"
#include "experiment/data_folder.h"
#include "experiment/ledger.h"
#include "experiment/study.h"
#include "protocols/reader/responses.h"
#include "tests/experiment/desktop.h"
#include "tests/experiment/program.h"
#include "tests/experiment/tiny_study.h"

#include <X11/keysym.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <signal.h>

#include <algorithm>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr int width = 640, height = 400;

// Where a signal meets a session: after so many whole pairs, on a screen.
struct Moment {
    const char* name;
    int signal;
    const char* signalName;
    int pairs;         // answered before
    const char* title; // of the window; "" for the mask
};
void PrintTo(const Moment& moment, std::ostream* out) { *out << moment.name; }

const Moment moments[] = {
    {"Instructions", SIGINT, "SIGINT", 0, "instructions"},
    {"Start", SIGHUP, "SIGHUP", 0, "pair 1 of 7, start"},
    {"FirstImage", SIGTERM, "SIGTERM", 1, "pair 2 of 7, first image"},
    {"Mask", SIGTERM, "SIGTERM", 0, ""},
    {"SecondImage", SIGINT, "SIGINT", 0, "pair 1 of 7, second image"},
    {"Question", SIGINT, "SIGINT", 1, "pair 2 of 7, question"},
    {"AskedToLeave", SIGTERM, "SIGTERM", 0, "asked whether to end"},
};

class SignalTest : public testing::TestWithParam<Moment> {
  protected:
    test::TemporaryFolder temporary;
    fs::path output = temporary.path() / "output.txt";

    static void awaitTitle(test::Desktop& desktop, test::Program& program, const char* title) {
        program.await(title, [&] { return desktop.title() == std::string("Obscura: ") + title; });
    }
    static bool isGrey(const test::Desktop& desktop) {
        const auto pixels = desktop.look().pixels;
        return std::all_of(pixels.begin(), pixels.end(), [](auto value) { return value == 128; });
    }

    // Presses what brings the session on, until the moment is there.
    static void reach(test::Desktop& desktop, test::Program& program, const Moment& moment) {
        for (int pair = 1;; ++pair) {
            const auto title = [&](const char* screen) {
                return fmt::format("pair {} of 7, {}", pair, screen);
            };
            const std::pair<std::string, unsigned long> steps[] = {
                {"instructions", XK_space},       {title("start"), XK_space},
                {title("first image"), XK_space}, {title("second image"), XK_space},
                {title("question"), XK_1},
            };
            for (const auto& [screen, key] : steps) {
                if (pair > 1 && screen == "instructions")
                    continue;
                awaitTitle(desktop, program, screen.c_str());
                if (moment.title == screen)
                    return;
                const bool leaves = std::string(moment.title) == "asked whether to end";
                desktop.tap(leaves && screen == title("start") ? XK_Escape : key);
                if (leaves && screen == title("start")) {
                    awaitTitle(desktop, program, moment.title);
                    return;
                }
                if (screen == title("first image") && !moment.title[0]) {
                    program.await("the mask", [&] { return isGrey(desktop); });
                    return;
                }
            }
        }
    }
};

TEST_P(SignalTest, EndsTheSessionInOrder) {
    const Moment& moment = GetParam();
    // A mask that nobody would wait for is left at once, too.
    const test::TinyStudy tiny =
        test::writeTinyStudy(temporary.path(), {.mask = moment.title[0] ? 0.3 : 60});
    const Study study = openStudy(tiny.protocol, tiny.stimuli);
    const DataFolder folder(temporary.path() / "data", study.protocol);
    const SessionId session{"P01", 1, false};

    test::Desktop desktop(width, height);
    test::Program program(desktop.name(),
                          {"--protocol", tiny.protocol.string(), "--stimuli", tiny.stimuli.string(),
                           "--data", (temporary.path() / "data").string(), "--participant", "P01"},
                          output);
    reach(desktop, program, moment);
    const SlotRecord slot = Ledger(folder.ledger()).records().front();
    EXPECT_EQ(slot.state, SlotState::reserved);
    ASSERT_EQ(::kill(slot.process, moment.signal), 0);
    EXPECT_EQ(program.wait(), 128 + moment.signal);

    const std::string reason = fmt::format("ended by {}", moment.signalName);
    EXPECT_THAT(program.output(), HasSubstr(reason + "; answers so far are kept"));
    EXPECT_EQ(readResponses(folder.rows(session), false).rows.size(),
              static_cast<std::size_t>(moment.pairs));
    EXPECT_THAT(readFile(folder.journal(session)), HasSubstr("\"event\":\"session_ended\""));
    EXPECT_THAT(readFile(folder.journal(session)), HasSubstr(reason));
    EXPECT_EQ(nlohmann::json::parse(readFile(folder.sidecar(session)))["end_reason"], reason);
    EXPECT_EQ(Ledger(folder.ledger()).records().front().state, SlotState::returned);
}

INSTANTIATE_TEST_SUITE_P(Moments, SignalTest, testing::ValuesIn(moments),
                         [](const auto& test) { return std::string(test.param.name); });

} // namespace
} // namespace obscura
