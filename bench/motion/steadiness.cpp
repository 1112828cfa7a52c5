#include "bench/motion/steadiness.h"

#include "bench/measure/machine.h"
#include "bench/motion/temporal.h"
#include "bench/stability/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace obscura {

namespace {

// No point was seen in two frames: that is not steady.
constexpr double unknown = std::numeric_limits<double>::infinity();

// "hbao steps=8", as failure tests name configurations, which also names their pictures: what
// differs from the table's defaults. They have a radius of their own.
std::string configurationOf(const Settings& settings) {
    std::string text(settings.technique().id);
    for (const Parameter& parameter : settings.technique().parameters)
        if (parameter.name != "radius" && settings[parameter.name] != parameter.value)
            text += fmt::format(" {}={}", parameter.name, settings[parameter.name]);
    return text;
}

} // namespace

std::vector<double> flickerOf(const Scene& scene, const View& view,
                              const std::vector<NamedSettings>& matched,
                              const std::filesystem::path& folder) {
    TemporalEffort effort = quickTemporalEffort();
    std::erase(effort.tests, "still"); // without motion nothing changes relative to the truth
    const auto cells = measureTemporal({scene, view.camera, view.radius, matched, effort, folder});
    std::vector<double> worst(matched.size(), 0.0);
    for (const StabilityCell& cell : cells)
        for (std::size_t i = 0; i < matched.size(); ++i)
            if (cell.configuration == matched[i].name && cell.measure == unrealChange99)
                worst[i] = std::isnan(cell.value) ? unknown : std::max(worst[i], cell.value);
    return worst;
}

std::string failuresOf(const Settings& matched, const std::vector<std::string>& wanted,
                       const std::filesystem::path& folder) {
    const std::vector<StabilityTest> tests = stabilityTests();
    StabilityOptions options;
    options.configurations = {configurationOf(matched)};
    options.folder = folder;
    options.tests = wanted;
    options.anew = true; // an earlier search may have had another program
    options.about = fmt::format("{}, {}\n", programName(), gl::currentDriver().renderer);
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
