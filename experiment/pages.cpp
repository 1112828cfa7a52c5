#include "experiment/pages.h"

#include "base/error.h"
#include "experiment/script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <vector>

namespace obscura {

namespace {

std::string replaced(std::string text, std::string_view mark, int number) {
    for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos;)
        text.replace(at, mark.size(), fmt::format("{}", number));
    return text;
}

// How the language is written. Of whatever it has words for, the instructions have most.
Page blank(const Texts& texts) {
    Page page;
    page.language = texts.language;
    page.rightToLeft = runsFromRightToLeft(texts.instructions);
    return page;
}

// A number that stays whole, sign and all, among words that run from right to left: an isolate.
std::string number(double value) {
    return fmt::format("\u2066{}{:g}\u2069", value < 0 ? "\u2212" : "", std::abs(value));
}

// After a question, the numbers that it takes; in the brackets of its script.
std::string rangeOf(const Texts& texts, const Question& question) {
    const std::string range = fmt::format("{}{}{}", number(question.least),
                                          question.least < 0 ? " – " : "–", number(question.most));
    const bool wide = texts.language.starts_with("zh") || texts.language.starts_with("ja");
    return wide ? fmt::format("（{}）", range) : fmt::format(" ({})", range);
}

} // namespace

Page languagePage(const Protocol& protocol, std::size_t chosen) {
    constexpr std::size_t digits = 10;
    Page page;
    page.listed = true;
    for (const Texts* texts : protocol.languages()) {
        const std::size_t at = page.options.size();
        page.options.push_back({at < digits ? fmt::format("{}", (at + 1) % digits) : "",
                                texts->name, at == chosen, texts->language});
    }
    return page;
}

Page loadingPage(const Texts& texts, int loaded, int images) {
    Page page = blank(texts);
    page.text = texts.loading;
    page.note = fmt::format("{} / {}", loaded, images);
    return page;
}

Page idPage(const Texts& texts, const std::string& typed, const std::string& objection,
            const StartFacts& start) {
    Page page = blank(texts);
    page.heading = start.title;
    page.facts = start.facts;
    if (start.monitors)
        page.options = {{texts.enter, ""}, {"Tab", "Next monitor"}};
    page.text = texts.id;
    page.field = Page::Field{typed};
    page.note = objection.empty() ? texts.idNote : objection;
    return page;
}

Page resumePage(const Texts& texts, int trial, int trials) {
    Page page = blank(texts);
    page.heading = replaced(replaced(texts.resume, "{pair}", trial), "{pairs}", trials);
    page.options = {{"1", texts.stay}, {"2", texts.otherId}};
    return page;
}

Page instructionsPage(const Texts& texts) {
    Page page = blank(texts);
    page.text = texts.instructions;
    page.options = {{texts.space, ""}};
    return page;
}

Page textPage(const Texts& texts, const Phase& phase, int pair, int pairs) {
    Page page = blank(texts);
    if (phase.progress)
        page.heading = replaced(replaced(texts.progress, "{pair}", pair), "{pairs}", pairs);
    page.text = texts.at(phase.text);
    if (phase.key)
        page.options = {{texts.space, ""}};
    return page;
}

namespace {

std::string wordsOf(const Texts& texts, const std::string& key) {
    return key.empty() ? "" : texts.at(key);
}

std::string capOf(const Form& form, const Question& question, int option) {
    if (isOfTwo(question) && option <= 2)
        return obscura::capOf(option == 1 ? form.keys().first.front() : form.keys().second.front());
    return fmt::format("{}", option % 10);
}

// A key for each option, from 1; a scale's are those of its numbers where digits can say them.
std::vector<Page::Option> optionsOf(const Texts& texts, const Form& form, std::size_t index) {
    const Question& question = form.questions()[index];
    const Form::Entry& entry = form.entries()[index];
    std::vector<Page::Option> options;
    for (int i = 1; i <= form.optionsOf(question); ++i) {
        Page::Option option{capOf(form, question, i), "", entry.option == i};
        const auto rank = std::find(entry.ranks.begin(), entry.ranks.end(), i);
        if (question.kind == Question::Kind::rank) {
            option.chosen = rank != entry.ranks.end();
            option.label = option.chosen ? fmt::format("{}.", rank - entry.ranks.begin() + 1)
                                         : "\u2012\u2008"; // a dash and a space, as wide as "1."
        } else {
            const auto at = static_cast<std::size_t>(i - 1);
            option.label =
                texts.at(at < question.options.size() ? question.options[at] : question.unsure);
        }
        options.push_back(std::move(option));
    }
    return options;
}

bool isOfImages(const Question& question) {
    return question.beside || question.kind == Question::Kind::rank;
}

Page::Part partOf(const Texts& texts, const Form& form, std::size_t index) {
    const Question& question = form.questions()[index];
    const Form::Entry& entry = form.entries()[index];
    Page::Part part;
    part.label = wordsOf(texts, question.text);
    part.focus = form.focus() == static_cast<int>(index);
    switch (question.kind) {
    case Question::Kind::number: // says what it takes, for Enter does nothing with anything else
        part.label += rangeOf(texts, question);
        [[fallthrough]];
    case Question::Kind::text:
        part.field = Page::Field{entry.typed, part.focus};
        break;
    case Question::Kind::slider:
        part.slider =
            Page::Slider{{}, wordsOf(texts, question.low), wordsOf(texts, question.high), {}};
        if (entry.value) {
            part.slider->share = (*entry.value - question.least) / (question.most - question.least);
            part.slider->value = number(*entry.value);
        }
        break;
    case Question::Kind::choice:
    case Question::Kind::scale:
    case Question::Kind::rank:
        part.options = optionsOf(texts, form, index);
        part.ofImages = isOfImages(question);
    }
    return part;
}

} // namespace

