#include "experiment/pages.h"
#include "protocols/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace obscura {
namespace {

const Texts texts{"First line.\n\nÆblegrød, 日本語, Ελληνικά – all of UTF-8.",
                  "Press Space to see the next pair.",
                  "Which looked most realistic?",
                  "The first image",
                  "The second image",
                  "Thank you."};

struct Size {
    int width, height;
};
constexpr Size sizes[] = {{640, 400}, {1280, 720}, {1280, 800}, {1920, 1080}, {3840, 2160}};

int darkest(const Image8& image) {
    return *std::min_element(image.pixels.begin(), image.pixels.end());
}

// Rows that hold anything but the background.
std::pair<int, int> inkedRows(const Image8& image, int grey) {
    std::pair<int, int> rows{image.height, -1};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < 3 * image.width; ++x)
            if (image.pixels[static_cast<std::size_t>(y * 3 * image.width + x)] != grey) {
                rows.first = std::min(rows.first, y);
                rows.second = y;
                break;
            }
    return rows;
}

TEST(Text, SurroundIsTheStudysGrey) {
    for (const int grey : {0, 64, 128, 200, 255}) {
        const Image8 image = drawPage(instructionsPage(texts), 1280, 720, grey).image;
        EXPECT_EQ(image.pixels.front(), grey);
        EXPECT_EQ(image.pixels.back(), grey);
    }
}

TEST(Text, EveryPageFitsEveryScreen) {
    for (const Size size : sizes)
        for (const Page& page :
             {instructionsPage(texts), startPage(texts, 3, 7), questionPage(texts), leavePage(),
              thanksPage(texts), idPage("P01", "")}) {
            const DrawnPage drawn = drawPage(page, size.width, size.height, 128);
            EXPECT_EQ(drawn.image.width, size.width);
            const auto [top, bottom] = inkedRows(drawn.image, 128);
            EXPECT_GT(top, 0);
            EXPECT_GT(bottom, top);
            EXPECT_LT(bottom, size.height - 1);
            EXPECT_LT(darkest(drawn.image), 20);
        }
}

TEST(Text, OptionsAreSideBySideOfOneSizeAndOnScreen) {
    for (const Size size : sizes) {
        const auto options = drawPage(questionPage(texts), size.width, size.height, 128).options;
        ASSERT_EQ(options.size(), 2u);
        const auto& [left, right] = std::pair(options[0], options[1]);
        EXPECT_EQ(left.y, right.y);
        EXPECT_EQ(left.width, right.width);
        EXPECT_LE(left.x + left.width, right.x);
        EXPECT_GT(left.x, 0);
        EXPECT_LT(right.x + right.width, size.width);
        EXPECT_NEAR(left.x, size.width - right.x - right.width, 2) << "centred";
        EXPECT_TRUE(left.contains(left.x, left.y));
        EXPECT_FALSE(left.contains(right.x, right.y));
    }
}

TEST(Text, LongTextIsSetSmallerAndThenRefused) {
    std::string words;
    for (int i = 0; i < 80; ++i)
        words += "Look at each image. ";
    Texts longer = texts;
    longer.instructions = words;
    EXPECT_NO_THROW(drawPage(instructionsPage(longer), 1280, 720, 128));
    longer.instructions = words + words + words;
    EXPECT_THAT([&] { drawPage(instructionsPage(longer), 1280, 720, 128); },
                testing::ThrowsMessage<Error>(
                    testing::AllOf(testing::HasSubstr("too long for a screen of 1280x720 pixels"),
                                   testing::HasSubstr("Look at each image."))));
}

// On the smallest screen that can show its images, the warning included.
TEST(Text, TheShippedProtocolsFitTheirScreens) {
    int found = 0;
    for (const auto& entry : std::filesystem::directory_iterator(OBSCURA_SOURCE "/protocols")) {
        // Studies of techniques, not of people, have other files: match-*.toml and sweep-*.toml.
        if (entry.path().extension() != ".toml" ||
            entry.path().filename().string().starts_with("match-") ||
            entry.path().filename().string().starts_with("sweep-"))
            continue;
        ++found;
        const Protocol protocol = readProtocol(entry.path());
        for (Page page : {instructionsPage(protocol.texts), startPage(protocol.texts, 7, 7),
                          questionPage(protocol.texts), thanksPage(protocol.texts)}) {
            page.warning = "Untimed display: not suitable for data collection";
            EXPECT_NO_THROW(drawPage(page, protocol.width, protocol.height, protocol.trial.grey))
                << entry.path();
        }
    }
    EXPECT_GT(found, 0);
}

TEST(Text, StartPageCountsPairs) { EXPECT_EQ(startPage(texts, 3, 7).heading, "3 / 7"); }

TEST(Text, TheWarningIsABandAcrossTheTop) {
    Page page = questionPage(texts);
    page.warning = "Not suitable for data collection";
    const Image8 image = drawPage(page, 1280, 720, 128).image;
    EXPECT_LT(image.pixels[0], 20);
    EXPECT_LT(image.pixels[3 * 1279], 20);
}

} // namespace
} // namespace obscura
