// Every kind of study as its protocol is shipped: simulated participants, then the analysis.
#include "tests/experiment/shipped_studies.h"
#include "tests/experiment/tiny_study.h"
#include "tests/folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

struct Kind {
    const char* protocol;
    const char* scale;    // that its answers give
    std::size_t groups;   // scenes and levels, and all together
    const char* sentence; // that the terminal prints
};

std::string outputOf(const std::string& command, int status = 0) {
    std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
    std::string output;
    char buffer[4096];
    while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, pipe))
        output.append(buffer, count);
    EXPECT_EQ(WEXITSTATUS(::pclose(pipe)), status) << output;
    return output;
}

void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.protocol; }

class AnalysedStudy : public testing::TestWithParam<Kind> {
  protected:
    // The terminal's text of a study of so many simulated participants.
    std::string analysed(int participants) {
        const fs::path protocol =
            fs::path(OBSCURA_SOURCE) / "protocols" / fmt::format("{}.toml", GetParam().protocol);
        test::writeNoiseStimuli(readProtocol(protocol), folder_ / "stimuli");
        outputOf(fmt::format("'{0}/obscura-experiment' --protocol '{1}' --stimuli '{2}/stimuli' "
                             "--data '{2}/data' --simulate {3}",
                             OBSCURA_BIN, protocol.string(), folder_.path().string(),
                             participants));
        return outputOf(fmt::format("'{0}/obscura-analysis' '{1}/data/{2}' --out '{1}/report'",
                                    OBSCURA_BIN, folder_.path().string(), GetParam().protocol));
    }

    std::vector<test::Row> rows() const { return test::rowsOf(folder_ / "report" / "scales.csv"); }

    test::Folder folder_;
};

TEST_P(AnalysedStudy, HasTheScaleOfItsKind) {
    const std::string output = analysed(12);
    EXPECT_THAT(output, HasSubstr(GetParam().sentence));
    EXPECT_THAT(output, HasSubstr("SIMULATED DATA"));
    std::set<std::string> groups;
    for (const test::Row& row : rows()) {
        EXPECT_EQ(row.at("source"), "SIMULATED");
        if (row.at("scale") == GetParam().scale && row.at("what") == "item") {
            groups.insert(row.at("question") + row.at("scene") + row.at("level"));
            EXPECT_NE(row.at("value"), "");
            EXPECT_EQ(row.at("people"), "12");
        }
    }
    EXPECT_EQ(groups.size(), GetParam().groups);
    EXPECT_THAT(readFile(folder_ / "report" / "report.html"),
                HasSubstr("<h3 id=\"numbers-scales\">Scales</h3>"));
}

