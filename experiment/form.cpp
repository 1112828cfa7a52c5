#include "experiment/form.h"

#include "base/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace obscura {

namespace {

constexpr int sliderSteps = 100;
constexpr std::size_t longestText = 200; // bytes of UTF-8

bool hasOptions(const Question& question) {
    return question.kind == Question::Kind::choice || question.kind == Question::Kind::scale;
}

bool isTyped(const Question& question) {
    return question.kind == Question::Kind::number || question.kind == Question::Kind::text;
}

void append(std::string& text, std::uint32_t symbol) { // UTF-8
    const auto byte = [&](std::uint32_t value) { text += static_cast<char>(value); };
    if (symbol < 0x80)
        return byte(symbol);
    if (symbol < 0x800)
        return byte(0xC0 | symbol >> 6), byte(0x80 | (symbol & 0x3F));
    if (symbol < 0x10000)
        byte(0xE0 | symbol >> 12);
    else
        byte(0xF0 | symbol >> 18), byte(0x80 | (symbol >> 12 & 0x3F));
    byte(0x80 | (symbol >> 6 & 0x3F)), byte(0x80 | (symbol & 0x3F));
}

void removeLast(std::string& text) {
    while (!text.empty() && (text.back() & 0xC0) == 0x80)
        text.pop_back();
    if (!text.empty())
        text.pop_back();
}

} // namespace

int digitOf(gl::Key key) {
    const int code = static_cast<int>(key);
    for (const gl::Key zero : {gl::Key::zero, gl::Key::keypadZero})
        if (const int digit = code - static_cast<int>(zero); digit >= 0 && digit <= 9)
            return digit;
    return -1;
}

bool isOfTwo(const Question& question) {
    return hasOptions(question) && question.options.size() == 2;
}

Form::Form(const std::vector<Question>& questions, int images, Keys keys)
    : questions_(questions), entries_(questions.size()), images_(images), keys_(std::move(keys)),
      alone_(questions.size() == 1 && hasOptions(questions[0])) {}

int Form::optionsOf(const Question& question) const {
    if (question.kind == Question::Kind::rank)
        return images_;
    return hasOptions(question)
               ? static_cast<int>(question.options.size()) + !question.unsure.empty()
               : 1;
}

bool Form::typing() const { return isTyped(question()); }

Form::Effect Form::press(gl::Key key, double seconds) { return noted(pressed(key, seconds)); }

Form::Effect Form::type(std::uint32_t symbol, double seconds) {
    if (!typing() || symbol < 32 || symbol == 127 || entry().typed.size() >= longestText)
        return Effect::none;
    append(entry().typed, symbol);
    entry().seconds = seconds;
    return noted(Effect::changed);
}

Form::Effect Form::click(int target, double share, double seconds) {
    return noted(clicked(target, share, seconds));
}

Form::Effect Form::noted(Effect effect) {
    changes_ += effect == Effect::changed;
    return effect;
}

Form::Effect Form::pressed(gl::Key key, double seconds) {
    const bool enter = key == gl::Key::enter || key == gl::Key::keypadEnter;
    if (enter && !alone_)
        return next();
    if (keys_.isGo(static_cast<int>(key)) && !alone_ && !typing())
        return complete() ? Effect::finished : Effect::none;
    if (!alone_ && (key == gl::Key::tab || key == gl::Key::down))
        return move(1);
    if (!alone_ && key == gl::Key::up)
        return move(-1);
    if (key == gl::Key::backspace && question().kind == Question::Kind::rank &&
        !entry().ranks.empty())
        return entry().ranks.pop_back(), Effect::changed;
    if (key == gl::Key::backspace && typing() && !entry().typed.empty())
        return removeLast(entry().typed), entry().seconds = seconds, Effect::changed;
    if (question().kind == Question::Kind::slider)
        return pressSlider(key, seconds);
    if (typing()) // digits arrive as text
        return Effect::none;
    if (key == gl::Key::backspace && question().optional && entry().option > 0)
        return entry().option = 0, Effect::changed;
    if (isOfTwo(question()))
        if (const int option = keys_.optionOf(static_cast<int>(key)))
            return choose(option, seconds);
    const int digit = digitOf(key);
    if (isOfTwo(question()) && digit < 3) // others than the study's keys
        return Effect::none;
    return choose(digit == 0 ? 10 : digit, seconds);
}

