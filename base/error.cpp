#include "base/error.h"

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

// Edits to turn `a` into `b`: insert, delete, replace, or exchange two neighbours (the restricted
// distance of Damerau 1964).
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before, above(b.size() + 1), row(b.size() + 1);
    std::iota(above.begin(), above.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            row[j] =
                std::min({above[j - 1] + (a[i - 1] != b[j - 1]), above[j] + 1, row[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
        before = above;
        above = row;
    }
    return above.back();
}

// The beginning of a name counts as near: "fov" for "fovDegrees".
std::size_t distance(std::string_view given, std::string_view candidate) {
    if (given.size() >= 3 && candidate.starts_with(given))
        return 1;
    return editDistance(given, candidate);
}

} // namespace

std::string nearest(std::string_view given, std::span<const std::string> candidates) {
    std::string best;
    std::size_t bestDistance = ~std::size_t{0};
    for (const std::string& candidate : candidates) {
        const std::size_t edits = distance(given, candidate);
        if (edits < bestDistance && edits * 3 <= std::max(given.size(), candidate.size())) {
            best = candidate;
            bestDistance = edits;
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
