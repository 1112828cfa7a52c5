#include "base/arguments.h"

#include "base/csv.h"
#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace obscura {

NamedNumber parseNamedNumber(std::string_view option, std::string_view text,
                             std::span<const std::string> names) {
    const std::size_t equals = text.find('=');
    NamedNumber result{std::string(text.substr(0, equals)), 0};
    if (equals == text.npos || equals == 0)
        throw Error(fmt::format("expected {} NAME=NUMBER, found \"{}\"", option, text));
    if (!names.empty() && std::find(names.begin(), names.end(), result.name) == names.end())
        throw Error(fmt::format("{}: \"{}\" is none of its names{}", option, result.name,
                                suggestion(result.name, names)));
    const std::string_view number = text.substr(equals + 1);
    if (!readCell(number, result.value) || !std::isfinite(result.value))
        throw Error(fmt::format("expected {} {}=NUMBER, such as {}=1 or {}=0.5, found \"{}\"",
                                option, result.name, result.name, result.name, text));
    return result;
}

std::optional<std::pair<int, int>> parsePair(std::string_view text, char separator) {
    const char* const end = text.data() + text.size();
    std::pair<int, int> pair;
    const auto first = std::from_chars(text.data(), end, pair.first);
    if (first.ec != std::errc{} || first.ptr == end || *first.ptr != separator)
        return std::nullopt;
    const auto second = std::from_chars(first.ptr + 1, end, pair.second);
    if (second.ec != std::errc{} || second.ptr != end || std::min(pair.first, pair.second) < 1)
        return std::nullopt;
    return pair;
}

std::function<std::string(const std::string&)> numberFrom(double low, double high) {
    return [low, high](const std::string& text) {
        double value = 0;
        if (readCell(text, value) && low <= value && value <= high)
            return std::string();
        return fmt::format("expected a number from {:g} to {:g}, found {}", low, high, text);
    };
}

} // namespace obscura
