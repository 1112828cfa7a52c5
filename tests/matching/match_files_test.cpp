#include "matching/match_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace obscura {
namespace {

// A protocol that includes the fragment must render what was fitted: preset, what the study gives,
// and what was found.
TEST(MatchedFragment, HasAllThatDecidesATechnique) {
    MatchedTechnique technique;
    technique.setting = {"gtao-half", "gtao", {{"downscale", 2, {}}}, {}, PresetName{"low", {}}};
    technique.fitted = {{"power", 1.5}};
    MatchResult result;
    result.techniques.push_back(technique);
    EXPECT_THAT(
        matchedFragment({}, result),
        testing::HasSubstr("[techniques.gtao-half]\ntechnique = \"gtao\"\npreset = \"low\"\n"
                           "downscale = 2\npower = 1.5\n"));
}

} // namespace
} // namespace obscura
