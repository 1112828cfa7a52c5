#include "base/files.h"
#include "experiment/preview.h"
#include "tests/experiment/desktop.h"
#include "tests/experiment/presented_study.h"
#include "tests/experiment/program.h"

#include <X11/keysym.h>
#include <gtest/gtest.h>

namespace obscura {
namespace {

using test::Program;

using PreviewTest = test::PresentedStudy;

constexpr const char* phases = R"([trial]
grey = 90
phases = [
    { name = "start", text = "start", progress = true },
    { name = "single", image = "b" },
    { name = "grid", images = [1, 2] },
    { name = "turn", images = [2, 1], alternate = 0.5, seconds = 600, key = true },
    { name = "both", images = [[1, "b"], ["a", 2]], alternate = 0.5, seconds = 600, key = true },
    { name = "blank", grey = 30, seconds = 600, key = true },
    { name = "rank", images = [1, 2], questions = [{ name = "r", kind = "rank", text = "question" }] },
    { name = "rate", questions = [
        { name = "s", kind = "slider", text = "question" },
        { name = "n", kind = "scale", text = "question", options = ["first", "second"] } ] },
]
)";

// What keys lead through, in the order of the screens.
TEST_F(PreviewTest, EachScreenIsWhatTheWindowShowsToThePixel) {
    open({.width = 160, .height = 90});
    std::string text = readFile(study.protocol.path);
    const std::size_t trial = text.find("[trial]"), end = text.find("[ordering]");
    writeFile(study.protocol.path, text.replace(trial, end - trial, phases));
    study = openStudy(study.protocol.path, study.manifest.folder);
    const std::vector<PreviewedScreen> screens = previewed(study, width, height);
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments({"--participant", "P01", "--allow-untimed"}), output);
    const auto sees = [&](const PreviewedScreen& screen) {
        program.await(screen.name, [&] { return desktop.look().pixels == screen.image.pixels; });
    };
    std::size_t shown = 0;
    for (const std::vector<unsigned long>& leave :
         std::vector<std::vector<unsigned long>>{{XK_space},
                                                 {XK_space},
                                                 {XK_space},
                                                 {XK_space},
                                                 {},
                                                 {XK_space},
                                                 {},
                                                 {XK_space},
                                                 {XK_space},
                                                 {XK_1, XK_2, XK_Return},
                                                 {XK_Escape}}) {
        sees(screens.at(shown++));
        for (const unsigned long key : leave)
            desktop.tap(key);
    }
    sees(screens.at(shown)); // whether to leave
}

} // namespace
} // namespace obscura
