// Failure tests on techniques whose results are known in advance.
#include "base/error.h"
#include "bench/stability/failure_test.h"
#include "bench/stability/stability.h"
#include "tests/foreign_files.h"
#include "tests/renderer/techniques/occlusion_fixture.h"

#include <set>

namespace obscura {
namespace {

class FailureTests : public GlTest {
  protected:
    static constexpr ImageSize size{128, 72};
    static const FailureTestRow& row(std::string_view id) {
        for (const auto tests : {openTests(), occluderTests(), cameraTests(), invarianceTests()})
            for (const FailureTestRow& known : tests)
                if (known.about.id == id)
                    return known;
        throw std::invalid_argument("no such test");
    }
    // By measure; "" is the headline.
    static std::map<std::string, double> measured(std::string_view id, const char* configuration) {
        const Finding finding = row(id).make(size)->measure(TestedTechnique(configuration));
        std::map<std::string, double> values{{"", finding.value}};
        for (const Finding::Measure& measure : finding.others)
            values[measure.name] = measure.value;
        return values;
    }
    static double headlineOf(std::string_view id, const char* configuration) {
        return measured(id, configuration)[""];
    }
};

TEST_F(FailureTests, NoneFailsOnlyWhereSomethingShouldBeDark) {
    for (const StabilityTest& test : stabilityTests()) {
        const std::unique_ptr<FailureTest> built = row(test.id).make(size);
        const Finding finding = built->measure(TestedTechnique("none"));
        EXPECT_EQ(finding.picture.pixels.size(), finding.expected.pixels.size());
        const double value = finding.value;
        if (test.id == "hidden")
            EXPECT_NEAR(value, -0.3425, 0.005);
        else if (test.id == "thin")
            EXPECT_NEAR(value, -0.08, 0.03); // all that the rods keep from the floor
        else
            EXPECT_NEAR(value, 0, test.id == "grazing" ? 0.01 : 1e-6) << test.id;
    }
}

// Fact sheet, section 1.1: A^2 + A of half a ball is 3/4, of three quarters more than 1.
TEST_F(FailureTests, CrytekIsAQuarterDarkOnPlanesAndGlowsAtEdges) {
    const auto plane = measured("plane", "crytek");
    EXPECT_NEAR(plane.at("occlusion at 0°, 3 R away"), 0.25, 1e-3);
    EXPECT_NEAR(plane.at(""), 0.25, 0.03);
    const auto edge = measured("edge", "crytek");
    EXPECT_NEAR(edge.at("occlusion of the plane, box"), 0.25, 0.03);
    EXPECT_NEAR(edge.at(""), -0.22, 0.04);
}

// Section A.3, last column: a rim beyond the radius is nothing to horizons; to volumes the depth
// buffer is solid.
TEST_F(FailureTests, HiddenFacesAreKeptByVolumesOnly) {
    EXPECT_NEAR(headlineOf("hidden", "gtao denoise=0"), -0.3425, 0.01);
    EXPECT_NEAR(headlineOf("hidden", "hbao blur=0"), -0.3425, 0.01);
    EXPECT_NEAR(headlineOf("hidden", "volumetric_obscurance blur=0 samples=200"), 0.3164 - 0.3425,
                0.02);
    EXPECT_NEAR(headlineOf("hidden", "vao blur=0 samples=200"), 0.1564 - 0.3425, 0.02);
}

TEST_F(FailureTests, BandingIsTheTilesAndGoesWithTheBlurOfItsSize) {
    const double raw = headlineOf("banding", "starcraft blur=0");
    EXPECT_GT(raw, 0.01);
    EXPECT_LT(headlineOf("banding", "starcraft"), raw / 4);
}

TEST_F(FailureTests, ScaleChangesNothingForLengthsInRadii) {
    EXPECT_LT(headlineOf("scale", "hbao"), 0.005);
}

// Samples are on lines, which turning the camera turns: with many directions that is no matter.
TEST_F(FailureTests, RollIsUndone) {
    const auto roll = measured("roll", "gtao slices=8 steps=6 denoise=0 levelOffset=16");
    EXPECT_LT(roll.at("RMSE at 90°"), 0.05);
    EXPECT_NEAR(roll.at("occlusion gained at 90°"), 0, 0.01);
}

TEST_F(FailureTests, CoarseDepthDarkensPlanesFromAfar) {
    const auto far = measured("far", "hbao_plus");
    EXPECT_NEAR(far.at("plane, 32-bit at 1000 R"), far.at("plane, 32-bit at 5 R"), 0.01);
    EXPECT_GT(far.at("plane, 16-bit float at 1000 R"), 0.1);
}

TEST_F(FailureTests, AFolderKeepsOtherTestsAndIsOfOneProgram) {
    StabilityOptions options;
    options.configurations = {"none"};
    options.folder = std::filesystem::path(testing::TempDir()) / "kept";
    options.size = size;
    std::filesystem::remove_all(options.folder);
    const test::ForeignFiles foreign(options.folder);
    const auto run = [&](const char* test) {
        options.tests = {test};
        return runStability(options, [](double, const std::string&) {});
    };
    const std::size_t first = run("plane").size();
    const auto both = run("edge");
    EXPECT_GT(both.size(), first);
    EXPECT_EQ(both.front().test, "plane");
    EXPECT_EQ(run("edge").size(), both.size()); // in the place of what was
    EXPECT_THROW(run("dance"), Error);
    options.about = "{\"program\": \"another\"}";
    EXPECT_THROW(run("plane"), Error);
    options.anew = true; // as a choice begins, which asks of one program only
    EXPECT_EQ(run("plane").size(), first);
    EXPECT_EQ(foreign.lost(), "");
}

TEST_F(FailureTests, TestsAreTold) {
    std::set<std::string_view> ids;
    for (const StabilityTest& test : stabilityTests()) {
        EXPECT_TRUE(ids.insert(test.id).second);
        EXPECT_FALSE(test.title.empty() || test.setUp.empty() || test.measure.empty());
        EXPECT_LT(test.pass, test.fail);
    }
    EXPECT_EQ(ids.size(), 13u);
}

} // namespace
} // namespace obscura
