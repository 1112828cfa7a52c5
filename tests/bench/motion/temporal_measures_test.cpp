// Pictures whose changes are known in closed form, on a wall that a step aside moves by 2.5 pixels.
#include "bench/motion/temporal_measures.h"
#include "tests/bench/motion/plane_surfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace obscura {
namespace {

constexpr double shift = 2.5; // pixels a frame
constexpr int frames = 8;

using Picture = std::function<double(double x, double y, int frame)>;

Image drawn(const Picture& picture, int frame) {
    Image image{planeWidth, planeHeight, 1, {}};
    for (int y = 0; y < planeHeight; ++y)
        for (int x = 0; x < planeWidth; ++x)
            image.pixels.push_back(static_cast<float>(picture(x, y, frame)));
    return image;
}

Surfaces wallAt(int frame) { return wallSurfaces(planeCamera(0.25 * frame), 4); }

MotionError measured(const Picture& technique, const Picture& truth) {
    MotionError error;
    std::optional<FrameStep> last;
    error.start(drawn(technique, 0));
    for (int frame = 1; frame < frames; ++frame) {
        const Surfaces before = wallAt(frame - 1), now = wallAt(frame);
        FrameStep step{std::vector<bool>(now.depth.size(), true),
                       Reprojection(now, before),
                       Reprojection(before, now),
                       drawn(truth, frame),
                       {}};
        const Image truthBefore = drawn(truth, frame - 1);
        step.warpedChange = warpedChange(step.change, truthBefore, step.back);
        for (std::size_t i = 0; i < now.depth.size(); ++i)
            step.change.pixels[i] -= truthBefore.pixels[i];
        error.step(drawn(technique, frame), step, last ? &*last : nullptr);
        last = std::move(step);
    }
    return error;
}

// Linear across the picture, so that bilinear fetches are exact: on the wall, and on the screen.
double onWall(double x, double y, int frame) {
    return 0.2 + 0.005 * (x + shift * frame) + 0.003 * y;
}
double onScreen(double x, double y, int) { return 0.2 + 0.005 * x + 0.003 * y; }
double open(double, double, int) { return 1; }
double unlike(double x, double y, int frame) { // anything
    return 0.5 + 0.5 * std::sin(12.9898 * x + 78.233 * y + 37.719 * frame);
}

constexpr double rounding = 1.0 / 32768;

TEST(MotionError, APictureOnTheWallIsSteady) {
    const MotionError error = measured(onWall, onWall);
    EXPECT_NEAR(error.warpingError(), 0, 1e-9);
    EXPECT_NEAR(error.second().percentile(1), 0, 1e-4);
    EXPECT_GT(error.second().count(), 0);
}

TEST(MotionError, APictureOnTheScreenSlidesOverTheWall) {
    const MotionError error = measured(onScreen, open);
    EXPECT_NEAR(error.warpingError(), std::pow(0.005 * shift, 2), 1e-8);
    EXPECT_NEAR(error.unreal().mean(), 0.005 * shift, 1e-5);
    EXPECT_NEAR(error.unrealAtPixels().mean(), 0, 1e-7);
    EXPECT_NEAR(error.second().percentile(1), 0, 1e-4); // a steady slide is no flicker
}

TEST(MotionError, TheTruthsOwnChangeIsNoError) {
    for (const Picture& picture : {Picture(onWall), Picture(onScreen), Picture(unlike)}) {
        const MotionError error = measured(picture, picture);
        EXPECT_EQ(error.unreal().percentile(1), 0);
        EXPECT_EQ(error.unrealAtPixels().percentile(1), 0);
    }
    EXPECT_GT(measured(unlike, unlike).warpingError(), 0.1); // which knows no truth
}

// The wall's picture passes each pixel by 2.5 pixels a frame.
TEST(MotionError, AConstantPictureLacksTheTruthsChange) {
    const MotionError error = measured(open, onWall);
    EXPECT_NEAR(error.unrealAtPixels().mean(), 0.005 * shift, 1e-5);
    EXPECT_NEAR(error.unreal().percentile(1), 0, 1e-4);
    EXPECT_NEAR(measured(open, onScreen).unreal().mean(), 0.005 * shift, 1e-5);
}

TEST(MotionError, FlickerOfAKnownAmplitudeIsFound) {
    constexpr double amplitude = 0.03;
    const MotionError error = measured(
        [](double x, double y, int frame) {
            return onWall(x, y, frame) + (frame % 2 ? amplitude : -amplitude);
        },
        onWall);
    for (const double value :
         {error.unreal().mean(), error.unrealAtPixels().mean(), error.unreal().percentile(0.99)})
        EXPECT_NEAR(value, 2 * amplitude, 1e-4);
    EXPECT_NEAR(error.second().mean(), 4 * amplitude, 1e-4);
    EXPECT_NEAR(error.warpingError(), std::pow(2 * amplitude, 2), 1e-5);
}

TEST(MotionError, OneFlashIsTheWorstFrame) {
    const MotionError error = measured(
        [](double x, double y, int frame) { return onWall(x, y, frame) + (frame == 5 ? 0.1 : 0); },
        onWall);
    EXPECT_TRUE(error.worstFrame() == 5 || error.worstFrame() == 6);
    const float middle = error.unrealPicture().at(planeWidth / 2, planeHeight / 2, 0);
    EXPECT_NEAR(middle, 0.2 / (frames - 1), 1e-4); // there and back again in seven steps
}

// A wall that moves by 2.5 pixels a frame to the left: each frame brings as much over the right
// border.
TEST(NewlySeen, HoldsForEightFramesOnTheSurface) {
    NewlySeen newly(planeWidth * planeHeight);
    const auto count = [&] { // in the middle row
        int sum = 0;
        for (std::size_t x = 0; x < planeWidth; ++x)
            sum += newly[planeHeight / 2 * planeWidth + x];
        return sum;
    };
    EXPECT_EQ(count(), 0);
    for (int frame = 1; frame <= 12; ++frame) {
        newly.step(Reprojection(wallAt(frame), wallAt(frame - 1)));
        EXPECT_NEAR(count(), shift * std::min(frame, NewlySeen::frames), 2.5) << frame;
    }
    for (int frame = 1; frame <= NewlySeen::frames; ++frame) { // and stops
        EXPECT_GT(count(), 0) << frame;
        newly.step(Reprojection(wallAt(12), wallAt(12)));
    }
    EXPECT_EQ(count(), 0);
}

TEST(TruthError, IsTheRootOfTheMeanSquare) {
    TruthError error;
    EXPECT_TRUE(std::isnan(error.rmse()));
    error.add(0.75f, 0.25f);
    error.add(0, 0);
    EXPECT_NEAR(error.rmse(), 0.5 / std::sqrt(2.0), 1e-9);
}

TEST(StillNoise, GivesTheDeviationOfTheNoise) {
    constexpr double deviation = 0.05, c4 = 0.99577; // mean of the estimate of 60 normal values
    std::mt19937_64 random(1);
    std::normal_distribution<double> noise(0.5, deviation);
    StillNoise still;
    for (int frame = 0; frame < 60; ++frame)
        still.add(drawn([&](double, double, int) { return noise(random); }, frame));
    double sum = 0;
    for (const float value : still.deviation().pixels)
        sum += static_cast<double>(value);
    EXPECT_NEAR(sum / (planeWidth * planeHeight), c4 * deviation, 5e-4);
}

TEST(StillNoise, TwoFramesGiveTheUnbiasedEstimate) {
    StillNoise still;
    still.add(Image{1, 1, 1, {0.25f}});
    still.add(Image{1, 1, 1, {0.75f}});
    EXPECT_NEAR(still.deviation().pixels[0], 0.5 / std::sqrt(2.0), 1e-6);
}

TEST(Magnitudes, MeanAndPercentilesOfAHundred) {
    Magnitudes magnitudes;
    for (int i = 1; i <= 100; ++i)
        magnitudes.add(i / 100.0);
    EXPECT_NEAR(magnitudes.mean(), 0.505, 1e-12);
    EXPECT_NEAR(magnitudes.percentile(0.99), 0.99, rounding);
    EXPECT_NEAR(magnitudes.percentile(0), 0.01, rounding);
    EXPECT_NEAR(magnitudes.percentile(1), 1, rounding);
    EXPECT_TRUE(std::isnan(Magnitudes().mean()));
}

} // namespace
} // namespace obscura
