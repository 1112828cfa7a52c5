#include "base/error.h"
#include "base/files.h"
#include "image/image.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <limits>

namespace obscura {
namespace {

namespace fs = std::filesystem;

fs::path file(const std::string& name) { return fs::path(testing::TempDir()) / name; }

// IEC 61966-2-1: anchors of the curve.
TEST(Srgb, HasTheStandardsValues) {
    EXPECT_FLOAT_EQ(srgbFromLinear(0), 0);
    EXPECT_FLOAT_EQ(srgbFromLinear(1), 1);
    EXPECT_NEAR(srgbFromLinear(0.21586f) * 255, 128, 0.01f); // the mid-grey of the presenter
    EXPECT_NEAR(linearFromSrgb(0.04045f), 0.0031308f, 1e-6f);
    for (int code = 0; code < 256; ++code)
        EXPECT_NEAR(srgbFromLinear(linearFromSrgb(static_cast<float>(code) / 255)) * 255,
                    static_cast<float>(code), 1e-3f);
}

TEST(ImageFiles, PngKeepsEveryCodeValue) {
    Image8 image{16, 16, 3, {}};
    for (int i = 0; i < 16 * 16 * 3; ++i)
        image.pixels.push_back(static_cast<std::uint8_t>(i % 256));
    writePng(file("codes.png"), image);
    const Image8 read = readImage8(file("codes.png"));
    EXPECT_EQ(read.pixels, image.pixels);
    EXPECT_EQ(read.channels, 3);
}

TEST(ImageFiles, PngHasTheSameBytesEachTime) {
    const Image8 image{8, 8, 1, std::vector<std::uint8_t>(64, 77)};
    writePng(file("first.png"), image);
    writePng(file("second.png"), image);
    EXPECT_EQ(readFile(file("first.png")), readFile(file("second.png")));
}

// A full disk, played by a limit on the size of files: OpenImageIO itself would report a whole PNG.
TEST(ImageFiles, WhatDoesNotFitIsAnErrorAndLeavesTheOldFile) {
    const fs::path folder = file("full");
    fs::remove_all(folder);
    writePng(folder / "noise.png", Image8{8, 8, 1, std::vector<std::uint8_t>(64, 77)});
    const std::string before = readFile(folder / "noise.png");
    Image8 noise{64, 64, 3, {}};
    for (std::uint32_t i = 0, x = 1; i < 64 * 64 * 3; ++i, x = 1664525 * x + 1013904223)
        noise.pixels.push_back(static_cast<std::uint8_t>(x >> 24));
    const pid_t child = ::fork();
    if (child == 0) {
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{2000, 2000};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        try {
            writePng(folder / "noise.png", noise);
        } catch (const Error&) {
            ::_exit(0);
        }
        ::_exit(1);
    }
    int status = -1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_TRUE(readFile(folder / "noise.png") == before);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
}

// Bars that move: every grey, in another place in each frame.
TEST(ImageFiles, GifKeepsGreysFramesAndRate) {
    std::vector<Image8> frames(3, Image8{256, 2, 3, {}});
    for (int frame = 0; frame < 3; ++frame)
        for (int i = 0; i < 256 * 2 * 3; ++i)
            frames[static_cast<std::size_t>(frame)].pixels.push_back(
                static_cast<std::uint8_t>(i / 3 + 40 * frame));
    writeGif(file("bars.gif"), frames, 20);
    const auto input = OIIO::ImageInput::open(file("bars.gif").string());
    ASSERT_TRUE(input);
    for (int frame = 0; frame < 3; ++frame) {
        ASSERT_TRUE(input->seek_subimage(frame, 0));
        const OIIO::ImageSpec& spec = input->spec();
        const int* rate = static_cast<const int*>(spec.find_attribute("FramesPerSecond")->data());
        EXPECT_EQ(rate[0], 20 * rate[1]);
        ASSERT_EQ(spec.width, 256);
        std::vector<std::uint8_t> read(static_cast<std::size_t>(256 * 2 * 3));
        ASSERT_TRUE(input->read_image(frame, 0, 0, 3, OIIO::TypeDesc::UINT8, read.data()));
        for (std::size_t i = 0; i < read.size(); ++i)
            ASSERT_NEAR(read[i], frames[static_cast<std::size_t>(frame)].pixels[i], 1) << i;
    }
    EXPECT_FALSE(input->seek_subimage(3, 0));
}

TEST(ImageFiles, ExrKeepsFloats) {
    Image image{4, 2, 1, {0, 1e-6f, 0.5f, 1, 2, 1000, 0.1f, 3.14159265f}};
    writeExr(file("floats.exr"), image, std::array{std::string("V")}, true);
    EXPECT_EQ(readImage(file("floats.exr")).pixels, image.pixels);
}

TEST(ImageFiles, GreyFillsColourAndAlphaIsOpaque) {
    writePng(file("grey.png"), Image8{1, 1, 1, {9}});
    EXPECT_EQ(readImage8(file("grey.png"), 4).pixels, (std::vector<std::uint8_t>{9, 9, 9, 255}));
}

TEST(ImageFiles, AnErrorNamesTheFile) {
    writeFile(file("not.png"), "this is text");
    for (const char* name : {"not.png", "absent.png"})
        try {
            readImage8(file(name));
            FAIL() << name;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
        }
}

TEST(Comparison, MeasuresShiftsAndCountsNan) {
    const Image a{2, 1, 1, {0.5f, 0.5f}}, b{2, 1, 1, {0.6f, 0.6f}};
    const Difference difference = compare(a, b, 0.05);
    EXPECT_NEAR(difference.mean, 0.1, 1e-6); // a standard deviation would be blind to this
    EXPECT_NEAR(difference.rms, 0.1, 1e-6);
    EXPECT_EQ(difference.share, 1);
    const Image broken{2, 1, 1, {0.5f, std::numeric_limits<float>::quiet_NaN()}};
    EXPECT_EQ(compare(a, broken, 10).share, 0.5);
}

} // namespace
} // namespace obscura
