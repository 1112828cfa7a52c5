#include "protocols/reader/display.h"

#include "base/arguments.h"
#include "base/error.h"
#include "protocols/reader/toml_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace obscura {

namespace {

struct Number {
    const char* key;
    double low, high;
    void (*set)(Display&, double);
    double (*get)(const Display&);
};
constexpr Number numbers[] = {
    {"width", 16, 65536, [](Display& d, double value) { d.width = static_cast<int>(value); },
     [](const Display& d) { return static_cast<double>(d.width); }},
    {"height", 16, 65536, [](Display& d, double value) { d.height = static_cast<int>(value); },
     [](const Display& d) { return static_cast<double>(d.height); }},
    {"diagonalInches", 0.1, 10000, [](Display& d, double value) { d.diagonalInches = value; },
     [](const Display& d) { return d.diagonalInches; }},
    {"distanceCm", 1, 1e5, [](Display& d, double value) { d.distance = value / 100; },
     [](const Display& d) { return d.distance * 100; }},
    {"peak", 1, 1e5, [](Display& d, double value) { d.peak = value; },
     [](const Display& d) { return d.peak; }},
    {"contrast", 1, 1e9, [](Display& d, double value) { d.contrast = value; },
     [](const Display& d) { return d.contrast; }},
    {"ambientLux", 0, 2e5, [](Display& d, double value) { d.ambient = value; },
     [](const Display& d) { return d.ambient; }},
};

bool isWhole(const Number& number) { return number.key[0] == 'w' || number.key[0] == 'h'; }

std::vector<std::string> namesOf(const std::vector<Display>& all) {
    std::vector<std::string> names;
    for (const Display& display : all)
        names.push_back(display.name);
    return names;
}

} // namespace

double Display::pixelsPerDegree() const {
    const double metresWide = diagonalInches * 0.0254 * width / std::hypot(width, height);
    return std::numbers::pi / 180 / (2 * std::atan(metresWide / (2 * width * distance)));
}

const std::vector<Display>& displays() {
    // The first two are the authors' of ColorVideoVDP; the laptop is that of Jakobsen 2010, its
    // light by guess.
    static const std::vector<Display> rows{
        {"standard_fhd", 1920, 1080, 24, 0.6, 200, 1000, 250},
        {"standard_4k", 3840, 2160, 30, 0.7472, 200, 1000, 250},
        {"laptop", 1280, 800, 15.4, 0.6, 200, 700, 100},
    };
    return rows;
}

std::string inWords(const Display& display) {
    return fmt::format("{:g}-inch, {} x {} pixels, from {:g} cm ({:.1f} pixels per degree), "
                       "{:g} cd/m2 at {:g}:1 in {:g} lux",
                       display.diagonalInches, display.width, display.height,
                       display.distance * 100, display.pixelsPerDegree(), display.peak,
                       display.contrast, display.ambient);
}

Display parseDisplay(TomlTable table, double distanceCm) {
    Display display = displays()[table.choice("name", namesOf(displays()), 0)];
    const auto set = [&](const Number& number, double value) {
        number.set(display, value);
        display.name.clear();
    };
    if (distanceCm > 0 && !table.has("distanceCm"))
        set(numbers[3], distanceCm);
    for (const Number& number : numbers) {
        if (!table.has(number.key))
            continue;
        const int low = static_cast<int>(number.low), high = static_cast<int>(number.high);
        set(number, isWhole(number) ? table.integer(number.key, low, high)
                                    : table.number(number.key, number.low, number.high));
    }
    table.finish();
    return display;
}

std::vector<std::pair<std::string, double>> numbersOf(const Display& display) {
    std::vector<std::pair<std::string, double>> result;
    for (const Number& number : numbers)
        result.emplace_back(number.key, number.get(display));
    return result;
}

Display displayOf(std::span<const std::string> words) {
    std::vector<std::string> keys;
    for (const Number& number : numbers)
        keys.emplace_back(number.key);
    Display display = displays().front();
    for (const std::string& word : words) {
        if (word.find('=') == word.npos) {
            const std::vector<std::string> known = namesOf(displays());
            const auto row = std::find(known.begin(), known.end(), word);
            if (row == known.end())
                throw Error(fmt::format("--display: expected the name of a display or a number of "
                                        "it, as in \"peak=120\" ({}); found \"{}\"{}",
                                        fmt::join(keys, ", "), word, suggestion(word, known)));
            display = displays()[static_cast<std::size_t>(row - known.begin())];
            continue;
        }
        const NamedNumber given = parseNamedNumber("--display", word, keys);
        const Number& number = *std::find_if(std::begin(numbers), std::end(numbers),
                                             [&](const Number& n) { return n.key == given.name; });
        if (!(given.value >= number.low && given.value <= number.high) ||
            (isWhole(number) && given.value != std::floor(given.value)))
            throw Error(fmt::format("--display: expected {} to be a {}number from {:g} to {:g}, "
                                    "found \"{}\"",
                                    given.name, isWhole(number) ? "whole " : "", number.low,
                                    number.high, word));
        number.set(display, given.value);
        display.name.clear();
    }
    return display;
}

} // namespace obscura
