#include "archive/same_results.h"

#include "base/csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace obscura {

namespace {

using Values = std::map<std::string, std::string>; // as text, by where they stand in their file

std::optional<double> numberIn(const std::string& text) {
    double number = 0;
    return readCell(text, number) ? std::optional(number) : std::nullopt;
}

// A cell by its column and by the row's own name: what its cells before the first number say, and
// which of the rows that say the same it is. Rows that are new or gone leave the names of others
// alone.
Values valuesOfCsv(const std::string& text) {
    Values values;
    const std::vector<CsvRecord> records = splitCsv(text);
    std::map<std::string, int> seen;
    for (std::size_t i = 0; i < records.size(); ++i) {
        const std::vector<std::string>& cells = records[i].cells;
        if (i == 0) {
            values["header"] = fmt::format("{}", fmt::join(cells, ","));
            continue;
        }
        std::string name;
        for (std::size_t c = 0; c < cells.size() && !numberIn(cells[c]); ++c)
            name += (name.empty() ? "" : ", ") + cells[c].substr(0, 60);
        const int number = ++seen[name];
        for (std::size_t c = 0; c < cells.size(); ++c) {
            const std::string column = c < records[0].cells.size() ? records[0].cells[c] : "more";
            values[fmt::format("{} of row {}{}", column, name.empty() ? "without a name" : name,
                               number > 1 ? fmt::format(" ({})", number) : "")] = cells[c];
        }
    }
    return values;
}

Values valuesOfJson(const std::string& text) {
    Values values;
    auto json = nlohmann::json::parse(text, nullptr, false);
    if (json.is_object())
        json.erase("made");
    const auto flat = json.flatten();
    for (const auto& [key, value] : flat.items())
        values[key] = value.is_string() ? value.get<std::string>() : value.dump();
    return values;
}

Values valuesOf(const std::string& file, const std::string& text) {
    return file.ends_with(".json") ? valuesOfJson(text) : valuesOfCsv(text);
}

std::string shown(const std::string& value) {
    constexpr std::size_t most = 80;
    return value.size() > most ? value.substr(0, most) + "..." : value;
}

class Comparing {
  public:
    void compare(const std::string& file, const Values& before, const Values& now) {
        for (const auto& [key, value] : before)
            if (const auto found = now.find(key); found == now.end())
                other(file, key, fmt::format("was {}, is gone", shown(value)));
            else
                compare(file, key, value, found->second);
        for (const auto& [key, value] : now)
            if (!before.contains(key))
                other(file, key, fmt::format("is new: {}", shown(value)));
    }

    void other(const std::string& file, const std::string& key, const std::string& how) {
        result_.others.push_back(fmt::format("{}: {} {}", file, key, how));
    }

    ResultsComparison result() { return std::move(result_); }

  private:
    void compare(const std::string& file, const std::string& key, const std::string& before,
                 const std::string& now) {
        if (before == now) {
            ++result_.same;
            return;
        }
        const std::optional<double> was = numberIn(before), is = numberIn(now);
        if (!was || !is) {
            other(file, key, fmt::format("was \"{}\", is now \"{}\"", shown(before), shown(now)));
            return;
        }
        constexpr double rounding = 1e-9;
        const double larger = std::max(std::abs(*was), std::abs(*is)), apart = *is - *was;
        if (apart == 0) { // it is only spelt otherwise
            ++result_.same;
        } else if (std::abs(apart) < rounding * larger) {
            ++result_.nearly;
            result_.most = std::max(result_.most, std::abs(apart) / larger);
        } else {
            result_.numbers.push_back(
                fmt::format("{}: {} was {}, is now {}: {:+.3g}", file, key, before, now, apart));
        }
    }

    ResultsComparison result_;
};

} // namespace

ResultsComparison comparisonOf(const std::map<std::string, std::string>& before,
                               const std::map<std::string, std::string>& now) {
    Comparing comparing;
    for (const auto& [file, text] : before)
        if (const auto found = now.find(file); found == now.end())
            comparing.other(file, "it", "is not among what the analysis gives");
        else
            comparing.compare(file, valuesOf(file, text), valuesOf(file, found->second));
    for (const auto& [file, text] : now)
        if (!before.contains(file))
            comparing.other(file, "it", "is missing");
    return comparing.result();
}

} // namespace obscura
