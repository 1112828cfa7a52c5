#include "base/error.h"
#include "experiment/check.h"
#include "experiment/pages.h"
#include "experiment/preview.h"
#include "tests/experiment/shipped_studies.h"
#include "tests/experiment/tiny_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr int width = 640, height = 400;

Phase phaseOf(const std::string& lines) {
    return parseProtocol(
               "name = \"x\"\nseed = 1\n[scenes.s]\nbuiltin = \"atrium\"\nradius = 1\n"
               "camera = { position = [0, 1, 4], target = [0, 1, 0] }\n[levels.l]\nambient = [1, "
               "1, 1]\n[techniques.n]\ntechnique = \"none\"\n[techniques.c]\ntechnique = "
               "\"crytek\"\n[texts]\ninstructions = \"i\"\nthanks = \"t\"\nask = \"a\"\nyes = "
               "\"y\"\nno = \"n\"\n[[conditions]]\nid = \"c\"\nscene = \"s\"\nlevel = \"l\"\npair "
               "= "
               "[\"n\", \"c\"]\n[[trial.phases]]\nname = \"one\"\n" +
                   lines +
                   "\n[[trial.phases]]\nname = \"two\"\nquestions = [{ name = \"z\", text = "
                   "\"ask\", options = [\"yes\", \"no\"] }]\n",
               "x.toml")
        .trial.given.front();
}

TEST(Preview, SaysHowAPhaseEnds) {
    EXPECT_EQ(endOf(phaseOf("image = 1\natLeast = 0.5")), "Space, not before 0.5 s");
    EXPECT_EQ(endOf(phaseOf("text = \"ask\"")), "Space or a click");
    EXPECT_EQ(endOf(phaseOf("grey = 9\nseconds = 2")), "2 s, 120 frames at 60 Hz, locked");
    EXPECT_EQ(endOf(phaseOf("image = 1\nframes = 1")), "0.01667 s, 1 frame at 60 Hz, locked");
    EXPECT_EQ(endOf(phaseOf("image = 1\nseconds = 3\nkey = true\natLeast = 1")),
              "3 s, 180 frames at 60 Hz; or Space, not before 1 s");
    EXPECT_EQ(endOf(phaseOf("images = [1, 2]\nalternate = 0.1\nseconds = 4")),
              "4 s, 240 frames at 60 Hz, in turns of 0.1 s, 6 frames, locked");
    const std::string question =
        "questions = [{ name = \"q\", text = \"ask\", options = [\"yes\", \"no\"] }]";
    EXPECT_EQ(endOf(phaseOf(question)), "the answer: one key or click");
    EXPECT_EQ(endOf(phaseOf(question + "\nseconds = 5")),
              "the answer: one key or click; or unanswered after 5 s, 300 frames at 60 Hz");
    EXPECT_EQ(endOf(phaseOf("questions = [{ name = \"q\", text = \"ask\", kind = \"number\" }]")),
              "Enter or a click on the button, once answered");
}

TEST(Preview, ShowsEveryScreenOfATrialAndThePagesAroundIt) {
    test::TemporaryFolder folder;
    const test::TinyStudy tiny =
        test::writeTinyStudy(folder.path(), {.ordering = "scheme = \"thesis\"\nbreakEvery = 3"});
    const Study study = openStudy(tiny.protocol, tiny.stimuli);
    std::vector<std::string> names, shown;
    const std::vector<PreviewedScreen> screens = previewed(study, width, height);
    for (const PreviewedScreen& screen : screens) {
        names.push_back(screen.name);
        shown.push_back(screen.shown);
    }
    EXPECT_THAT(names, ElementsAre("instructions", "start", "first", "mask", "second", "question",
                                   "break", "leave", "thanks"));
    EXPECT_THAT(shown, ElementsAre("", "", "1 = a (none)", "", "2 = b (crytek24)", "", "", "", ""));
    EXPECT_EQ(screens[0].image.pixels,
              drawPage(instructionsPage(study.protocol.texts), width, height, 128).image.pixels);

    // The image stands in the middle, each of its pixels a pixel of the screen.
    const Image8 stimulus = loadStimulus(study.manifest, study.condition(0).image("a"));
    const int left = (width - stimulus.width) / 2, top = (height - stimulus.height) / 2;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int u = x - left, v = y - top;
            const bool inside = u >= 0 && u < stimulus.width && v >= 0 && v < stimulus.height;
            ASSERT_EQ(screens[2].image.pixels[static_cast<std::size_t>(3 * (y * width + x))],
                      inside
                          ? stimulus.pixels[static_cast<std::size_t>(3 * (v * stimulus.width + u))]
                          : 128)
                << x << ", " << y;
        }
}

class PreviewedProtocol : public testing::TestWithParam<fs::path> {};

TEST_P(PreviewedProtocol, FitsOnASheet) {
    test::TemporaryFolder folder;
    test::writeNoiseStimuli(readProtocol(GetParam()), folder.path());
    const Study study = openStudy(GetParam(), folder.path());
    const Image8 sheet = previewSheet(study, 1920, 1080);
    EXPECT_GE(sheet.width, 3 * 960);
    EXPECT_GE(sheet.height, 2 * 540);
    EXPECT_THAT(checkRuns(study.protocol, 1920, 1080),
                HasSubstr(std::to_string(study.protocol.ordering.participants) + " simulated"));
}

INSTANTIATE_TEST_SUITE_P(Protocols, PreviewedProtocol, testing::ValuesIn(test::shippedStudies()),
                         test::caseName);

TEST(Check, RefusesWhatDoesNotFit) {
    test::TemporaryFolder folder;
    const Protocol protocol = readProtocol(test::writeTinyStudy(folder.path()).protocol);
    EXPECT_NO_THROW(checkRuns(protocol, width, height));
    EXPECT_THROW(checkRuns(protocol, 300, 400), Error); // the images are 320 wide
}

} // namespace
} // namespace obscura
