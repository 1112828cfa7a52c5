#include "protocols/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <vector>

namespace obscura {

std::string Place::prefix() const {
    std::string text = file;
    if (line > 0)
        text += fmt::format(":{}", line);
    if (column > 0)
        text += fmt::format(":{}", column);
    if (!text.empty())
        text += ": ";
    if (!key.empty())
        text += key + ": ";
    return text;
}

namespace {

// Levenshtein's distance, one row at a time.
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t substitute = diagonal + (a[i] != b[j]);
            diagonal = row[j + 1];
            row[j + 1] = std::min({substitute, diagonal + 1, row[j] + 1});
        }
    }
    return row.back();
}

} // namespace

std::string nearest(std::string_view given, std::span<const std::string> candidates) {
    std::string best;
    std::size_t bestDistance = ~std::size_t{0};
    for (const std::string& candidate : candidates) {
        const std::size_t distance = editDistance(given, candidate);
        if (distance < bestDistance && distance * 3 <= std::max(given.size(), candidate.size())) {
            best = candidate;
            bestDistance = distance;
        }
    }
    return best;
}

std::string suggestion(std::string_view given, std::span<const std::string> candidates) {
    if (const std::string name = nearest(given, candidates); !name.empty())
        return fmt::format("; did you mean \"{}\"?", name);
    return fmt::format("; one of: {}", fmt::join(candidates, ", "));
}

int runProgram(std::string_view program, int (*body)(int, char**), int argc, char** argv) {
    try {
        return body(argc, argv);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}: {}\n", program, error.what());
        return 1;
    }
}

} // namespace obscura
