// Whole tests on a small scene.
#include "base/error.h"
#include "bench/motion/temporal.h"
#include "bench/motion/temporal_tests.h"
#include "tests/renderer/techniques/occlusion_fixture.h"

#include <algorithm>

namespace obscura {
namespace {

namespace fs = std::filesystem;

NamedSettings named(const char* id) { return {id, Settings(technique(id))}; }

class Temporal : public GlTest {
  protected:
    Temporal() {
        addQuad(scene_, {glm::vec3(-4, 0, 4), glm::vec3(4, 0, 4), glm::vec3(4, 0, -4),
                         glm::vec3(-4, 0, -4)});
        addQuad(scene_, {glm::vec3(-1, 0, -1), glm::vec3(1.5, 0, -1), glm::vec3(1.5, 2, -1),
                         glm::vec3(-1, 2, -1)});
        camera_.position = {1, 1.5, 3};
        camera_.target = {0, 0.3, -1};
        folder_ = fs::path(testing::TempDir()) / "temporal";
    }
    TemporalStudy study(std::vector<std::string> tests) const {
        return {scene_,
                camera_,
                0.5,
                {named("none"), named("starcraft"), named("alchemy"), named("ray_traced")},
                {64, 36, 4, 64, std::move(tests)},
                folder_};
    }
    static double value(const std::vector<StabilityCell>& cells, const std::string& technique,
                        const std::string& test) {
        return headlineOf(cells, technique, test); // whose names are those of the techniques
    }
    static double headlineOf(const std::vector<StabilityCell>& cells,
                             const std::string& configuration, const std::string& test) {
        for (const StabilityCell& cell : cells)
            if (cell.configuration == configuration && cell.test == test &&
                cell.measure == temporalTest(test).test.measure)
                return cell.value;
        throw Error("expected a cell of " + configuration);
    }

    Scene scene_;
    Camera camera_;
    fs::path folder_;
};

// Mean change of the truth over points that both frames show.
double ownChange(const Shot& before, const Shot& now) {
    const Reprojection back(now.surfaces, before.surfaces);
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < now.truth.pixels.size(); ++i)
        if (back.valid(i)) {
            sum += std::abs(static_cast<double>(now.truth.pixels[i]) -
                            static_cast<double>(back.fetch(before.truth, i)));
            ++count;
        }
    return sum / count;
}

TEST_F(Temporal, NoneChangesByWhatItLacks) {
    const auto cells = measureTemporal(study({"cut"}));
    const Shots shots(scene_, {}, 64, 36);
    const auto shot = [&](int frame) {
        Shot taken = shots.take(temporalTest("cut").camera(camera_, frame, 4), 1, {});
        taken.truth = shots.truth(taken.surfaces, {Integral::cosine, 0.5, 64, 0});
        return taken;
    };
    const double own = ownChange(shot(0), shot(3));
    EXPECT_GT(own, 1e-3);
    EXPECT_NEAR(value(cells, "none", "cut"), own, 1e-6);
    EXPECT_LT(value(cells, "ray_traced", "cut"), own); // noise alone
}

TEST_F(Temporal, OnlyNoiseFlickersBeforeAStillCamera) {
    const auto cells = measureTemporal(study({"still"}));
    EXPECT_EQ(value(cells, "none", "still"), 0);
    EXPECT_GT(value(cells, "alchemy", "still"), 1e-3);
    EXPECT_NE(cells.back().measure, worstFlicker); // nothing moves
}

TEST_F(Temporal, WritesTheCellsPicturesAndTheAnimation) {
    std::vector<double> shares;
    const auto cells = measureTemporal(
        study({"turn", "cut"}), [&](double share, const std::string&) { shares.push_back(share); });
    ASSERT_EQ(cells.size(), 4 * 8 + 4 * 6 + 1); // a cut has no second differences; nothing
                                                // comes into sight
    for (const StabilityCell& cell : cells) {
        EXPECT_TRUE(std::isfinite(cell.value)) << cell.measure;
        EXPECT_TRUE(cell.picture.empty() || fs::exists(folder_ / cell.picture));
    }
    const Image8 strip = readImage8(folder_ / "pictures/turn-alchemy.png");
    EXPECT_EQ(strip.width, 3 * 64);
    EXPECT_EQ(cells.back().measure, worstFlicker);
    EXPECT_EQ(cells.back().test, "turn"); // a cut is no path
    EXPECT_EQ(cells.back().picture, "pictures/turn-" + cells.back().configuration + ".gif");
    EXPECT_TRUE(fs::exists(folder_ / cells.back().picture));
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_EQ(shares.size(), 2 * 2 * 4); // the truths of frames, and frames
}

// The study of a picture that is all noise, alone and as the mean of eight frames.
TemporalStudy withAndWithout(TemporalStudy study, int frames) {
    Settings settings(technique("alchemy"));
    settings.set("blur", 0);
    study.configurations = {{"alone", settings}};
    settings.set("accumulate", 8);
    study.configurations.push_back({"accumulated", settings});
    study.effort.frames = frames;
    return study;
}

// Noise alone flickers, and the mean of eight frames less: by the root of 15 if all were
// independent, for an exponential mean of weight 1 / n is one of 2 n - 1 frames.
TEST_F(Temporal, AccumulationSteadiesAStillCamera) {
    const auto cells = measureTemporal(withAndWithout(study({"still"}), 12));
    const double alone = headlineOf(cells, "alone", "still"),
                 accumulated = headlineOf(cells, "accumulated", "still");
    EXPECT_GT(alone, 0.005);
    EXPECT_LT(accumulated, alone / 3);
    EXPECT_GT(accumulated, alone / 12); // noise cycles
}

// On the orbit next to nothing changes, so that noise alone tells the picture from a still one;
// after the cut history comes from twice as far.
TEST_F(Temporal, OnlyWhatAccumulatesHasGhosts) {
    const auto cells = measureTemporal(withAndWithout(study({"orbit", "cut"}), 6));
    int ghosts = 0;
    for (const StabilityCell& cell : cells) {
        if (!cell.measure.starts_with("ghosts"))
            continue;
        EXPECT_EQ(cell.configuration, "accumulated");
        EXPECT_LT(cell.value, cell.test == "orbit" ? 0.05 : 0.2) << cell.measure;
        ++ghosts;
    }
    EXPECT_GE(ghosts, 2);
}

TEST_F(Temporal, BadInputIsAnError) {
    EXPECT_THROW(measureTemporal(study({"dance"})), Error);
    TemporalStudy tooShort = study({"turn"});
    tooShort.effort.frames = 2;
    EXPECT_THROW(measureTemporal(tooShort), Error);
}

} // namespace
} // namespace obscura
