#include "bench/stability/finding_text.h"

#include "base/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdlib>

namespace obscura {

namespace {

using Json = nlohmann::json;

// As text: JSON has no infinity, and no number that is none.
std::string textOf(double value) { return fmt::format("{}", value); }
double numberIn(const Json& json) {
    return std::strtod(json.get_ref<const std::string&>().c_str(), nullptr);
}

} // namespace

std::string findingText(const TemporalFinding& finding) {
    Json cells = Json::array(), truthfulness = Json::array();
    for (const StabilityCell& cell : finding.cells)
        cells.push_back({cell.configuration, cell.technique, cell.test, cell.measure,
                         textOf(cell.value), cell.picture, cell.note});
    for (const double value : finding.truthfulness)
        truthfulness.push_back(textOf(value));
    return Json{{"cells", cells}, {"truthfulness", truthfulness}}.dump();
}

TemporalFinding readFinding(const std::string& text) {
    TemporalFinding finding;
    try {
        const Json json = Json::parse(text);
        for (const Json& cell : json.at("cells"))
            finding.cells.push_back({cell.at(0), cell.at(1), cell.at(2), cell.at(3),
                                     numberIn(cell.at(4)), cell.at(5), cell.at(6)});
        for (const Json& value : json.at("truthfulness"))
            finding.truthfulness.push_back(numberIn(value));
    } catch (const Json::exception& error) {
        throw Error(fmt::format("expected what a stability test found, found \"{}\" ({})",
                                text.substr(0, 60), error.what()));
    }
    return finding;
}

} // namespace obscura
