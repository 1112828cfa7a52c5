#include "base/error.h"
#include "experiment/pages.h"
#include "tests/experiment/pair_pages.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace obscura {
namespace {

using test::questionPage;
using test::startPage;

Texts withWords(const std::string& instructions, const std::string& start,
                const std::string& question, const std::string& first, const std::string& second,
                const std::string& thanks) {
    Texts texts;
    texts.instructions = instructions;
    texts.start = start;
    texts.question = question;
    texts.first = first;
    texts.second = second;
    texts.thanks = thanks;
    return texts;
}

const Texts texts = withWords("First line.\n\nÆblegrød, שלום, Ελληνικά – all of UTF-8.",
                              "Press Space to see the next pair.", "Which looked most realistic?",
                              "The first image", "The second image", "Thank you.");

const std::string arabicWords = "ترى صورتين واحدة بعد الأخرى ثم تختار الأكثر واقعية. ";
const Texts arabic =
    withWords(arabicWords + arabicWords + arabicWords + "\n\n" + arabicWords, "اضغط مفتاح المسافة.",
              "أي صورة بدت أكثر واقعية؟", "الأولى", "الثانية", "شكرا لكم!");
const Texts hebrew = withWords("תראו שתי תמונות, זו אחר זו.", "הקישו על מקש הרווח.",
                               "איזו תמונה נראתה מציאותית יותר?", "הראשונה", "השנייה", "תודה רבה!");
const Texts mixed = withWords("English first.\nثم العربية.\nואז עברית.", "Press המקש now.",
                              "Which of الصورتين looked real?", "الأولى (1)", "the second – השנייה",
                              "شكرا / thanks");

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
        for (const Page& page : {instructionsPage(texts), startPage(texts, 3, 7),
                                 questionPage(texts), leavePage(texts), thanksPage(texts),
                                 idPage(texts, "P01", ""), loadingPage(texts, 3, 14)}) {
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

Question scaleOf(const std::vector<std::string>& options) {
    Question question;
    question.name = "comparison";
    question.kind = Question::Kind::scale;
    question.text = "question";
    question.options = options;
    return question;
}

// Seven grades as BT.500 has them: broken inside their words, they would stand in tall columns.
TEST(Text, LabelsOfManyOptionsAreNotBrokenInsideWords) {
    Texts grades = texts;
    grades.own = {{"c1", "much worse"},   {"c2", "worse"},  {"c3", "slightly worse"},
                  {"c4", "the same"},     {"c5", "better"}, {"c6", "slightly better"},
                  {"c7", "imperceptible"}};
    const Form form({scaleOf({"c1", "c2", "c3", "c4", "c5", "c6", "c7"})}, 2);
    for (const Size size : sizes) {
        const auto options =
            drawPage(formPage(grades, form, {}), size.width, size.height, 128).options;
        ASSERT_EQ(options.size(), 7u);
        for (const Box& box : options) {
            EXPECT_LT(box.height, size.height / 4) << size.width;
            EXPECT_GE(box.x, 0);
            EXPECT_LE(box.x + box.width, size.width);
        }
    }
}

// No break would do: then inside the word, not outside the screen.
TEST(Text, LabelOfOneWordThatNothingHoldsIsBroken) {
    Texts grades = texts;
    grades.own = {{"c1", std::string(60, 'w')}, {"c2", "no"}};
    const Form form({scaleOf({"c1", "c2", "c2", "c2", "c2"})}, 2);
    const auto options = drawPage(formPage(grades, form, {}), 1280, 720, 128).options;
    EXPECT_GE(options.front().x, 0);
    EXPECT_LE(options.back().x + options.back().width, 1280);
}

// The numbers under images are those that answers have for them; a reference has none.
TEST(Text, ImagesAreNumberedAsTheAnswersNameThem) {
    Phase phase;
    phase.images = {"1", "reference", "2"};
    phase.questions.resize(1);
    EXPECT_THAT(roomFor(phase, 400, 225).names, testing::IsEmpty()) << "of a scale with its own 1";
    phase.questions.front().images = true;
    EXPECT_THAT(roomFor(phase, 400, 225).names, testing::ElementsAre("1", "", "2"));
    phase.questions.front() = {};
    phase.questions.front().kind = Question::Kind::rank;
    EXPECT_THAT(roomFor(phase, 400, 225).names, testing::ElementsAre("1", "", "2"));
    phase.images = {"1"};
    EXPECT_THAT(roomFor(phase, 400, 225).names, testing::IsEmpty());
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
        for (const Texts* words : protocol.languages()) {
            EXPECT_NO_THROW(checkShowable(*words)) << entry.path();
            std::vector<Page> pages = {instructionsPage(*words), startPage(*words, 7, 7),
                                       questionPage(*words),     leavePage(*words),
                                       thanksPage(*words),       declinedPage(*words)};
            for (const Phase& page : protocol.before)
                pages.push_back(formPage(*words, Form(page.questions, 0), {}, page.text));
            for (Page& page : pages) {
                page.warning = words->untimed;
                EXPECT_NO_THROW(drawPage(unfocused(page, *words), protocol.width, protocol.height,
                                         protocol.trial.grey))
                    << entry.path() << ' ' << words->language;
            }
        }
    }
    EXPECT_GT(found, 0);
}

// The first and last column with ink in rows [top, bottom), ink being near-black.
std::pair<int, int> inkedColumns(const Image8& image, int top, int bottom) {
    std::pair<int, int> columns{image.width, -1};
    for (int y = top; y < bottom; ++y)
        for (int x = 0; x < image.width; ++x)
            if (image.pixels[static_cast<std::size_t>((y * image.width + x) * 3)] < 60) {
                columns.first = std::min(columns.first, x);
                columns.second = std::max(columns.second, x);
            }
    return columns;
}

// Also in windows of odd shapes.
constexpr Size oddSizes[] = {{320, 240},  {640, 400},   {500, 900},  {1280, 720},
                             {2000, 500}, {3840, 2160}, {7680, 4320}};

TEST(Text, FromRightToLeftStaysInTheMiddle) {
    for (const Texts* words : {&arabic, &hebrew, &mixed, &texts})
        for (const Size size : oddSizes)
            for (const Page& page : {instructionsPage(*words), startPage(*words, 3, 7),
                                     thanksPage(*words), idPage(*words, "P01", words->question)}) {
                const Image8 image = drawPage(page, size.width, size.height, 128).image;
                const auto [left, right] = inkedColumns(image, 0, size.height);
                ASSERT_GT(left, 0) << size.width << ' ' << page.text;
                ASSERT_LT(right, size.width - 1) << size.width << ' ' << page.text;
                EXPECT_NEAR(left, size.width - 1 - right, 0.04 * size.width)
                    << size.width << ' ' << page.text;
            }
}

TEST(Text, FromRightToLeftStaysOnItsCard) {
    for (const Texts* words : {&arabic, &hebrew, &mixed, &texts})
        for (const Size size : oddSizes) {
            const DrawnPage drawn = drawPage(questionPage(*words), size.width, size.height, 128);
            Box one = drawn.options.at(0), two = drawn.options.at(1);
            if (one.x > two.x)
                std::swap(one, two);
            const auto [left, right] = inkedColumns(drawn.image, one.y, one.y + one.height);
            EXPECT_GT(left, one.x) << size.width;
            EXPECT_LT(right, two.x + two.width) << size.width;
            // Each card holds its key, and beside it ink of its label.
            for (const Box& box : {one, two})
                for (const int half : {box.x, box.x + box.width / 2}) {
                    int inked = 0;
                    for (int x = half; x < half + box.width / 2; ++x)
                        for (int y = box.y; y < box.y + box.height; ++y)
                            inked +=
                                drawn.image
                                    .pixels[static_cast<std::size_t>((y * size.width + x) * 3)] <
                                60;
                    EXPECT_GT(inked, 10) << size.width << ' ' << words->first;
                }
            for (int x = one.x + one.width + 2; x < two.x - 2; ++x)
                for (int y = one.y; y < one.y + one.height; ++y)
                    ASSERT_EQ(
                        drawn.image.pixels[static_cast<std::size_t>((y * size.width + x) * 3)], 128)
                        << "between the cards";
        }
}

TEST(Text, LongWordsAreBroken) {
    Texts longer = texts;
    longer.start = longer.question = longer.first = std::string(150, 'w');
    for (const Size size : sizes)
        for (const Page& page : {startPage(longer, 1, 7), questionPage(longer)}) {
            const Image8 image = drawPage(page, size.width, size.height, 128).image;
            const auto [left, right] = inkedColumns(image, 0, size.height);
            EXPECT_GT(left, 0);
            EXPECT_LT(right, size.width - 1);
        }
}

TEST(Text, OfWhatIsTooLongForTheFieldTheEndIsSeen) {
    const Image8 thirty = drawPage(idPage(texts, std::string(60, 'w'), ""), 1280, 720, 128).image;
    const Image8 more = drawPage(idPage(texts, std::string(90, 'w'), ""), 1280, 720, 128).image;
    EXPECT_EQ(thirty.pixels, more.pixels);
    const Image8 other =
        drawPage(idPage(texts, std::string(89, 'w') + "i", ""), 1280, 720, 128).image;
    EXPECT_NE(more.pixels, other.pixels);
}

TEST(Text, AScreenTooSmallToReadOnIsRefused) {
    EXPECT_THAT([] { drawPage(instructionsPage(arabic), 120, 60, 128); },
                testing::ThrowsMessage<Error>(
                    testing::HasSubstr("too long for a screen of 120x60 pixels")));
    EXPECT_THAT([] { drawPage(thanksPage(texts), 40000, 100, 128); },
                testing::ThrowsMessage<Error>(testing::HasSubstr("40000 x 100")));
}

// U+0378 has never been assigned, so that no font has it.
TEST(Text, NamesCharactersThatNoFontHas) {
    EXPECT_THAT(unshowable("Plain, Ελληνικά, عربي, עברית\n\ttwo lines"), testing::IsEmpty());
    EXPECT_THAT(unshowable("a\u0378b\u0378\x07"), testing::ElementsAre("U+0007", "U+0378"));
    const auto chinese = unshowable("図");
    if (!chinese.empty()) { // where no font for it is installed
        EXPECT_THAT(chinese, testing::ElementsAre("図 (U+56F3)"));
    }
}

TEST(Text, RefusesTextsThatNoFontCanShow) {
    EXPECT_NO_THROW(checkShowable(arabic));
    for (const TextKey& key : textKeys()) {
        Texts odd = texts;
        odd.*key.text += "\u0378";
        odd.places[std::string(key.name)] = {"study.toml", 12, 9,
                                             fmt::format("texts.{}", key.name)};
        EXPECT_THAT(
            [&] { checkShowable(odd); },
            testing::ThrowsMessage<Error>(testing::HasSubstr(fmt::format(
                "study.toml:12:9: texts.{}: no installed font can show U+0378", key.name))));
    }
    Texts danish = texts;
    danish.language = "da";
    danish.table = "languages.da";
    danish.leave += "\u0378";
    danish.name = "Dansk";
    EXPECT_THAT([&] { checkShowable(danish); },
                testing::ThrowsMessage<Error>(testing::HasSubstr(
                    "languages.da.leave: no installed font can show U+0378 (the language is "
                    "\"da\"); install")));
    danish.leave.clear();
    danish.name += "\u0378";
    EXPECT_THAT([&] { checkShowable(danish); },
                testing::ThrowsMessage<Error>(testing::HasSubstr("languages.da.name: no ")));
    Texts many = texts;
    for (int i = 0; i < 12; ++i)
        many.start += static_cast<char>(1 + (i > 7 ? i + 5 : i));
    EXPECT_THAT([&] { checkShowable(many); },
                testing::ThrowsMessage<Error>(testing::HasSubstr("U+0008 and 4 more;")));
}

TEST(Text, StartPageCountsPairsInTheStudysWords) {
    EXPECT_EQ(startPage(texts, 3, 7).heading, "3 / 7");
    Texts german = texts;
    german.progress = "Von {pairs} Paaren das {pair}.";
    EXPECT_EQ(startPage(german, 3, 28).heading, "Von 28 Paaren das 3.");
}

TEST(Text, TheWarningIsABandAcrossTheTop) {
    Page page = questionPage(texts);
    page.warning = "Not suitable for data collection";
    const Image8 image = drawPage(page, 1280, 720, 128).image;
    EXPECT_LT(image.pixels[0], 20);
    EXPECT_LT(image.pixels[3 * 1279], 20);
}

} // namespace
} // namespace obscura
