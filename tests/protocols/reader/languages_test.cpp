#include "protocols/reader/design.h"
#include "protocols/reader/languages.h"
#include "tests/error_of.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace obscura {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

// The words of a study whose question has a text of its own, "sure".
const std::string words = R"(instructions = "Look."
question = "Which?"
first = "first"
second = "second"
sure = "sure"
thanks = "Thanks"
)";

// A study with these tables of texts, which begin in line 19.
std::string study(const std::string& texts) {
    return R"(name = "small"
seed = 7
[scenes.box]
builtin = "sculpture"
camera = { position = [0, 1, 3], target = [0, 0.5, 0] }
radius = 0.2
[levels.day]
ambient = [1, 1, 1]
[techniques.none]
technique = "none"
[[conditions]]
id = "one"
scene = "box"
level = "day"
roles = { a = "none" }
[trial]
order = ["a"]
phases = [ { name = "it", questions = [ { name = "q", text = "question", options = ["first", "second"], unsure = "sure" } ] }, { name = "look", image = 1 } ]
)" + texts;
}

Protocol parsed(const std::string& texts) { return parseProtocol(study(texts), "small.toml"); }

std::string errorOf(const std::string& texts) {
    return test::errorOf([&] { parsed(texts); });
}

const std::string english = "[texts]\nlanguage = \"en\"\n" + words;

// Every text of the program's own, in a language that it does not know.
std::string latin() {
    std::string all = "name = \"Latina\"\n" + words;
    for (const TextKey& key : textKeys())
        if (!(Texts().*key.text).empty())
            all += fmt::format("{} = \"Lorem {}\"\n", key.name, key.name);
    return all;
}

// From RFC 5646, appendix A, and its section 2.1.
TEST(Languages, TagsAreThoseOfBcp47) {
    for (const char* tag : {"de",
                            "fr",
                            "zh-Hant",
                            "sr-Latn",
                            "zh-cmn-Hans-CN",
                            "cmn-Hans-CN",
                            "zh-yue-HK",
                            "yue-HK",
                            "zh-Hans-CN",
                            "sr-Latn-RS",
                            "sl-rozaj",
                            "sl-rozaj-biske",
                            "sl-nedis",
                            "de-CH-1901",
                            "sl-IT-nedis",
                            "hy-Latn-IT-arevela",
                            "de-DE",
                            "en-US",
                            "es-419",
                            "de-CH-x-phonebk",
                            "az-Arab-x-AZE-derbend",
                            "x-whatever",
                            "qaa-Qaaa-QM-x-southern",
                            "de-Qaaa",
                            "en-US-u-islamcal",
                            "zh-CN-a-myext-x-private",
                            "en-a-myext-b-another",
                            "AR",
                            "zh-HANS"})
        EXPECT_TRUE(isLanguageTag(tag)) << tag;
    for (const char* tag :
         {"", "a", "a-DE", "de-419-DE", "en_US", "english-", "-en", "en--US", "zh Hans",
          "toolonglang", "en-", "العربية", "1en", "x", "en-x", "../de", "de.toml"})
        EXPECT_FALSE(isLanguageTag(tag)) << tag;
}

TEST(Languages, AStudyOfOneNeedNotSayWhich) {
    const Protocol protocol = parsed("[texts]\n" + words);
    EXPECT_EQ(protocol.texts.language, "");
    EXPECT_EQ(protocol.texts.done, "Done");
    EXPECT_EQ(protocol.languages(), std::vector<const Texts*>{&protocol.texts});
}

// "language" and "name" may be texts that its phases name.
TEST(Languages, AStudyOfOneMayUseTheirKeysForItsTexts) {
    std::string text = study("[texts]\nname = \"What is your name?\"\n" + words);
    text.replace(text.find("\"question\""), 10, "\"name\"");
    const Protocol protocol = parseProtocol(text, "small.toml");
    EXPECT_EQ(protocol.texts.at("name"), "What is your name?");
    EXPECT_EQ(protocol.texts.name, "");
    text += "language = \"en\"\n[languages.de]\n" + words;
    EXPECT_THAT(test::errorOf([&] { parseProtocol(text, "small.toml"); }),
                StartsWith("small.toml:20:1: texts.name: a phase names the text \"name\""));
}

TEST(Languages, TheProgramHasTranslationsOfItsOwnTexts) {
    const Protocol protocol = parsed(english + "[languages.de]\n" + words + "done = \"Genug\"\n" +
                                     "[languages.ar-EG]\n" + words);
    ASSERT_EQ(protocol.translations.size(), 2u);
    EXPECT_EQ(protocol.texts.name, "English");
    const Texts &german = protocol.translations[0], &arabic = protocol.translations[1];
    EXPECT_EQ(german.language, "de");
    EXPECT_EQ(german.name, "Deutsch");
    EXPECT_EQ(german.space, "Leertaste");
    EXPECT_EQ(german.done, "Genug") << "the protocol's before the program's";
    EXPECT_EQ(german.at("sure"), "sure");
    EXPECT_EQ(arabic.language, "ar-EG");
    EXPECT_EQ(arabic.name, "العربية");
    EXPECT_EQ(parsed("[texts]\nlanguage = \"de\"\n" + words).texts.space, "Leertaste");
    EXPECT_EQ(parsed("[texts]\nlanguage = \"EN-gb\"\n" + words).texts.space, "Space");
}

