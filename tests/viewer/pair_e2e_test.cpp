// A pair that was put into a protocol, all the way: its pictures are made, and the presenter takes
// it.
#include "base/files.h"
#include "image/image.h"
#include "tests/folder.h"
#include "viewer/technique_words.h"
#include "viewer/to_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>

namespace obscura {
namespace {

namespace fs = std::filesystem;

// What a program says on both channels; "" where it fails, which is told.
std::string said(const std::string& arguments, const fs::path& log) {
    const std::string command =
        fmt::format("'{}'/{} >'{}' 2>&1 </dev/null", OBSCURA_BIN, arguments, log.string());
    const bool failed = std::system(command.c_str()) != 0;
    EXPECT_FALSE(failed) << command << "\n" << readFile(log);
    return failed ? "" : readFile(log);
}

TEST(Pair, BecomesPicturesThatThePresenterShows) {
    const test::Folder folder;
    Seen seen;
    seen.view.builtin = "sculpture";
    seen.view.camera = {{0.8, 0.9, 1.9}, {0, 0.57, 0}, {0, 1, 0}, 38, 0};
    seen.view.radius = 0.2;
    seen.level.name = "low";
    seen.level.ambient = Vec3{1, 1, 1};
    seen.level.curve = Curve::clamp;
    seen.panes = {settingsOf(techniqueIn("none"), 0.2),
                  settingsOf(techniqueIn("crytek samples=8"), 0.2)};
    const fs::path file = folder / "mine.toml", stimuli = folder / "stimuli", log = folder / "log";
    const Added begun = addPair(file, seen);
    // As a person would go on: with another size, in the file.
    writeFile(file, std::regex_replace(begun.text,
                                       std::regex("width = .*\nheight = .*\nantialiasing = 4"),
                                       "width = 64\nheight = 36\nantialiasing = 1 # quick"));
    seen.panes[0] = settingsOf(techniqueIn("gtao low"), 0.2);
    const std::string second = addPair(file, seen).condition;

    said(fmt::format("obscura-stimuli '{}' --out '{}'", file.string(), stimuli.string()), log);
    const Image8 none = readImage8(stimuli / (begun.condition + "_a_none.png")),
                 crytek = readImage8(stimuli / (begun.condition + "_b_crytek8.png")),
                 same = readImage8(stimuli / (second + "_b_crytek8.png"));
    EXPECT_EQ(none.width, 64);
    EXPECT_EQ(crytek.height, 36);
    EXPECT_NE(none.pixels, crytek.pixels);
    EXPECT_EQ(crytek.pixels, same.pixels);
    EXPECT_TRUE(fs::exists(stimuli / (second + "_a_gtao-low.png")));

    const std::string checked =
        said(fmt::format("obscura-experiment --protocol '{}' --stimuli '{}' --check", file.string(),
                         stimuli.string()),
             log);
    EXPECT_THAT(checked, testing::HasSubstr("28"));
}

} // namespace
} // namespace obscura
