// Between the first onset and the question nothing may hold up a frame.
#include "experiment/display.h"
#include "experiment/timing_count.h"
#include "tests/experiment/desktop.h"
#include "tests/experiment/quiet.h"

#include <epoxy/gl.h>

#include <X11/keysym.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

namespace obscura {
namespace {

constexpr int width = 640, height = 400, planned = 60;

Image8 picture(int w, int h, std::uint8_t value) {
    return {w, h, 3, std::vector<std::uint8_t>(static_cast<std::size_t>(w * h) * 3, value)};
}

class QuietTest : public testing::Test {
  protected:
    test::Desktop desktop{width, height};
    test::Disturbances before;

    void SetUp() override { ::setenv("DISPLAY", desktop.name().c_str(), 1); }
};

// What holds up frames is noticed at all.
TEST_F(QuietTest, DisturbancesAreCounted) {
    Display display({{"quiet", 1, std::nullopt}}, [](int w, int h) { return picture(w, h, 128); });
    test::listenToShaders();
    before = test::disturbances();
    const auto number = std::make_unique<int>(1);
    EXPECT_GE((test::disturbances() - before).allocations, 1);
    std::ifstream("/proc/self/stat");
    EXPECT_GE((test::disturbances() - before).files, 1);
    const GLuint shader = glCreateShader(GL_FRAGMENT_SHADER);
    glCompileShader(shader);
    EXPECT_EQ((test::disturbances() - before).compilations, 1);
}

TEST_F(QuietTest, ImagesAndMaskAreShownWithoutAny) {
    Display display({{"quiet", 1, std::nullopt}, 128, true},
                    [](int w, int h) { return picture(w, h, 128); });
    test::listenToShaders();
    const Image8 pixels = picture(320, 180, 40);
    const gl::Picture image(pixels.width, pixels.height, pixels.channels, pixels.pixels);
    display.warmUp(image);
    RefreshCount count(display.refresh().hz, planned);
    desktop.tap(XK_space);

    before = test::disturbances();
    display.show(&image, true);
    std::size_t inputs = display.window().poll().size();
    while (count.refreshes() < planned) {
        count.add(display.show(nullptr));
        inputs += display.window().poll().size();
    }
    count.end(display.show(&image, true));
    const test::Disturbances found = test::disturbances() - before;
    EXPECT_EQ(found.allocations, 0);
    EXPECT_EQ(found.files, 0);
    EXPECT_EQ(found.compilations, 0);
    EXPECT_GT(inputs, 0U) << "of Space";
}

} // namespace
} // namespace obscura