Form::Effect Form::pressSlider(gl::Key key, double seconds) {
    const double least = question().least, most = question().most;
    const double step = (most - least) / sliderSteps;
    const double from = entry().value.value_or((least + most) / 2);
    if (key == gl::Key::left || key == gl::Key::right)
        return slide(from + (key == gl::Key::left ? -step : step), seconds);
    if (const int digit = digitOf(key); digit >= 0) // tenths of the range, 0 to 9
        return slide(least + digit * (most - least) / 10, seconds);
    return Effect::none;
}

Form::Effect Form::clicked(int target, double share, double seconds) {
    for (std::size_t i = 0; i < questions_.size(); ++i) {
        const int own = optionsOf(questions_[i]);
        if (target <= own) {
            focus_ = static_cast<int>(i);
            if (question().kind == Question::Kind::slider)
                return slide(question().least + share * (question().most - question().least),
                             seconds);
            return typing() ? Effect::changed : choose(target, seconds);
        }
        target -= own;
    }
    return !alone_ && target == 1 && complete() ? Effect::finished : Effect::none;
}

Form::Effect Form::choose(int option, double seconds) {
    if (option < 1 || option > optionsOf(question()))
        return Effect::none;
    std::vector<int>& ranks = entry().ranks;
    if (question().kind == Question::Kind::rank) {
        if (std::find(ranks.begin(), ranks.end(), option) != ranks.end())
            return Effect::none;
        ranks.push_back(option);
    } else {
        entry().option = option;
    }
    entry().seconds = seconds;
    return alone_ ? Effect::finished : Effect::changed;
}

Form::Effect Form::slide(double value, double seconds) {
    const double least = question().least, most = question().most;
    const double step = (most - least) / sliderSteps;
    entry().value = least + step * std::round((std::clamp(value, least, most) - least) / step);
    entry().seconds = seconds;
    return Effect::changed;
}

Form::Effect Form::move(int step) {
    const int last = static_cast<int>(questions_.size()) - 1;
    const int before = focus_;
    focus_ = std::clamp(focus_ + step, 0, last);
    return focus_ == before ? Effect::none : Effect::changed;
}

Form::Effect Form::next() {
    if (focus_ + 1 < static_cast<int>(questions_.size()))
        return move(1);
    return complete() ? Effect::finished : Effect::none;
}

bool Form::answered(std::size_t index) const {
    const Question& asked = questions_[index];
    const Entry& given = entries_[index];
    double number = 0;
    switch (asked.kind) {
    case Question::Kind::choice:
    case Question::Kind::scale:
        return given.option > 0;
    case Question::Kind::slider:
        return given.value.has_value();
    case Question::Kind::rank:
        return static_cast<int>(given.ranks.size()) == images_;
    case Question::Kind::number:
        return readCell(given.typed, number) && number >= asked.least && number <= asked.most;
    case Question::Kind::text:
        break;
    }
    return !given.typed.empty();
}

// A question that may be left open must not be half answered.
bool Form::complete() const {
    for (std::size_t i = 0; i < questions_.size(); ++i) {
        const bool empty = entries_[i].typed.empty() && entries_[i].ranks.empty();
        if (!answered(i) && !(questions_[i].optional && empty))
            return false;
    }
    return true;
}

std::string Form::valueOf(std::size_t index) const {
    const Question& asked = questions_[index];
    const Entry& given = entries_[index];
    if (!answered(index))
        return {};
    switch (asked.kind) {
    case Question::Kind::choice:
        return given.option > static_cast<int>(asked.options.size())
                   ? "unsure"
                   : fmt::format("{}", given.option);
    case Question::Kind::scale:
        return fmt::format("{}", asked.lowest + given.option - 1);
    case Question::Kind::slider:
        return fmt::format("{:g}", *given.value);
    case Question::Kind::rank:
        return fmt::format("{}", fmt::join(given.ranks, ">"));
    case Question::Kind::number:
    case Question::Kind::text:
        break;
    }
    return given.typed;
}

std::vector<FormAnswer> Form::answers() const {
    std::vector<FormAnswer> result;
    for (std::size_t i = 0; i < questions_.size(); ++i)
        result.push_back({questions_[i].name, valueOf(i), entries_[i].seconds});
    return result;
}

} // namespace obscura
