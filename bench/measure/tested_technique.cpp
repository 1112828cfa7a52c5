#include "bench/measure/tested_technique.h"

#include "base/arguments.h"
#include "base/error.h"
#include "base/percentile.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <sstream>

namespace obscura {

namespace {

Settings settingsIn(const std::string& configuration) {
    std::istringstream words(configuration);
    std::string word;
    words >> word;
    Settings settings(technique(word));
    if (settings.technique().reads & rays)
        throw Error(fmt::format("expected a technique of the screen, found \"{}\", which traces "
                                "the scene itself: it is the truth",
                                word));
    while (words >> word) {
        const NamedNumber given = parseNamedNumber(settings.technique().id, word);
        if (given.name == "radius")
            throw Error(fmt::format("\"{}\": the radius is the tests' unit of length and cannot "
                                    "be set; radiusMultiplier can",
                                    configuration));
        settings.set(given.name, given.value, {"", 0, 0, configuration});
    }
    if (settings.has("radius"))
        settings.set("radius", 1);
    return settings;
}

} // namespace

TestedTechnique::TestedTechnique(const std::string& configuration)
    : configuration_(configuration), settings_(settingsIn(configuration)) {}

TestedTechnique TestedTechnique::scaled(double factor) const {
    TestedTechnique result(configuration_);
    if (settings_.has("radius"))
        result.settings_.set("radius", static_cast<double>(settings_["radius"]) * factor);
    return result;
}

OcclusionPasses& TestedTechnique::passes(const Probe& probe, int beyond) const {
    const Surfaces& surfaces = probe.surfaces();
    const int border = 2 * (guardPixels(settings_, surfaces.height) + beyond);
    const std::pair size(surfaces.width + border, surfaces.height + border);
    const auto known = passes_.find(size);
    return known != passes_.end()
               ? known->second
               : passes_.emplace(size, probe.passesFor(settings_, beyond)).first->second;
}

Image TestedTechnique::visibility(const Probe& probe, int beyond) const {
    return probe.visibility(settings_, passes(probe, beyond), beyond);
}

double TestedTechnique::seconds(const Probe& probe, int runs) const {
    using Clock = std::chrono::steady_clock;
    std::vector<double> times;
    for (int run = 0; run < runs; ++run) {
        const Clock::time_point start = Clock::now();
        visibility(probe);
        times.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    }
    return percentile(std::move(times), 0.5);
}

} // namespace obscura