// Each file has all texts of the program's own but those that every study writes itself, and none
// besides.
TEST(Languages, TheProgramsTranslationsAreWhole) {
    for (const char* tag : {"ar", "de", "zh-Hans"}) {
        const Protocol protocol = parsed(english + fmt::format("[languages.{}]\n", tag) + words);
        const Texts& texts = protocol.translations.at(0);
        for (const TextKey& key : textKeys()) {
            const std::string usual = Texts().*key.text;
            EXPECT_TRUE(usual.empty() || texts.*key.text != usual || usual == "Enter")
                << tag << ": " << key.name;
        }
        for (const char* number : {"{pair}", "{pairs}"}) {
            EXPECT_THAT(texts.progress, HasSubstr(number)) << tag;
            EXPECT_THAT(texts.resume, HasSubstr(number)) << tag;
        }
        const std::string file = fmt::format(OBSCURA_SOURCE "/protocols/languages/{}.toml", tag);
        for (const auto& entry : toml::parse_file(file)) {
            const std::string_view key = entry.first.str();
            EXPECT_TRUE(key == "name" || std::any_of(textKeys().begin(), textKeys().end(),
                                                     [&](const TextKey& known) {
                                                         return known.name == key &&
                                                                !(Texts().*known.text).empty();
                                                     }))
                << file << ": " << key;
        }
    }
}

// Which languages and texts there are is no part of the design; how a study of one was written has
// not changed.
TEST(Languages, AreNoPartOfTheDesign) {
    const Protocol before = parsed("[texts]\n" + words),
                   now = parsed(english + "[languages.la]\n" + latin());
    EXPECT_EQ(designOf(now), designOf(before));
    EXPECT_NE(partsOf(now).texts, partsOf(before).texts);
    EXPECT_NE(partsOf(parsed(english + "[languages.la]\n" + latin() + "#")).texts,
              partsOf(before).texts);
    EXPECT_THAT(partsOf(before).texts, testing::Not(HasSubstr("language")));
}

TEST(Languages, MistakesNameTheirPlace) {
    const std::string german = "[languages.de]\n" + words;
    const std::pair<std::string, std::string> mistakes[] = {
        {"[texts]\n" + words + german,
         "small.toml:19:1: texts.language: expected a language tag, such as \"en\", for there are "
         "several languages, found nothing; add \"language\" here"},
        {"[texts]\nlanguage = \"en_GB\"\n" + words + german,
         "small.toml:20:12: texts.language: expected a language tag (BCP 47), such as \"en\", "
         "\"ar\" or \"zh-Hans\", found \"en_GB\"; did you mean \"en-GB\"?"},
        {"[texts]\nlanguage = 7\n" + words,
         "small.toml:20:12: texts.language: expected a text in quotes, found 7"},
        {"[texts]\nlanguage = \"English!\"\n" + words,
         "small.toml:20:12: texts.language: expected a language tag (BCP 47), such as \"en\", "
         "\"ar\" or \"zh-Hans\", found \"English!\""},
        {english + "[languages.zh_Hans]\n" + words,
         "small.toml:27:1: languages.zh_Hans: expected a language tag (BCP 47), such as \"en\", "
         "\"ar\" or \"zh-Hans\", found \"zh_Hans\"; did you mean \"zh-Hans\"?"},
        {english + "[languages.EN]\n" + words,
         "small.toml:27:1: languages.EN: expected another language, found \"EN\" again, which "
         "[texts] has"},
        {english + german + "[languages.DE]\n" + words,
         "small.toml:34:1: languages.DE: expected another language, found \"DE\" again, which "
         "[languages.de] has"},
        {english + german + "[languages.de-AT]\n" + words,
         "small.toml:34:1: languages.de-AT.name: expected another name, so that people can choose, "
         "found \"Deutsch\" again, which [languages.de] has"},
        {english + "[languages]\nde = \"Deutsch\"\n",
         "small.toml:28:6: languages.de: expected another language, [languages.TAG], found "
         "\"Deutsch\""},
        {english + "[languages.la]\n" + words,
         "small.toml:27:1: languages.la.name: expected the language's own name, such as "
         "\"English\", for there are several languages, found nothing; add \"name\" here"},
        {english + german + "thansk = \"Danke\"\n",
         "small.toml:34:1: languages.de.thansk: unknown key; did you mean \"thanks\"?"},
        {english + german + "progress = \"{paar}\"\n",
         "small.toml:34:12: languages.de.progress: expected no braces but those of {pair}"},
        {english + german + "done = \"\"\n",
         "small.toml:34:8: languages.de.done: expected a text that is not empty"},
    };
    for (const auto& [texts, message] : mistakes)
        EXPECT_THAT(errorOf(texts), StartsWith(message));
}

// All of it at once, and nothing that is there.
TEST(Languages, WhatIsMissingIsListed) {
    std::string some = words;
    some.erase(some.find("sure = "), 14);
    some.erase(some.find("thanks = "), 18);
    EXPECT_THAT(errorOf(english + "[languages.de]\n" + some),
                StartsWith("small.toml:27:1: languages.de: expected all that participants read in "
                           "\"de\", found nothing for \"sure\", \"thanks\"; add"));
    std::string most = latin();
    most.erase(most.find("done = "), std::string("done = \"Lorem done\"\n").size());
    most.erase(most.find("unfocused = "), std::string("unfocused = \"Lorem unfocused\"\n").size());
    EXPECT_EQ(parsed(english + "[languages.la]\n" + latin()).translations.at(0).done, "Lorem done");
    EXPECT_THAT(errorOf(english + "[languages.la]\n" + most),
                HasSubstr("in \"la\", found nothing for \"done\", \"unfocused\"; add"));
    EXPECT_THAT(
        errorOf("[texts]\nlanguage = \"la\"\n" + most),
        StartsWith("small.toml:19:1: texts: expected all that participants read in \"la\""));
}

} // namespace
} // namespace obscura
