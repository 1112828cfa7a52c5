#include "bench/steadiness.h"

#include "bench/stability.h"
#include "bench/temporal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

// "hbao steps=8 ...", as failure tests name configurations; they have a radius of their own.
std::string configurationOf(const Settings& settings) {
    std::string text(settings.technique().id);
    for (const auto& [name, value] : settings.named())
        if (name != "radius")
            text += fmt::format(" {}={}", name, value);
    return text;
}

} // namespace

double flickerOf(const Scene& scene, const View& view, const Settings& matched,
                 const std::filesystem::path& folder) {
    const TemporalStudy study{scene,
                              view.camera,
                              view.radius,
                              {{std::string(matched.technique().id), matched}},
                              quickTemporalEffort(),
                              folder};
    double worst = 0;
    for (const StabilityCell& cell : measureTemporal(study))
        if (cell.measure == unrealChange99)
            worst = std::max(worst, cell.value);
    return worst;
}

std::string failuresOf(const Settings& matched, const std::vector<std::string>& wanted,
                       const std::filesystem::path& folder) {
    const std::vector<StabilityTest> tests = stabilityTests();
    StabilityOptions options;
    options.configurations = {configurationOf(matched)};
    options.folder = folder;
    options.tests = wanted;
    std::string text;
    for (const StabilityCell& cell : runStability(options, [](double, const std::string&) {}))
        for (const StabilityTest& test : tests)
            if (cell.test == test.id && cell.measure == test.measure &&
                cell.configuration == options.configurations.front() &&
                !(std::abs(cell.value) <= test.pass))
                text +=
                    fmt::format("{}{}: {} {:.3g}, no failure up to {:g}", text.empty() ? "" : "; ",
                                test.id, test.measure, cell.value, test.pass);
    return text;
}

} // namespace obscura
