// The display's check, and masks held on a real window.
#include "base/files.h"
#include "tests/experiment/desktop.h"
#include "tests/experiment/program.h"
#include "tests/experiment/tiny_study.h"

#include <X11/keysym.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using test::Program;
using testing::HasSubstr;
using testing::Not;

constexpr int width = 640, height = 400, patch = 33; // a twelfth of the height

class TimingTest : public testing::Test {
  protected:
    test::TemporaryFolder folder;
    fs::path output = folder.path() / "output.txt", out = folder.path() / "out";
    test::Desktop desktop{width, height};

    Program start(std::vector<std::string> more) {
        std::vector<std::string> all = {"timing", "--out", out.string()};
        all.insert(all.end(), more.begin(), more.end());
        return {desktop.name(), all, output};
    }
    nlohmann::json result() const { return nlohmann::json::parse(readFile(out / "timing.json")); }

    bool allGrey() const {
        const auto pixels = desktop.look().pixels;
        return std::all_of(pixels.begin(), pixels.end(), [](auto value) { return value == 128; });
    }
    // Neither grey nor the empty desktop: noise.
    bool coloured() const {
        const auto pixels = desktop.look().pixels;
        return std::any_of(pixels.begin(), pixels.end(),
                           [](auto value) { return value != 128 && value != 0; });
    }
    // The mask that follows an image: before it, the same grey is on view during the check.
    void seesMask(Program& program) {
        program.await("an image", [&] { return coloured(); });
        program.await("the mask", [&] { return allGrey(); });
    }
};

TEST_F(TimingTest, HoldsMasksAndSaysHowLong) {
    Program program = start({"--masks", "4", "--seconds", "0.2", "--json"});
    EXPECT_EQ(program.wait(), 0) << program.output();
    const nlohmann::json json = result();
    EXPECT_EQ(json["masks"], 4);
    EXPECT_EQ(json["planned_refreshes"], 12);
    EXPECT_EQ(json["timestamp_source"], "none");
    EXPECT_EQ(json["ended"], "");
    // On a busy machine masks are longer, which is then said.
    EXPECT_GT(json["mean_ms"], 180);
    if (json["missed_intervals"] == 0 && json["wrong_frames"] == 0) {
        EXPECT_LT(json["max_ms"], 209);
    }
    const nlohmann::json check = json["display"]["check"];
    EXPECT_GE(check["flips"], 100);
    EXPECT_THAT(check["vsync"].get<std::string>(), HasSubstr("not honoured"));
    EXPECT_EQ(check["compositor"], "none");
    EXPECT_EQ(check["colour_bits"], nlohmann::json({8, 8, 8}));
    EXPECT_EQ(check["variable_refresh"], "not asked for");
    EXPECT_THAT(json["display"]["scheduling"].get<std::string>(), Not(testing::IsEmpty()));
    const std::string masks = readFile(out / "masks.csv");
    EXPECT_EQ(std::count(masks.begin(), masks.end(), '\n'), 5);
    EXPECT_THAT(program.output(), HasSubstr("\"mean_ms\""));
    EXPECT_THAT(program.output(), HasSubstr("the display: 120 swaps took"));
}

TEST_F(TimingTest, PrintsATableUnlessAskedForJson) {
    Program program = start({"--masks", "2", "--seconds", "0.1"});
    EXPECT_EQ(program.wait(), 0) << program.output();
    EXPECT_THAT(program.output(), HasSubstr("Obscura, this run"));
}

TEST_F(TimingTest, ASignalEndsItWithWhatWasMeasured) {
    Program program = start({"--masks", "1000", "--seconds", "0.3"});
    for (int i = 0; i < 2; ++i)
        seesMask(program);
    program.signal(SIGTERM);
    EXPECT_EQ(program.wait(), 128 + SIGTERM);
    EXPECT_GE(result()["masks"], 1);
    EXPECT_LT(result()["masks"], 1000);
    EXPECT_EQ(result()["ended"], "ended by SIGTERM");
    EXPECT_THAT(program.output(), HasSubstr("It was ended by SIGTERM before the last mask."));
}

