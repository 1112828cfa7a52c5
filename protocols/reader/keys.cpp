#include "protocols/reader/keys.h"

#include "base/error.h"
#include "protocols/reader/toml_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

namespace obscura {

namespace {

struct KeyName {
    int key;
    std::string name, cap;
};

std::vector<KeyName> allKeys() {
    std::vector<KeyName> keys = {
        {32, "space", "Space"},
        {257, "enter", "Enter"},
        {262, "right", "→"},
        {263, "left", "←"},
        {340, "left shift", "⇧ left"},
        {344, "right shift", "⇧ right"},
        {341, "left control", "Ctrl left"},
        {345, "right control", "Ctrl right"},
        {44, ",", ","},
        {45, "-", "-"},
        {46, ".", "."},
        {47, "/", "/"},
        {59, ";", ";"},
        {61, "=", "="},
        {1000, "pad a", "Ⓐ"},
        {1001, "pad b", "Ⓑ"},
        {1002, "pad x", "Ⓧ"},
        {1003, "pad y", "Ⓨ"},
        {1004, "pad left", "Ⓛ"},
        {1005, "pad right", "Ⓡ"}, // shoulder buttons
    };
    for (char letter = 'a'; letter <= 'z'; ++letter) {
        const char upper = static_cast<char>(std::toupper(letter));
        keys.push_back({upper, std::string(1, letter), std::string(1, upper)});
    }
    for (int digit = 0; digit <= 9; ++digit) {
        keys.push_back({48 + digit, fmt::format("{}", digit), fmt::format("{}", digit)});
        keys.push_back({320 + digit, fmt::format("keypad {}", digit), fmt::format("{}", digit)});
    }
    for (int number = 1; number <= 12; ++number)
        keys.push_back({289 + number, fmt::format("f{}", number), fmt::format("F{}", number)});
    return keys;
}

const std::vector<KeyName>& known() {
    static const std::vector<KeyName> keys = allKeys();
    return keys;
}

const KeyName* find(int key) {
    const auto found = std::find_if(known().begin(), known().end(),
                                    [&](const KeyName& one) { return one.key == key; });
    return found == known().end() ? nullptr : &*found;
}

bool contains(const std::vector<int>& keys, int key) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

// Keys that have another meaning on pages of questions.
const std::map<std::string, std::string, std::less<>>& taken() {
    static const std::map<std::string, std::string, std::less<>> keys = {
        {"escape", "asks whether to end the session"},
        {"tab", "goes from one question to another"},
        {"up", "goes from one question to another"},
        {"down", "goes from one question to another"},
        {"backspace", "takes back what was typed"}};
    return keys;
}

int keyNamed(const PlacedText& text) {
    std::vector<std::string> names;
    for (const KeyName& key : known()) {
        if (key.name == text.text)
            return key.key;
        names.push_back(key.name);
    }
    if (const auto other = taken().find(text.text); other != taken().end())
        throw Error(text.place, fmt::format("expected another key than \"{}\", which {}", text.text,
                                            other->second));
    throw Error(text.place,
                fmt::format("expected the name of a key, such as \"f\", \"space\", \"left\", "
                            "\"keypad 1\" or \"pad a\", found \"{}\"{}",
                            text.text, suggestion(text.text, names)));
}

void checkRole(const PlacedText& text, int key, bool go) {
    if (go && ((key >= 48 && key <= 57) || (key >= 320 && key <= 329)))
        throw Error(text.place, "expected no digit to go on, for digits choose among options");
    if (go && (text.text == "left" || text.text == "right"))
        throw Error(text.place, "expected no arrow to go on, for arrows move sliders");
    if (!go && text.text == "enter")
        throw Error(text.place,
                    "expected another key than \"enter\", which ends pages of questions");
}

void parse(TomlTable& table, const char* name, std::vector<int>& keys) {
    const std::vector<PlacedText> texts = table.texts(name, "names of keys, such as [\"f\"]");
    if (!texts.empty())
        keys.clear();
    for (const PlacedText& text : texts) {
        const int key = keyNamed(text);
        checkRole(text, key, std::string_view(name) == "go");
        if (contains(keys, key))
            throw Error(text.place,
                        fmt::format("expected each key once, found \"{}\" again", text.text));
        keys.push_back(key);
    }
}

} // namespace

Keys::Keys() : first{49, 321, 263, 1004}, second{50, 322, 262, 1005}, go{32, 1000} {}

bool Keys::isGo(int key) const { return contains(go, key); }

int Keys::optionOf(int key) const {
    return contains(first, key) ? 1 : contains(second, key) ? 2 : 0;
}

std::string capOf(int key) {
    const KeyName* found = find(key);
    return found ? found->cap : fmt::format("{}", key);
}

std::string_view nameOfKey(int key) {
    const KeyName* found = find(key);
    return found ? found->name : std::string_view();
}

Keys parseKeys(TomlTable table) {
    Keys keys;
    parse(table, "first", keys.first);
    parse(table, "second", keys.second);
    parse(table, "go", keys.go);
    table.finish();
    const std::pair<const char*, const std::vector<int>*> all[] = {
        {"first", &keys.first}, {"second", &keys.second}, {"go", &keys.go}};
    for (const auto& one : all)
        for (const auto& other : all)
            for (const int key : *one.second)
                if (&one < &other && contains(*other.second, key))
                    throw Error(
                        table.place(),
                        fmt::format("expected one meaning for each key; \"{}\" is both in "
                                    "\"{}\" and in \"{}\"{}",
                                    nameOfKey(key), one.first, other.first,
                                    table.has(one.first) && table.has(other.first)
                                        ? ""
                                        : ", of which one has its usual keys; name them, too"));
    return keys;
}

} // namespace obscura
