#include "base/files.h"
#include "experiment/screen_file.h"
#include "experiment/session.h"
#include "experiment/simulated.h"
#include "experiment/start_facts.h"
#include "experiment/viewing.h"
#include "tests/error_of.h"
#include "tests/experiment/shipped_studies.h"
#include "tests/experiment/tiny_study.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace obscura {
namespace {

using testing::HasSubstr;

// 60 cm from a screen of 4 pixels a millimetre.
Viewing viewing(ScreenNeeds needs = {60, {}, {}}) {
    return {needs, ScreenSize{4, "card"}, 1280, 720};
}

// Worked out by hand: at 57.29 cm a degree is 1 cm to a few parts in ten thousand.
TEST(Viewing, ADegreeAt57CentimetresIsACentimetre) {
    EXPECT_NEAR(viewing({57.29, {}, {}}).pixelsPerDegree(), 40, 0.01);
    EXPECT_NEAR(viewing().pixelsPerDegree(), 41.8897, 1e-3); // 2 * 2400 * tan(0.5 degrees)
    EXPECT_NEAR(viewing().degrees(4800), 90, 1e-9);          // as far to each side as away
    EXPECT_NEAR(viewing().degrees(1280), 29.8628, 1e-3);     // 2 atan(640 / 2400)
}

TEST(Viewing, WhatAStudyWantsIsComparedAndTheDistanceNamed) {
    EXPECT_EQ(objectionTo(viewing()), "");
    EXPECT_EQ(objectionTo(viewing({60, {{30, 17}}, {}})), "");
    EXPECT_EQ(objectionTo(viewing({60, {{20, 11.3}}, {}})),
              "expected images 20 degrees wide, found 29.86 at 60 cm; at 90.74 cm they would be");
    EXPECT_THAT(objectionTo(viewing({60, {{30, 30}}, {}})), HasSubstr("30 degrees high"));
    EXPECT_EQ(objectionTo(viewing({60, {}, {{40, 45}}})), "");
    EXPECT_EQ(
        objectionTo(viewing({60, {}, {{60, 90}}})),
        "expected 60 to 90 pixels per degree, found 41.89 at 60 cm; expected at least 85.94 cm");
    EXPECT_THAT(objectionTo(viewing({60, {}, {{10, 20}}})), HasSubstr("at most 28.65 cm"));
    EXPECT_EQ(objectionTo(viewing({85.95, {}, {{60, 90}}})), "") << "as far as it said";
}

TEST(Viewing, WithoutASizeNothingIsPromised) {
    Viewing unknown = viewing({60, {{30, 17}}, {}});
    unknown.size.reset();
    EXPECT_THAT(objectionTo(unknown), HasSubstr("obscura-experiment card"));
    EXPECT_EQ(inWords(unknown), "");
    nlohmann::ordered_json sidecar;
    describe(unknown, sidecar);
    EXPECT_EQ(sidecar.dump(), "{\"viewing\":{\"distance_cm\":60.0}}");
    describe(viewing(), sidecar);
    EXPECT_NEAR(sidecar["viewing"]["pixels_per_degree"], 41.8897, 1e-3);
}

TEST(Viewing, ASizeInMillimetresMustFitThePixels) {
    EXPECT_DOUBLE_EQ(screenSizeOf("480x270", 1920, 1080).pixelsPerMm, 4);
    for (const char* wrong :
         {"", "480", "480x", "x270", "0x270", "-480x270", "480x270mm", "1e9x2e9"})
        EXPECT_THAT(test::errorOf([&] { screenSizeOf(wrong, 1920, 1080); }),
                    HasSubstr("--screen-mm: expected the width"))
            << wrong;
    EXPECT_THAT(test::errorOf([] { screenSizeOf("270x480", 1920, 1080); }),
                HasSubstr("expected square pixels"));
}

class ScreenFileTest : public testing::Test {
  protected:
    test::TemporaryFolder folder;
    gl::Monitor monitor{"DP-1 / left", 1920, 1080, 60, 510, 290, 0, 0};
    std::filesystem::path file = screenFile(folder.path(), monitor);
};

TEST_F(ScreenFileTest, AMeasurementHoldsForItsMode) {
    EXPECT_FALSE(cardSize(folder.path(), monitor));
    keepMeasured(file, monitor, "card", {{"pixels_per_mm", 3.7}});
    keepMeasured(file, monitor, "luminance", {{"readings", {1, 2}}});
    EXPECT_EQ(cardSize(folder.path(), monitor)->pixelsPerMm, 3.7);
    EXPECT_EQ(file.filename().string().find('/'), std::string::npos);
    monitor.width = 1280;
    EXPECT_FALSE(cardSize(folder.path(), monitor)) << "another mode has other pixels";
}

TEST_F(ScreenFileTest, WhatIsNoMeasurementIsRefusedWithTheFile) {
    keepMeasured(file, monitor, "card", {{"pixels_per_mm", 3.7}});
    const std::string good = readFile(file);
    const auto refusal = [&](const std::string& text) {
        writeFile(file, text);
        return test::errorOf([&] { cardSize(folder.path(), monitor); });
    };
    for (const char* wrong : {"", "{", "[]", "{}", "{\"format_version\": \"1\"}"})
        EXPECT_THAT(refusal(wrong), HasSubstr(file.string() + ": expected measurements")) << wrong;
    EXPECT_THAT(refusal("{\"format_version\": 2}"), HasSubstr("format_version 1 at most"));
    EXPECT_THAT(refusal("{\"format_version\": 1, \"card\": 3}"), HasSubstr("\"mode\""));
    for (const char* wrong : {"0", "-3.7", "1e9", "\"3.7\"", "null", "true"}) {
        std::string text = good;
        text.replace(text.find("3.7"), 3, wrong);
        EXPECT_THAT(refusal(text), HasSubstr("card.pixels_per_mm")) << wrong;
    }
}

// The simulated participants are the model itself.
TEST(ExpectedTime, IsThatOfSimulatedParticipants) {
    test::TemporaryFolder folder;
    const test::TinyStudy tiny = test::writeTinyStudy(folder.path(), {.mask = 2});
    const Study study = openStudy(tiny.protocol, tiny.stimuli);
    const DataFolder data(folder.path() / "data", study.protocol);
    double sum = 0;
    for (int i = 1; i <= 12; ++i) {
        const SessionId session{fmt::format("S{}", i), 1, true};
        SimulatedObserver observer(study.protocol, 5, session.participant);
        ASSERT_TRUE(runSession(study, data, session, observer));
        for (const test::Row& row : test::rowsOf(data.phases(session)))
            sum += std::stod(row.at("view_ms")) / 1000 / 12;
    }
    EXPECT_NEAR(expectedSeconds(study.protocol), sum, 0.06 * sum);
}

} // namespace
} // namespace obscura
