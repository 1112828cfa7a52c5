#include "protocols/reader/languages.h"

#include "base/files.h"
#include "base/shipped.h"
#include "protocols/reader/study_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <regex>
#include <vector>

namespace obscura {

namespace {

// Braces around anything but the name of a number are a mistake in spelling.
void checkProgress(const std::string& text, const Place& place) {
    static const std::regex progress(R"(\{pairs?\})");
    if (std::regex_replace(text, progress, "").find_first_of("{}") != std::string::npos)
        throw Error(place, fmt::format("expected no braces but those of {{pair}} and {{pairs}}, "
                                       "found \"{}\"",
                                       text));
}

bool isEnglish(std::string_view tag) {
    return tag.empty() || sameLanguage(tag.substr(0, tag.find('-')), "en");
}

void checkTag(const std::string& tag, const Place& place) {
    std::string hyphens = tag;
    std::replace(hyphens.begin(), hyphens.end(), '_', '-');
    if (!isLanguageTag(tag))
        throw Error(
            place,
            fmt::format(
                "expected a language tag (BCP 47), such as \"en\", \"ar\" or "
                "\"zh-Hans\", found \"{}\"{}",
                tag, isLanguageTag(hyphens) ? fmt::format("; did you mean \"{}\"?", hyphens) : ""));
}

// The file with the program's own texts in a language, or in that of which it is a kind: "de" for
// "de-AT". "" where the program has none.
std::string ownTexts(std::string tag) {
    for (; !tag.empty(); tag.resize(tag.find_last_of('-') == tag.npos ? 0 : tag.find_last_of('-')))
        for (const auto& entry :
             std::filesystem::directory_iterator(shipped("protocols/languages")))
            if (sameLanguage(entry.path().stem().string(), tag))
                return entry.path().string();
    return "";
}

// The table of a language, and below it what the program has of that language itself.
class TextTable {
  public:
    explicit TextTable(TomlTable table) : table_(std::move(table)) {}
    TextTable(const TextTable&) = delete; // program_ reads toml_
    TextTable& operator=(const TextTable&) = delete;

    void setLanguage(const std::string& tag) {
        const std::string file = ownTexts(tag);
        if (file.empty())
            return;
        toml_ = parseToml(readFile(file), file);
        program_.emplace(toml_, file, "");
    }

    TomlTable& own() { return table_; }
    bool has(std::string_view key) { return table_.has(key) || (program_ && program_->has(key)); }
    // As the protocol has it, or else the program.
    std::string text(std::string_view key) { return from(key).text(key); }
    Place placeOf(std::string_view key) {
        TomlTable& table = from(key);
        return table.placeOf(*table.node(key), table.pathOf(key));
    }

  private:
    TomlTable& from(std::string_view key) {
        return !table_.has(key) && program_ && program_->has(key) ? *program_ : table_;
    }

