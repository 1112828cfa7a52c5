#include "protocols/reader/toml_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

Place TomlTable::placeOf(const toml::node& node, const std::string& path) const {
    const toml::source_position at = node.source().begin;
    return {file_, static_cast<int>(at.line), static_cast<int>(at.column), path};
}

Place TomlTable::placeOf(std::string_view key) const {
    for (const auto& [name, value] : *table_)
        if (name.str() == key) {
            const toml::source_position at = name.source().begin;
            return {file_, static_cast<int>(at.line), static_cast<int>(at.column), pathOf(key)};
        }
    return place();
}

std::string TomlTable::pathOf(std::string_view key) const {
    return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

std::string TomlTable::spell(const toml::node& node) {
    if (const auto text = node.value<std::string>(); text && node.is_string())
        return fmt::format("\"{}\"", *text);
    if (node.is_boolean())
        return *node.value<bool>() ? "true" : "false";
    if (node.is_integer())
        return fmt::format("{}", *node.value<std::int64_t>());
    if (node.is_floating_point())
        return fmt::format("{}", *node.value<double>());
    if (const auto* array = node.as_array())
        return fmt::format("an array of {}", array->size());
    return node.is_table() ? "a table" : "a date or time";
}

void TomlTable::missing(std::string_view key, std::string_view expected) const {
    Place at = place();
    at.key = pathOf(key);
    throw Error(at, fmt::format("expected {}, found nothing; add \"{}\" here", expected, key));
}

void TomlTable::wrong(std::string_view key, const toml::node& found,
                      std::string_view expected) const {
    throw Error(placeOf(found, pathOf(key)),
                fmt::format("expected {}, found {}", expected, spell(found)));
}

const toml::node* TomlTable::node(std::string_view key) {
    if (std::find(asked_.begin(), asked_.end(), key) == asked_.end())
        asked_.emplace_back(key);
    return table_->get(key);
}

bool TomlTable::has(std::string_view key) { return node(key) != nullptr; }

double TomlTable::bounded(std::string_view key, const toml::node& found, double low, double high,
                          std::string_view kind) const {
    const std::string expected = fmt::format("{} from {} to {}", kind, low, high);
    if (!found.is_number() || (kind == "a whole number" && !found.is_integer()))
        wrong(key, found, expected);
    const double value = *found.value<double>();
    if (!(value >= low && value <= high))
        wrong(key, found, expected);
    return value;
}

double TomlTable::number(std::string_view key, double low, double high,
                         std::optional<double> fallback) {
    const toml::node* found = node(key);
    if (!found && !fallback)
        missing(key, fmt::format("a number from {} to {}", low, high));
    return found ? bounded(key, *found, low, high, "a number") : *fallback;
}

int TomlTable::integer(std::string_view key, int low, int high, std::optional<int> fallback) {
    const toml::node* found = node(key);
    if (!found && !fallback)
        missing(key, fmt::format("a whole number from {} to {}", low, high));
    return found ? static_cast<int>(bounded(key, *found, low, high, "a whole number")) : *fallback;
}

bool TomlTable::flag(std::string_view key, bool fallback) {
    const toml::node* found = node(key);
    if (found && !found->is_boolean())
        wrong(key, *found, "true or false");
    return found ? *found->value<bool>() : fallback;
}

std::string TomlTable::text(std::string_view key, std::optional<std::string> fallback) {
    const toml::node* found = node(key);
    if (!found && !fallback)
        missing(key, "a text in quotes");
    if (found && !found->is_string())
        wrong(key, *found, "a text in quotes");
    std::string result = found ? *found->value<std::string>() : *fallback;
    if (found && result.empty())
        wrong(key, *found, "a text that is not empty");
    return result;
}

std::size_t TomlTable::choice(std::string_view key, const std::vector<std::string>& choices,
                              std::size_t fallback) {
    const toml::node* found = node(key);
    if (!found)
        return fallback;
    const std::string expected = fmt::format("one of \"{}\"", fmt::join(choices, "\", \""));
    if (!found->is_string())
        wrong(key, *found, expected);
    const std::string value = *found->value<std::string>();
    const auto at = std::find(choices.begin(), choices.end(), value);
    if (at == choices.end())
        throw Error(placeOf(*found, pathOf(key)),
                    fmt::format("expected {}, found \"{}\"{}", expected, value,
                                nearest(value, choices).empty() ? "" : suggestion(value, choices)));
    return static_cast<std::size_t>(at - choices.begin());
}

std::array<double, 3> TomlTable::triple(std::string_view key, double low, double high,
                                        std::optional<std::array<double, 3>> fallback) {
    const std::string expected = fmt::format("three numbers from {} to {}", low, high);
    const toml::node* found = node(key);
    if (!found && !fallback)
        missing(key, expected);
    if (!found)
        return *fallback;
    const toml::array* array = found->as_array();
    if (!array || array->size() != 3)
        wrong(key, *found, expected);
    std::array<double, 3> result{};
    for (std::size_t i = 0; i < 3; ++i)
        result[i] =
            bounded(fmt::format("{}[{}]", key, i + 1), *array->get(i), low, high, "a number");
    return result;
}

std::vector<PlacedText> TomlTable::texts(std::string_view key, std::string_view expected) {
    const toml::node* found = node(key);
    const toml::array* array = found ? found->as_array() : nullptr;
    if (found && (!array || array->empty()))
        wrong(key, *found, expected);
    std::vector<PlacedText> result;
    for (std::size_t i = 0; array && i < array->size(); ++i) {
        const toml::node& item = *array->get(i);
        const std::string itemKey = fmt::format("{}[{}]", key, i + 1);
        if (!item.is_string())
            wrong(itemKey, item, "a text in quotes");
        result.push_back({*item.value<std::string>(), placeOf(item, pathOf(itemKey))});
    }
    return result;
}

std::vector<PlacedText> TomlTable::requiredTexts(std::string_view key, std::string_view expected) {
    auto result = texts(key, expected);
    if (result.empty())
        missing(key, expected);
    return result;
}

std::vector<double> TomlTable::numbers(std::string_view key, double low, double high) {
    const toml::node* found = node(key);
    const toml::array* array = found ? found->as_array() : nullptr;
    if (found && (!array || array->empty()))
        wrong(key, *found, fmt::format("numbers from {} to {}", low, high));
    std::vector<double> result;
    for (std::size_t i = 0; array && i < array->size(); ++i)
        result.push_back(
            bounded(fmt::format("{}[{}]", key, i + 1), *array->get(i), low, high, "a number"));
    return result;
}

std::optional<TomlTable> TomlTable::table(std::string_view key) {
    const toml::node* found = node(key);
    if (!found)
        return std::nullopt;
    if (!found->is_table())
        wrong(key, *found, "a table");
    return TomlTable(*found->as_table(), file_, pathOf(key));
}

TomlTable TomlTable::requiredTable(std::string_view key, std::string_view expected) {
    auto result = table(key);
    if (!result)
        missing(key, expected);
    return *result;
}

std::vector<std::pair<std::string, TomlTable>> TomlTable::tables(std::string_view key,
                                                                 std::string_view expected) {
    const TomlTable parent = requiredTable(key, expected);
    std::vector<std::pair<std::string, TomlTable>> result;
    for (const auto& [name, value] : *parent.table_) {
        if (!value.is_table())
            throw Error(placeOf(value, parent.pathOf(name.str())),
                        fmt::format("expected {}, found {}", expected, spell(value)));
        result.emplace_back(std::string(name.str()),
                            TomlTable(*value.as_table(), file_, parent.pathOf(name.str())));
    }
    if (result.empty())
        throw Error(parent.place(), fmt::format("expected {}, found an empty table", expected));
    // The library sorts by name; a study's order is that of its file.
    std::stable_sort(result.begin(), result.end(), [](const auto& a, const auto& b) {
        const Place left = a.second.place(), right = b.second.place();
        return std::pair(left.line, left.column) < std::pair(right.line, right.column);
    });
    return result;
}

std::vector<TomlTable> TomlTable::list(std::string_view key, std::string_view expected) {
    const toml::node* found = node(key);
    if (!found)
        missing(key, expected);
    const toml::array* array = found->as_array();
    if (!array || array->empty())
        wrong(key, *found, expected);
    std::vector<TomlTable> result;
    for (std::size_t i = 0; i < array->size(); ++i) {
        const std::string path = fmt::format("{}[{}]", pathOf(key), i + 1);
        const toml::node& item = *array->get(i);
        if (!item.is_table())
            throw Error(placeOf(item, path),
                        fmt::format("expected {}, found {}", expected, spell(item)));
        result.emplace_back(*item.as_table(), file_, path);
    }
    return result;
}

void TomlTable::finish() const {
    for (const auto& [name, value] : *table_) {
        const std::string key(name.str());
        if (std::find(asked_.begin(), asked_.end(), key) == asked_.end())
            throw Error(placeOf(key), "unknown key" + suggestion(key, asked_));
    }
}

} // namespace obscura
