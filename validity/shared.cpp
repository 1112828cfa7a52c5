#include "validity/shared.h"

#include "analysis/plan/plan.h"
#include "base/error.h"
#include "base/version.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace obscura {

namespace {

using Json = nlohmann::json;
using Planned = std::map<std::string, double>; // power, by claim

constexpr const char* plannedName = "power as planned";

Json toJson(const Rate& rate) { return {rate.hits, rate.of}; }

Json toJson(const std::map<std::string, Rate>& rates) {
    Json json = Json::object();
    for (const auto& [name, rate] : rates)
        json[name] = toJson(rate);
    return json;
}

Rate rateFrom(const Json& json) { return {json.at(0), json.at(1)}; }

std::map<std::string, Rate> ratesFrom(const Json& json) {
    std::map<std::string, Rate> rates;
    for (const auto& [name, rate] : json.items())
        rates[name] = rateFrom(rate);
    return rates;
}

int blockOf(const ValidityOptions& options) {
    return options.block > 0 ? options.block : std::max(100, options.studies / 100);
}

// All that decides results; where they lie and how many threads there are does not.
std::string aboutOf(const ValidityOptions& options) {
    const nlohmann::ordered_json about = {{"formatVersion", 1},        {"program", version()},
                                          {"code", validityCode()},    {"studies", options.studies},
                                          {"seed", options.seed},      {"block", blockOf(options)},
                                          {"planned", options.planned}};
    return about.dump(2) + "\n";
}

std::vector<Block> blocksOf(const World& world, const ValidityOptions& options) {
    const int studies = world.studies(options.studies), size = world.studies(blockOf(options));
    std::vector<Block> blocks;
    for (int first = 0; first < studies; first += size)
        blocks.push_back({first, std::min(size, studies - first)});
    return blocks;
}

std::string nameOf(const World& world, const Block& block) {
    return fmt::format("{}, studies {} to {}", world.name, block.first + 1,
                       block.first + block.studies);
}

std::vector<Task> tasksOf(const std::vector<World>& all, const ValidityOptions& options) {
    std::vector<Task> tasks;
    for (const World& world : all) {
        for (const Block& block : blocksOf(world, options))
            tasks.push_back({{nameOf(world, block), std::string(world.name),
                              static_cast<double>(block.studies * world.fewer)},
                             [&world, &options, block] {
                                 return outcomesText(outcomesOf(
                                     StudySimulator(world.protocol()), world, block, options.seed,
                                     options.memory.string(), options.threads));
                             }});
        if (world.name == "effect")
            tasks.push_back(
                {{plannedName, plannedName, options.planned / 10.0},
                 [&world, &options] { return Json(plannedPower(world, options.planned)).dump(); }});
    }
    return tasks;
}

} // namespace

std::map<std::string, double> plannedPower(const World& world, int studies) {
    Protocol protocol = world.protocol();
    for (std::size_t i = 0; i < protocol.conditions.size(); ++i)
        protocol.conditions[i].simulated.chooseB = world.truth.shares[i];
    PlanOptions options;
    options.participants = world.people;
    options.spread = world.truth.spread;
    options.studies = studies;
    const Plan plan = planOf(protocol, options);
    std::map<std::string, double> planned;
    for (const StatedPower& stated : plan.stated)
        for (std::size_t i = 0; stated.people == world.people && i < plan.tests.size(); ++i)
            planned[plan.tests[i].claim.name] = stated.supported[i].share;
    return planned;
}

std::string outcomesText(const Outcomes& outcomes) {
    return Json{{"rejected", toJson(outcomes.rejected)},
                {"covered", toJson(outcomes.covered)},
                {"anyClaim", toJson(outcomes.anyClaim)},
                {"supported", toJson(outcomes.supported)}}
        .dump();
}

Outcomes readOutcomes(const std::string& text) {
    try {
        const Json json = Json::parse(text);
        return {ratesFrom(json.at("rejected")), ratesFrom(json.at("covered")),
                rateFrom(json.at("anyClaim")), ratesFrom(json.at("supported"))};
    } catch (const Json::exception& error) {
        throw Error(fmt::format("expected outcomes of simulated studies, found \"{}\" ({})",
                                text.substr(0, 60), error.what()));
    }
}

std::string sharedValidityPage(const ValidityOptions& options, const TaskProgress& progress) {
    const std::vector<World> all = worlds();
    const std::vector<Task> tasks = tasksOf(all, options);
    Units units(options.share, aboutOf(options), unitsOf(tasks));
    doTasks(units, tasks, progress);
    std::vector<Outcomes> outcomes(all.size());
    for (std::size_t i = 0; i < all.size(); ++i)
        for (const Block& block : blocksOf(all[i], options))
            outcomes[i].add(readOutcomes(units.result(nameOf(all[i], block)).value()));
    const Planned planned = Json::parse(units.result(plannedName).value()).get<Planned>();
    return validityPage(all, outcomes, planned, options.studies, options.seed);
}

} // namespace obscura