TEST_F(TimingTest, EscapeEndsItDuringTheFirstMask) {
    Program program = start({"--masks", "1", "--seconds", "3600"});
    program.await("the window", [&] { return allGrey() && desktop.hasKeyboard(); });
    desktop.tap(XK_Escape);
    EXPECT_EQ(program.wait(), 0);
    EXPECT_EQ(result()["masks"], 0);
    EXPECT_TRUE(result()["mean_ms"].is_null());
    EXPECT_EQ(result()["ended"], "ended by Escape");
}

// White in the corner while an image is on view, black in the mask, and nothing else is changed.
TEST_F(TimingTest, PhotodiodePatchFollowsTheImages) {
    Program program = start({"--masks", "1000", "--seconds", "0.3", "--photodiode"});
    const auto corner = [&](const Image8& screen, std::uint8_t value) {
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const auto at = screen.pixels.begin() + (std::ptrdiff_t{y} * width + x) * 3;
                const bool inside = x < patch && y >= height - patch;
                if (inside && std::count(at, at + 3, value) != 3)
                    return false;
                if (!inside && value == 0 && std::count(at, at + 3, 128) != 3)
                    return false;
            }
        return true;
    };
    for (int i = 0; i < 2; ++i) {
        program.await("the mask", [&] { return corner(desktop.look(), 0); });
        program.await("an image", [&] { return corner(desktop.look(), 255); });
    }
    program.signal(SIGINT);
    program.wait();
    EXPECT_EQ(result()["display"]["photodiode"], true);
}

TEST_F(TimingTest, ACompositorIsSaid) {
    desktop.startCompositor();
    Program program = start({"--masks", "1", "--seconds", "0.1"});
    EXPECT_EQ(program.wait(), 0) << program.output();
    EXPECT_EQ(result()["display"]["check"]["compositor"], "runs; asked to leave the window alone");
}

class RefusedDisplayTest : public TimingTest {
  protected:
    test::TinyStudy tiny = test::writeTinyStudy(folder.path());

    Program present(test::Desktop& on, std::vector<std::string> more) {
        std::vector<std::string> all = {"--protocol",    tiny.protocol.string(),
                                        "--stimuli",     tiny.stimuli.string(),
                                        "--data",        (folder.path() / "data").string(),
                                        "--participant", "P01"};
        all.insert(all.end(), more.begin(), more.end());
        return {on.name(), all, output};
    }
    // It starts, and is left at once.
    void begins(test::Desktop& on, std::vector<std::string> more) {
        Program program = present(on, std::move(more));
        program.await("the instructions", [&] { return on.title() == "Obscura: instructions"; });
        program.signal(SIGTERM);
        EXPECT_EQ(program.wait(), 128 + SIGTERM);
    }
};

TEST_F(RefusedDisplayTest, AScaledDesktopIsRefusedUnlessAllowed) {
    desktop.scaleTo(125);
    {
        Program program = present(desktop, {});
        EXPECT_EQ(program.wait(), 1);
        EXPECT_THAT(program.output(), HasSubstr("scaled to 125 %"));
        EXPECT_THAT(program.output(), HasSubstr("--allow-untimed"));
        EXPECT_FALSE(fs::exists(folder.path() / "data" / "tiny-study" / "sessions")) << "a slot";
    }
    begins(desktop, {"--rehearse"});
    begins(desktop, {"--allow-untimed"});
    EXPECT_THAT(readFile(output), HasSubstr("timestamp_source none"));
}

TEST_F(RefusedDisplayTest, TenBitsPerColourAreRefused) {
    test::Desktop deep(width, height, 30);
    Program program = present(deep, {});
    EXPECT_EQ(program.wait(), 1);
    EXPECT_THAT(program.output(), HasSubstr("10, 10 and 10 bits"));
}

} // namespace
} // namespace obscura
