#pragma once

#include "matching/fit.h"
#include "renderer/techniques/settings.h"

#include <algorithm>
#include <optional>
#include <string_view>

namespace obscura {

// Which parameters may be fitted, and between which bounds: those that the technique's row has and
// the study does not give.
class Freedom {
  public:
    Freedom(const TechniqueSetting& setting, const Settings& settings)
        : setting_(setting), settings_(settings) {}

    std::optional<Range> range(std::string_view name, double low, double high) const {
        const auto& parameters = settings_.technique().parameters;
        const auto parameter =
            std::find_if(parameters.begin(), parameters.end(),
                         [&](const Parameter& each) { return each.name == name; });
        const bool given = std::any_of(setting_.settings.begin(), setting_.settings.end(),
                                       [&](const Setting& each) { return each.name == name; });
        if (parameter == parameters.end() || given)
            return std::nullopt;
        return Range{std::max(low, static_cast<double>(parameter->low)),
                     std::min(high, static_cast<double>(parameter->high))};
    }
    std::optional<Range> multiplier() const { return range("radiusMultiplier", 1.0 / 32, 32); }
    // The row's own: within four octaves of the default.
    std::optional<Range> own(const Parameter& parameter) const {
        const auto value = static_cast<double>(parameter.value);
        return parameter.fitted ? range(parameter.name, value / 16, value * 16) : std::nullopt;
    }
    std::optional<Range> intensity() const { return range("intensity", 1e-4, 100); }
    std::optional<Range> power() const { return range("power", 0.1, 64); } // of its size
    double start(std::string_view name) const {
        return settings_.has(name) ? static_cast<double>(settings_[name]) : 1;
    }

  private:
    const TechniqueSetting& setting_;
    const Settings& settings_;
};

} // namespace obscura
