#include "experiment/pages.h"

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

// What is typed runs as its own letters do, the caret after them: "P01" and its caret look the same
// on both pages, but stand on the side from which the page is read.
TEST(RightToLeft, WhatIsTypedRunsAsItsOwnLetters) {
    const auto typed = [&](const Texts& texts) {
        const Image8 image = drawPage(idPage(texts, "P01", ""), width, height, 128).image;
        std::vector<int> rows;
        int left = width, right = 0, most = 0, middle = 0;
        for (int y = 0; y < height; ++y) { // through the field: its two sides are the only ink
            int first = -1, final = -1, count = 0;
            for (int x = 0; x < width; ++x)
                if (isInk(image, x, y)) {
                    first = first < 0 ? x : first;
                    final = x;
                    ++count;
                }
            if (count > most) { // its upper or lower edge
                most = count;
                left = first;
                right = final;
                middle = y;
            }
        }
        // Of what is within the field, and the tallest column, which is the caret's.
        std::pair<int, int> ink{width, 0}, tallest{0, 0};
        for (int x = left + 6; x < right - 6; ++x) {
            int count = 0;
            for (int y = std::max(0, middle - 70); y < std::min(height, middle + 70); ++y)
                count += isInk(image, x, y) && std::abs(y - middle) > 6;
            if (count > 0)
                ink = {std::min(ink.first, x), std::max(ink.second, x)};
            tallest = std::max(tallest, std::pair(count, x));
        }
        return std::array{left, ink.first, tallest.second, ink.second, right};
    };
    Texts bare = arabic, plain = english;
    for (Texts* texts : {&bare, &plain})
        texts->id = texts->idNote = "";
    const auto [l, from, caret, to, r] = typed(bare);
    EXPECT_GT(from, (l + r) / 2) << "on the right";
    EXPECT_GT(caret, (from + to) / 2) << "after what is typed";
    const auto [l2, from2, caret2, to2, r2] = typed(plain);
    EXPECT_LT(to2, (l2 + r2) / 2);
    EXPECT_GT(caret2, (from2 + to2) / 2);
    EXPECT_NEAR(to - from, to2 - from2, 1);
}

} // namespace
} // namespace obscura