const Kind kinds[] = {
    {"aic3-boosted", "triplets", 3, "without plain triplets"},
    {"bt500-comparison", "mean-comparison", 3, "comparison: sculpture, plain: "},
    {"bt500-dsis", "mean-opinion", 4, "impairment: figures, sky: "},
    {"constant-stimuli", "psychometric", 2, "75 % right answers lie between rays"},
    {"flicker", "psychometric", 2, "75 % right answers lie "},
    {"kozlowski-kautz-2007", "mean-opinion", 8, "appeal: atrium, sky: "},
    {"ladder", "threshold", 5, "answers \"not sure\""},
    {"demo", "thurstone", 3, "were never compared with each other"},
    {"mlds", "mlds", 1, "corrected by Holm) — larger: atrium, sky: s0"},
    {"p910-acr", "cumulative-link", 4, "quality: atrium, sky: "},
    {"p910-acr-hr", "mean-opinion", 4, "quality: atrium, sky: "},
    {"p910-ccr", "mean-comparison", 4, "By rising grades"},
    {"p910-dcr", "mean-opinion", 4, "By rising rating"},
    {"p910-pc", "thurstone", 3, "By rising JOD"},
    {"relaxed-2afc", "davidson", 5, "answers \"not sure\""},
    {"staircase", "psychometric", 1, "a staircase chose the steps"},
    {"yu-2009-rank", "plackett-luce", 5, "rank: atrium, sun: "},
};
INSTANTIATE_TEST_SUITE_P(Protocols, AnalysedStudy, testing::ValuesIn(kinds),
                         [](const testing::TestParamInfo<Kind>& one) {
                             std::string name = one.param.protocol;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

// The simulated observer finds rays8, the fourth step, in 75 % of its trials.
class LadderStudy : public AnalysedStudy {};
TEST_P(LadderStudy, FindsTheThresholdThatWasSimulated) {
    analysed(24);
    int found = 0;
    for (const test::Row& row : rows())
        if (row.at("what") == "item" && row.at("name") == "threshold") {
            ++found;
            EXPECT_LT(std::stod(row.at("low")), 4) << row.at("scene");
            EXPECT_GT(std::stod(row.at("high")), 4) << row.at("scene");
            EXPECT_LT(std::stod(row.at("high")) - std::stod(row.at("low")), 1.5);
        }
    EXPECT_EQ(found, static_cast<int>(GetParam().groups));
}
INSTANTIATE_TEST_SUITE_P(Protocols, LadderStudy,
                         testing::Values(Kind{"constant-stimuli", "", 2, ""},
                                         Kind{"staircase", "", 1, ""}));

// People who see choose by the predicted JOD of the manifest, and the analysis gives it back.
TEST(StudyWithEyes, IsAScaleOfPredictedJod) {
    const std::map<std::string, double> jods = {{"none", 8.1}, {"cheap", 8.8}, {"good", 10}};
    const test::Folder folder;
    const fs::path protocol = OBSCURA_SOURCE "/protocols/p910-pc.toml",
                   stimuli = folder / "stimuli";
    test::writeNoiseStimuli(readProtocol(protocol), stimuli);
    const std::string plan =
        fmt::format("'{}/obscura-analysis' plan '{}' --observer jod --stimuli "
                    "'{}' --studies 100 --out '{}'",
                    OBSCURA_BIN, protocol.string(), stimuli.string(), (folder / "plan").string());
    EXPECT_THAT(outputOf(plan, 1), HasSubstr("generate them anew with obscura-stimuli"));
    Manifest manifest = readManifest(stimuli / "manifest.json");
    manifest.display = displays().front();
    for (ConditionRecord& condition : manifest.conditions)
        for (ImageRecord& image : condition.images)
            image.quality = ImageQuality{0.1, jods.at(image.name), std::string(64, '0')};
    writeManifest(stimuli / "manifest.json", manifest);

    // 0.7 JOD, in R: pnorm(.7 * qnorm(.75)) is .6816.
    EXPECT_THAT(outputOf(plan), HasSubstr("68.2 %"));
    const std::string data = (folder / "data").string();
    outputOf(fmt::format("'{}/obscura-experiment' --protocol '{}' --stimuli '{}' --data '{}' "
                         "--simulate 30 --observer jod",
                         OBSCURA_BIN, protocol.string(), stimuli.string(), data));
    outputOf(fmt::format("'{}/obscura-analysis' '{}/p910-pc' --out '{}'", OBSCURA_BIN, data,
                         (folder / "report").string()));
    int steps = 0;
    for (const test::Row& row : test::rowsOf(folder / "report" / "scales.csv"))
        if (row.at("scale") == "thurstone" && row.at("what") == "step") {
            ++steps;
            const double truth = row.at("other") == "none" ? 0.7 : 1.2;
            EXPECT_LT(std::stod(row.at("low")), truth) << row.at("scene");
            EXPECT_GT(std::stod(row.at("high")), truth) << row.at("scene");
            EXPECT_EQ(row.at("source"), "SIMULATED");
        }
    EXPECT_EQ(steps, 6);
}

} // namespace
} // namespace obscura
