#include "experiment/pages.h"
#include "experiment/script.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace obscura {
namespace {

constexpr int width = 1280, height = 720;

Texts textsOf(const std::string& instructions) {
    Texts texts;
    texts.instructions = instructions;
    texts.question = texts.first = texts.second = "x";
    return texts;
}
const Texts english = textsOf("Look at each.");
const Texts arabic = textsOf("ترى صورتين واحدة بعد الأخرى ثم تختار الأكثر واقعية.");

Question question(Question::Kind kind, std::vector<std::string> options = {}) {
    Question result;
    result.name = "q";
    result.kind = kind;
    result.options = std::move(options);
    return result;
}

std::vector<Box> boxesOf(const Texts& texts, const Question& asked) {
    return drawPage(formPage(texts, Form({asked}, 2), {}), width, height, 128).options;
}

bool isInk(const Image8& image, int x, int y) {
    return image.pixels[static_cast<std::size_t>((y * image.width + x) * 3)] < 60;
}

TEST(RightToLeft, MostLettersDecide) {
    EXPECT_FALSE(runsFromRightToLeft(""));
    EXPECT_FALSE(runsFromRightToLeft("12 / 14!"));
    EXPECT_FALSE(runsFromRightToLeft("Look: صورة"));
    EXPECT_FALSE(runsFromRightToLeft("请看图片"));
    EXPECT_TRUE(runsFromRightToLeft("Obscura: ترى صورتين واحدة بعد الأخرى"));
    EXPECT_TRUE(runsFromRightToLeft("תראו שתי תמונות"));
    EXPECT_TRUE(runsFromRightToLeft("ހަށިގަނޑު")) << "Thaana";
    EXPECT_FALSE(runsFromRightToLeft("\xff\xfe")) << "no UTF-8";
}

TEST(RightToLeft, TheFirstOptionIsWhereReadingBegins) {
    for (const auto kind : {Question::Kind::choice, Question::Kind::scale}) {
        const Question asked = question(kind, {"first", "second", "question"});
        const auto left = boxesOf(english, asked), right = boxesOf(arabic, asked);
        ASSERT_EQ(right.size(), 3u);
        EXPECT_LT(left[0].x, left[1].x);
        EXPECT_LT(left[1].x, left[2].x);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(right[i].x, left[2 - i].x, 1);
    }
}

// The left image's option is the left one for every reader; and the pictures are where they are.
TEST(RightToLeft, OptionsOfImagesBesideEachOtherAreInTheirOrder) {
    Question asked = question(Question::Kind::choice, {"first", "second"});
    asked.images = asked.beside = true;
    const auto boxes = boxesOf(arabic, asked);
    EXPECT_LT(boxes[0].x, boxes[1].x);
    const auto ranks = boxesOf(arabic, question(Question::Kind::rank));
    EXPECT_LT(ranks[0].x, ranks[1].x);
    Page page = formPage(arabic, Form({asked}, 2), {2, 300, 170});
    const auto pictures = drawPage(page, width, height, 128).pictures;
    EXPECT_LT(pictures[0].x, pictures[1].x);
}

// The knob stands a quarter of the way from the end that is low.
TEST(RightToLeft, ASlidersLowEndIsWhereReadingBegins) {
    for (const bool mirrored : {false, true}) {
        Page page;
        page.rightToLeft = mirrored;
        Page::Part part;
        part.slider = Page::Slider{0.25, "", "", ""};
        page.parts = {part};
        const DrawnPage drawn = drawPage(page, width, height, 128);
        const Box& box = drawn.options.at(0);
        const auto heightAt = [&](double share) { // of the ink
            const int x = box.x + static_cast<int>(share * box.width);
            int count = 0;
            for (int y = box.y; y < box.y + box.height; ++y)
                count += isInk(drawn.image, x, y);
            return count;
        };
        EXPECT_GT(heightAt(mirrored ? 0.75 : 0.25), 10);
        EXPECT_LT(heightAt(mirrored ? 0.25 : 0.75), 10);
    }
}

// A long paragraph and a short one: the short one ends where the long one does, on the side from
// which it is read.
TEST(RightToLeft, LinesAreFlushWithTheSideFromWhichTheyAreRead) {
    for (const auto& [texts, word] : {std::pair(&english, "Look "), std::pair(&arabic, "صورة ")}) {
        std::string line;
        for (int i = 0; i < 30; ++i)
            line += word;
        Texts longer = *texts;
        longer.instructions = line + "\n\n" + word;
        Page page = instructionsPage(longer);
        page.options.clear();
        const Image8 image = drawPage(page, width, height, 128).image;
        std::pair<int, int> all{width, 0}, last{width, 0};
        int bottom = height - 1;
        const auto inked = [&](int y) {
            for (int x = 0; x < width; ++x)
                if (isInk(image, x, y))
                    return true;
            return false;
        };
        while (!inked(bottom))
            --bottom;
        for (int y = 0; y <= bottom; ++y)
            for (int x = 0; x < width; ++x)
                if (isInk(image, x, y))
                    for (auto* columns : {&all, &last})
                        if (columns == &all || y > bottom - 20)
                            *columns = {std::min(columns->first, x), std::max(columns->second, x)};
        const bool fromRight = texts == &arabic;
        EXPECT_NEAR(fromRight ? last.second : last.first, fromRight ? all.second : all.first, 4);
        EXPECT_GT(std::abs(fromRight ? last.first - all.first : last.second - all.second), 200);
    }
}

// Isolated, so that neither a sign nor an end of a range changes sides.
TEST(RightToLeft, NumbersStayWhole) {
    Question asked = question(Question::Kind::number);
    asked.text = "question";
    asked.least = -20;
    asked.most = 20.5;
    EXPECT_EQ(formPage(arabic, Form({asked}, 2), {}).parts[0].label,
              "x (\u2066\u221220\u2069 – \u206620.5\u2069)");
    Texts chinese = english;
    chinese.language = "zh-Hans";
    asked.least = 0;
    EXPECT_EQ(formPage(chinese, Form({asked}, 2), {}).parts[0].label,
              "x（\u20660\u2069–\u206620.5\u2069）");
}

// What is typed runs as its own letters do, the caret after them, and stands on the side from which
// the page is read.
TEST(RightToLeft, WhatIsTypedRunsAsItsOwnLetters) {
    struct Ink {
        int left, right, caret; // columns from the field's middle; the caret's is the fullest
    };
    const auto inkOf = [](const std::string& typed, bool fromRight) {
        Page page;
        page.rightToLeft = fromRight;
        Page::Part part;
        part.field = Page::Field{typed, true};
        page.parts = {part};
        const DrawnPage drawn = drawPage(page, width, height, 128);
        const Box& box = drawn.options.at(0);
        Ink ink{width, -width, 0};
        int fullest = 0;
        for (int x = box.x + 6; x < box.x + box.width - 6; ++x) {
            int count = 0;
            for (int y = box.y + 6; y < box.y + box.height - 6; ++y)
                count += isInk(drawn.image, x, y);
            const int column = x - box.x - box.width / 2;
            if (count > 0)
                ink = {std::min(ink.left, column), std::max(ink.right, column), ink.caret};
            if (count > fullest) {
                fullest = count;
                ink.caret = column;
            }
        }
        return ink;
    };
    for (const bool fromRight : {false, true}) {
        const Ink latin = inkOf("P07-", fromRight), hebrew = inkOf("אבג", fromRight);
        for (const Ink& ink : {latin, hebrew}) {
            EXPECT_EQ(ink.left > 0, fromRight);
            EXPECT_EQ(ink.right < 0, !fromRight);
        }
        EXPECT_GT(latin.caret, (latin.left + latin.right) / 2);
        EXPECT_LT(hebrew.caret, (hebrew.left + hebrew.right) / 2);
    }
}

} // namespace
} // namespace obscura
