#pragma once

#include "base/error.h"

#include <toml++/toml.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace obscura {

struct PlacedText {
    std::string text;
    Place place;
};

// A TOML table being read: every look-up names its key, type and range, and remembers the key, so
// that finish() can report the first key nobody asked for with the nearest one that exists. All
// errors give file, line, column, what was expected and what was found.
class TomlTable {
  public:
    TomlTable(const toml::table& table, std::string file, std::string path)
        : table_(&table), file_(std::move(file)), path_(std::move(path)) {}

    bool has(std::string_view key);
    // Without a fallback, the key is compulsory. Numbers lie in [low, high].
    double number(std::string_view key, double low, double high,
                  std::optional<double> fallback = {});
    int integer(std::string_view key, int low, int high, std::optional<int> fallback = {});
    bool flag(std::string_view key, bool fallback);
    std::string text(std::string_view key, std::optional<std::string> fallback = {});
    // The text must be one of `choices`; gives its index.
    std::size_t choice(std::string_view key, const std::vector<std::string>& choices,
                       std::size_t fallback);
    std::array<double, 3> triple(std::string_view key, double low, double high,
                                 std::optional<std::array<double, 3>> fallback = {});
    // A sub-table; absent means none.
    std::optional<TomlTable> table(std::string_view key);
    TomlTable requiredTable(std::string_view key, std::string_view expected);
    // Sub-tables in the order of the file, with their names.
    std::vector<std::pair<std::string, TomlTable>> tables(std::string_view key,
                                                          std::string_view expected);
    std::vector<TomlTable> list(std::string_view key, std::string_view expected);
    // Lists of values, not empty; absent means none.
    std::vector<PlacedText> texts(std::string_view key, std::string_view expected);
    std::vector<PlacedText> requiredTexts(std::string_view key, std::string_view expected);
    std::vector<double> numbers(std::string_view key, double low, double high);
    const toml::node* node(std::string_view key);

    void finish() const;

    Place place() const { return placeOf(*table_, path_); }
    Place placeOf(std::string_view key) const;
    std::string pathOf(std::string_view key) const;
    const toml::table& raw() const { return *table_; }
    Place placeOf(const toml::node& node, const std::string& path) const;

    // The value as an error shows it: `"text"`, `3`, "a table".
    static std::string spell(const toml::node& node);

  private:
    [[noreturn]] void missing(std::string_view key, std::string_view expected) const;
    [[noreturn]] void wrong(std::string_view key, const toml::node& found,
                            std::string_view expected) const;
    double bounded(std::string_view key, const toml::node& found, double low, double high,
                   std::string_view kind) const;

    const toml::table* table_;
    std::string file_, path_;
    std::vector<std::string> asked_;
};

} // namespace obscura
