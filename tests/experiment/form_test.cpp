#include "experiment/form.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace obscura {
namespace {

using Effect = Form::Effect;
using gl::Key;
using Kind = Question::Kind;

Question question(Kind kind, std::vector<std::string> options = {}) {
    Question result;
    result.name = nameOf(kind);
    result.kind = kind;
    result.options = std::move(options);
    return result;
}

void type(Form& form, const std::string& letters) {
    for (const char letter : letters)
        form.type(static_cast<unsigned char>(letter), 1);
}

std::vector<std::string> valuesOf(const Form& form) {
    std::vector<std::string> values;
    for (const FormAnswer& answer : form.answers())
        values.push_back(answer.value);
    return values;
}

TEST(FormTest, AChoiceThatStandsAloneIsAnsweredByOneKey) {
    for (const auto& [key, value] : {std::pair(Key::one, "1"), std::pair(Key::right, "2")}) {
        Form form({question(Kind::choice, {"x", "y"})}, 2);
        EXPECT_EQ(form.press(Key::nine, 1), Effect::none);
        EXPECT_EQ(form.press(key, 2.5), Effect::finished);
        EXPECT_EQ(form.answers()[0].value, value);
        EXPECT_EQ(form.answers()[0].seconds, 2.5);
    }
}

TEST(FormTest, NotSureIsAnOptionOfItsOwn) {
    Question which = question(Kind::choice, {"x", "y"});
    which.unsure = "dunno";
    Form form({which}, 2);
    EXPECT_EQ(form.press(static_cast<Key>(static_cast<int>(Key::zero) + 3), 1), Effect::finished);
    EXPECT_EQ(form.answers()[0].value, "unsure");
}

TEST(FormTest, AScaleCountsFromItsLowestNumber) {
    Question scale = question(Kind::scale, {"a", "b", "c", "d", "e", "f", "g"});
    scale.lowest = -3;
    Form form({scale}, 2);
    EXPECT_EQ(form.press(Key::one, 1), Effect::finished);
    EXPECT_EQ(form.answers()[0].value, "-3");
}

TEST(FormTest, AnAnswerAmongOthersMayBeChangedUntilThePageIsDone) {
    Form form({question(Kind::scale, {"a", "b", "c"}), question(Kind::text)}, 2);
    EXPECT_EQ(form.press(Key::one, 1), Effect::changed);
    EXPECT_EQ(form.press(Key::two, 2), Effect::changed);
    EXPECT_EQ(form.press(Key::enter, 2), Effect::changed) << "goes to the next";
    EXPECT_EQ(form.press(Key::enter, 3), Effect::none) << "nothing typed yet";
    type(form, "x y");
    EXPECT_EQ(form.press(Key::space, 4), Effect::none) << "a space in what is typed";
    EXPECT_EQ(form.press(Key::enter, 5), Effect::finished);
    EXPECT_THAT(valuesOf(form), testing::ElementsAre("2", "x y"));
}

TEST(FormTest, ARankingTakesEachImageOnceAndBackspaceTakesTheLastBack) {
    Form form({question(Kind::rank)}, 3);
    EXPECT_EQ(form.press(Key::two, 1), Effect::changed);
    EXPECT_EQ(form.press(Key::two, 1), Effect::none);
    form.press(Key::one, 1);
    form.press(Key::backspace, 1);
    EXPECT_EQ(form.press(Key::space, 2), Effect::none) << "not all are ranked";
    form.click(3, 0.5, 2);
    form.click(1, 0.5, 3);
    EXPECT_EQ(form.press(Key::space, 4), Effect::finished);
    EXPECT_EQ(form.answers()[0].value, "2>3>1");
}

TEST(FormTest, ASliderHasNoValueUntilItIsMoved) {
    Form form({question(Kind::slider)}, 2);
    EXPECT_FALSE(form.complete());
    EXPECT_EQ(form.press(Key::space, 1), Effect::none);
    form.click(1, 0.25, 2);
    form.press(Key::right, 2);
    EXPECT_EQ(form.press(Key::space, 3), Effect::finished);
    EXPECT_EQ(form.answers()[0].value, "26");
}

TEST(FormTest, ANumberLiesInItsRange) {
    Question age = question(Kind::number);
    age.least = 18, age.most = 99;
    Form form({age}, 2);
    for (const char* wrong : {"17", "9x", "1e300", "nan", "-20"}) {
        type(form, wrong);
        EXPECT_EQ(form.press(Key::enter, 1), Effect::none) << wrong;
        while (form.press(Key::backspace, 1) == Effect::changed) {
        }
    }
    type(form, "33");
    EXPECT_EQ(form.press(Key::enter, 1), Effect::finished);
}

TEST(FormTest, WhatIsOptionalMayBeLeftOpenButNotHalfAnswered) {
    Question age = question(Kind::number);
    age.least = 18, age.most = 99, age.optional = true;
    Form form({age}, 2);
    EXPECT_TRUE(form.complete());
    type(form, "1");
    EXPECT_FALSE(form.complete());
}

TEST(FormTest, BackspaceTakesAWholeCharacter) {
    Form form({question(Kind::text)}, 2);
    form.type('a', 1), form.type(0x56F3, 1);
    EXPECT_EQ(form.answers()[0].value, "a図");
    form.press(Key::backspace, 2);
    EXPECT_EQ(form.answers()[0].value, "a");
    EXPECT_EQ(form.type('\n', 3), Effect::none) << "a table's line stays one";
}

TEST(FormTest, ClicksGoToTheirQuestionAndTheButtonEnds) {
    Form form({question(Kind::scale, {"a", "b"}), question(Kind::slider)}, 2);
    EXPECT_EQ(form.click(4, 0.5, 1), Effect::none) << "the button, while nothing is answered";
    EXPECT_EQ(form.click(3, 1, 1), Effect::changed);
    EXPECT_EQ(form.focus(), 1);
    EXPECT_EQ(form.click(2, 0.5, 1), Effect::changed);
    EXPECT_EQ(form.click(4, 0.5, 2), Effect::finished);
    EXPECT_THAT(valuesOf(form), testing::ElementsAre("2", "100"));
}

// Others than the study's keys do not answer, not even those that would without them.
TEST(FormTest, TheStudysKeysAnswerAQuestionOfTwo) {
    Keys keys;
    keys.first = {'F'}, keys.second = {'J'}, keys.go = {'G'};
    Question which = question(Kind::choice, {"x", "y"});
    which.unsure = "dunno";
    Form form({which}, 2, keys);
    for (const Key key : {Key::one, Key::two, Key::left, Key::right, Key::space})
        EXPECT_EQ(form.press(key, 1), Effect::none) << static_cast<int>(key);
    EXPECT_EQ(form.press(static_cast<Key>('J'), 1), Effect::finished);
    EXPECT_EQ(form.answers()[0].value, "2");

    Form several({question(Kind::scale, {"a", "b", "c"}), question(Kind::text)}, 2, keys);
    EXPECT_EQ(several.press(Key::one, 1), Effect::changed) << "a question of three has digits";
    several.press(Key::down, 1);
    type(several, "fog");
    EXPECT_EQ(several.press(static_cast<Key>('G'), 1), Effect::none) << "while a text is typed";
    several.press(Key::up, 1);
    EXPECT_EQ(several.press(Key::space, 1), Effect::none);
    EXPECT_EQ(several.press(static_cast<Key>('G'), 1), Effect::finished);
}

TEST(FormTest, AnOptionalChoiceCanBeTakenBack) {
    Question which = question(Kind::choice, {"x", "y"});
    which.optional = true;
    Form form({which, question(Kind::text)}, 2);
    form.press(Key::one, 1);
    EXPECT_EQ(form.press(Key::backspace, 1), Effect::changed);
    EXPECT_EQ(form.answers()[0].value, "");
}

} // namespace
} // namespace obscura