    TomlTable table_;
    toml::table toml_;
    std::optional<TomlTable> program_;
};

// Whether the key says something of the language. In a study of one it may be a text that a phase
// names, as any other.
bool isFree(const TomlTable& table, std::string_view key, const std::set<std::string>& named,
            bool several) {
    if (several && named.contains(std::string(key)))
        throw Error(
            table.placeOf(key),
            fmt::format("a phase names the text \"{}\", but where there are several "
                        "languages, \"language\" and \"name\" are no texts; give it another key",
                        key));
    return !named.contains(std::string(key));
}

Place placeOfName(TomlTable& table) {
    if (const toml::node* name = table.node("name"))
        return table.placeOf(*name, table.pathOf("name"));
    Place place = table.place();
    place.key = table.pathOf("name");
    return place;
}

// Which language it is, unless `texts` knows already, and what those call it who speak it.
void parseLanguage(TextTable& words, const std::set<std::string>& named, bool several,
                   Texts& texts) {
    TomlTable& table = words.own();
    const auto read = [&](const char* key, std::string& text, std::string_view expected) {
        if (!isFree(table, key, named, several) || !(several || words.has(key)))
            return;
        if (!words.has(key)) {
            Place place = table.place();
            place.key = table.pathOf(key);
            throw Error(place, fmt::format("expected {}, for there are several languages, found "
                                           "nothing; add \"{}\" here",
                                           expected, key));
        }
        text = words.text(key);
        texts.places[key] = words.placeOf(key);
    };
    if (texts.language.empty()) {
        read("language", texts.language, "a language tag, such as \"en\"");
        if (!texts.language.empty())
            checkTag(texts.language, texts.places["language"]);
    }
    words.setLanguage(texts.language);
    read("name", texts.name, "the language's own name, such as \"English\"");
}

bool mayLack(const Texts& texts, const TextKey& key, const std::set<std::string>& named) {
    const bool unused = !key.compulsory && !named.contains(std::string(key.name));
    const bool isEmpty = (Texts().*key.text).empty();
    return isEmpty ? unused : isEnglish(texts.language);
}

// A participant would be startled by an English sentence among others: all that is missing is told
// at once.
void checkComplete(TextTable& words, const Texts& texts, const std::set<std::string>& named) {
    std::set<std::string> wanted = named;
    for (const TextKey& key : textKeys())
        if (mayLack(texts, key, named))
            wanted.erase(std::string(key.name));
        else
            wanted.insert(std::string(key.name));
    std::erase_if(wanted, [&](const std::string& key) { return words.has(key); });
    if (!wanted.empty() && !texts.language.empty())
        throw Error(words.own().place(),
                    fmt::format("expected all that participants read in \"{}\", found nothing for "
                                "\"{}\"; add the missing texts here",
                                texts.language, fmt::join(wanted, "\", \"")));
}

// Every text of the program's own, and those that the trial's phases name besides.
Texts parseTexts(TomlTable table, std::set<std::string> named, bool several, std::string language) {
    Texts texts;
    texts.table = table.pathOf("");
    texts.table.pop_back(); // its full stop
    texts.language = std::move(language);
    TextTable words(std::move(table));
    parseLanguage(words, named, several, texts);
    checkComplete(words, texts, named);
    const auto read = [&](const std::string& key, std::string& text) {
        text = words.text(key);
        if (words.own().has(key))
            texts.places[key] = words.placeOf(key);
    };
    for (const TextKey& key : textKeys())
        if (const std::string name(key.name); words.has(name) || !mayLack(texts, key, named))
            read(name, texts.*key.text);
    for (const TextKey& key : textKeys())
        named.erase(std::string(key.name));
    for (const std::string& key : named)
        read(key, texts.own[key]);
    words.own().finish();
    if (const auto place = texts.places.find("progress"); place != texts.places.end())
        checkProgress(texts.progress, place->second);
    return texts;
}

} // namespace

bool isLanguageTag(std::string_view tag) {
    static const std::regex form(
        "([a-z]{2,3}(-[a-z]{3}){0,3}|[a-z]{4,8})" // language, and extensions of it
        "(-[a-z]{4})?"                            // script
        "(-([a-z]{2}|[0-9]{3}))?"                 // region
        "(-([a-z0-9]{5,8}|[0-9][a-z0-9]{3}))*"    // variants
        "(-[a-wy-z0-9](-[a-z0-9]{2,8})+)*"        // extensions
        "(-x(-[a-z0-9]{1,8})+)?"                  // for private use
        "|x(-[a-z0-9]{1,8})+",
        std::regex::icase);
    return tag.size() <= 100 && std::regex_match(tag.begin(), tag.end(), form);
}

bool sameLanguage(std::string_view one, std::string_view other) {
    return std::equal(one.begin(), one.end(), other.begin(), other.end(), [](char a, char b) {
        return std::tolower(static_cast<unsigned char>(a)) ==
               std::tolower(static_cast<unsigned char>(b));
    });
}

std::vector<Texts> parseLanguages(TomlTable& root, const std::set<std::string>& named) {
    const bool several = root.has("languages");
    std::vector<Texts> all;
    all.push_back(
        parseTexts(root.requiredTable("texts", "what participants read"), named, several, ""));
    if (!several)
        return all;
    for (auto& [tag, table] : root.tables("languages", "another language, [languages.TAG]")) {
        checkTag(tag, table.place());
        for (const Texts& other : all)
            if (sameLanguage(other.language, tag))
                throw Error(table.place(), fmt::format("expected another language, found \"{}\" "
                                                       "again, which [{}] has",
                                                       tag, other.table));
        Texts texts = parseTexts(table, named, true, tag);
        for (const Texts& other : all)
            if (other.name == texts.name)
                throw Error(placeOfName(table),
                            fmt::format("expected another name, so that people can choose, found "
                                        "\"{}\" again, which [{}] has",
                                        texts.name, other.table));
        all.push_back(std::move(texts));
    }
    return all;
}

} // namespace obscura
