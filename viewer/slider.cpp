#include "viewer/slider.h"

#include "renderer/techniques/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace obscura {

namespace {

// The aroundZero scale is about even up to here, a thousandth of the range, and logarithmic beyond.
double knee(const Scale& scale) { return std::max(-scale.low, scale.high) / 1000; }

double bent(const Scale& scale, double value) {
    switch (scale.kind) {
    case Scale::Kind::logarithmic:
        return std::log(value);
    case Scale::Kind::aroundZero:
        return std::asinh(value / knee(scale));
    case Scale::Kind::even:
        break;
    }
    return value;
}

double straightened(const Scale& scale, double value) {
    switch (scale.kind) {
    case Scale::Kind::logarithmic:
        return std::exp(value);
    case Scale::Kind::aroundZero:
        return std::sinh(value) * knee(scale);
    case Scale::Kind::even:
        break;
    }
    return value;
}

// A power of ten, twice or five times that, no more than given.
double roundStep(double most) {
    const double ten = std::pow(10, std::floor(std::log10(most)));
    return most >= 5 * ten ? 5 * ten : most >= 2 * ten ? 2 * ten : ten;
}

double toThreeDigits(double value) {
    if (value == 0)
        return 0;
    const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - 2);
    return std::round(value / unit) * unit;
}

} // namespace

Scale scaleBetween(double low, double high, bool whole) {
    Scale scale{Scale::Kind::even, low, high, whole};
    if (low > 0 && high / low > 100)
        scale.kind = Scale::Kind::logarithmic;
    return scale;
}

Scale scaleOf(const Parameter& parameter) {
    Scale scale = scaleBetween(static_cast<double>(parameter.low),
                               static_cast<double>(parameter.high), isWhole(parameter));
    if (parameter.low <= 0 && parameter.high >= 10 && parameter.unit == Unit::ratio)
        scale.kind = Scale::Kind::aroundZero;
    return scale;
}

double positionOf(const Scale& scale, double value) {
    const double low = bent(scale, scale.low), high = bent(scale, scale.high);
    return std::clamp((bent(scale, std::clamp(value, scale.low, scale.high)) - low) / (high - low),
                      0.0, 1.0);
}

double valueAt(const Scale& scale, double position) {
    if (position <= 0 || position >= 1)
        return position <= 0 ? scale.low : scale.high;
    const double low = bent(scale, scale.low), high = bent(scale, scale.high);
    double value = straightened(scale, low + position * (high - low));
    if (scale.whole)
        value = std::round(value);
    else if (scale.kind == Scale::Kind::even) { // round numbers, some five hundred of them
        const double step = roundStep((scale.high - scale.low) / 500);
        value = std::round(value / step) * step;
    } else if (scale.kind == Scale::Kind::aroundZero && std::abs(value) < knee(scale) / 20)
        value = 0; // so that it can be hit
    else
        value = toThreeDigits(value);
    return std::clamp(value, scale.low, scale.high);
}

std::string valueText(double value, Unit unit) {
    std::string text = fmt::format("{:.4g}", value);
    if (std::abs(value) >= 10000 && std::abs(value) < 1e7)
        text = fmt::format("{:.0f}", value);
    switch (unit) {
    case Unit::metre:
        return text + " m";
    case Unit::degree:
        return text + "°";
    case Unit::pixel:
        return text + " px";
    case Unit::ratio:
    case Unit::count:
    case Unit::flag:
        break;
    }
    return text;
}

std::string inWords(std::string_view name) {
    std::string words;
    for (const char c : name) {
        if (words.empty())
            words += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        else if (std::isupper(static_cast<unsigned char>(c))) {
            words += ' ';
            words += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        } else
            words += c == '_' ? ' ' : c;
    }
    return words;
}

std::string meaningOf(const Parameter& parameter) {
    const auto number = [&](float value) {
        return valueText(static_cast<double>(value), parameter.unit);
    };
    const std::string range =
        parameter.unit == Unit::flag
            ? fmt::format("off or on, default {}", parameter.value > 0 ? "on" : "off")
            : fmt::format("{}, {} to {}, default {}", spell(parameter.unit), number(parameter.low),
                          number(parameter.high), number(parameter.value));
    std::string meaning(parameter.meaning);
    meaning[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(meaning[0])));
    return fmt::format("{}\n{}: {}\nDefault from: {}", meaning, parameter.name, range,
                       parameter.source);
}

} // namespace obscura