Page::Pictures roomFor(const Phase& phase, int width, int height) {
    Page::Pictures pictures{static_cast<int>(phase.images.size()), width, height};
    const bool meant =
        std::any_of(phase.questions.begin(), phase.questions.end(), [](const Question& question) {
            return question.images || question.kind == Question::Kind::rank;
        });
    if (meant && phase.images.size() > 1)
        for (const std::string& image : phase.images)
            pictures.names.push_back(image.find_first_not_of("0123456789") == image.npos ? image
                                                                                         : "");
    return pictures;
}

Page formPage(const Texts& texts, const Form& form, const Page::Pictures& pictures,
              const std::string& text) {
    Page page = blank(texts);
    page.pictures = pictures;
    page.text = wordsOf(texts, text);
    if (form.alone() && text.empty()) {
        page.heading = wordsOf(texts, form.questions().front().text);
        page.options = optionsOf(texts, form, 0);
        page.ofImages = isOfImages(form.questions().front());
        return page;
    }
    for (std::size_t i = 0; i < form.questions().size(); ++i)
        page.parts.push_back(partOf(texts, form, i));
    if (form.alone()) // below what it is about; ended by the answer
        return page;
    if (page.parts.size() > 1)
        page.note = texts.between;
    page.options = {{texts.enter, texts.done}};
    return page;
}

Page restPage(const Texts& texts) {
    Page page = blank(texts);
    page.text = texts.rest;
    page.options = {{texts.space, ""}};
    return page;
}

Page leavePage(const Texts& texts) {
    Page page = blank(texts);
    page.heading = texts.leave;
    page.text = texts.leaveNote;
    page.options = {{"1", texts.stay}, {"2", texts.end}};
    return page;
}

Page thanksPage(const Texts& texts) {
    Page page = blank(texts);
    page.text = texts.thanks;
    page.note = texts.anyKey;
    return page;
}

Page declinedPage(const Texts& texts) {
    Page page = blank(texts);
    page.text = texts.declined;
    page.note = texts.anyKey;
    return page;
}

Page unfocused(Page page, const Texts& texts) {
    page.warning += (page.warning.empty() ? "" : "\n") + texts.unfocused;
    return page;
}

void checkShowable(const Texts& texts) {
    constexpr std::size_t mostNamed = 8;
    std::map<std::string, std::string, std::less<>> all = texts.own;
    for (const TextKey& key : textKeys())
        all[std::string(key.name)] = texts.*key.text;
    all.emplace("name", texts.name); // unless it is a text of the trial's
    for (const auto& [key, text] : all) {
        const std::vector<std::string> missing = unshowable(text);
        if (missing.empty())
            continue;
        std::string names;
        for (std::size_t i = 0; i < std::min(missing.size(), mostNamed); ++i)
            names += (i == 0 ? "" : ", ") + missing[i];
        if (missing.size() > mostNamed)
            names += fmt::format(" and {} more", missing.size() - mostNamed);
        const auto place = texts.places.find(key);
        throw Error(
            place == texts.places.end() ? Place{"", 0, 0, fmt::format("{}.{}", texts.table, key)}
                                        : place->second,
            fmt::format("no installed font can show {}{}; install one that can (such as the "
                        "packages fonts-noto-core and fonts-noto-cjk), or write it "
                        "otherwise",
                        names,
                        texts.language.empty()
                            ? ""
                            : fmt::format(" (the language is \"{}\")", texts.language)));
    }
}

} // namespace obscura
