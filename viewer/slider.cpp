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
    const double low = bent(scale, scale.low), high = bent(scale, scale.high);
    const double value = straightened(scale, low + std::clamp(position, 0.0, 1.0) * (high - low));
    // A step of an even slider is a five-hundredth of its range, so that it comes by round numbers.
    if (scale.whole)
        return std::clamp(std::round(value), scale.low, scale.high);
    if (scale.kind == Scale::Kind::even) {
        const double step = toThreeDigits((scale.high - scale.low) / 500);
        return std::clamp(std::round(value / step) * step, scale.low, scale.high);
    }
    // What is nearer to zero than one step of the slider is zero.
    if (scale.kind == Scale::Kind::aroundZero && std::abs(value) < knee(scale) / 20)
        return std::clamp(0.0, scale.low, scale.high);
    return std::clamp(toThreeDigits(value), scale.low, scale.high);
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
    return fmt::format("{}\n{}: {}\nDefault from: {}", parameter.meaning, parameter.name, range,
                       parameter.source);
}

} // namespace obscura
