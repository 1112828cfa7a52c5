#include "stimuli/generate.h"

#include "base/files.h"
#include "base/tasks.h"
#include "image/canvas.h"
#include "stimuli/boost.h"
#include "stimuli/contact_sheet.h"
#include "stimuli/earlier.h"
#include "stimuli/image_files.h"
#include "stimuli/measurements.h"
#include "stimuli/unit_plan.h"
#include "stimuli/warnings.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>

namespace obscura {

namespace fs = std::filesystem;

namespace {

double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

std::map<std::string, std::vector<Recipe>> byView(const std::vector<Recipe>& recipes) {
    std::map<std::string, std::vector<Recipe>> result;
    for (const Recipe& recipe : recipes)
        result[recipe.view.name].push_back(recipe);
    return result;
}

class Generation {
  public:
    Generation(const Protocol& protocol, const Folders& folders, fs::path folder, bool layers,
               const gl::Driver& driver, const Announce& announce, std::string_view code);
    GenerateResult run();

  private:
    std::vector<Task> tasks();
    bool stands(const std::string& unit, const std::string& result) const;
    void tell(int more, const std::string& note);

    std::string made(const PlannedCondition& planned);
    ImageRecord imageOf(const PlannedCondition& planned, std::size_t member, bool& anew);
    std::string timed();
    std::string assembled();

    Manifest gathered() const;
    Manifest inOrder(Manifest manifest) const;

    const Protocol& protocol_;
    fs::path folder_;
    const gl::Driver& driver_;
    const Announce& announce_;
    GenerateResult result_;
    Earlier earlier_;
    UnitPlan plan_;
    std::vector<Recipe> recipes_; // of all images
    std::vector<Task> tasks_;
    std::optional<Units> units_;
    RecipeRenderer renderer_;
    std::optional<Measurements> measurements_;
    Warnings warnings_;
};

Generation::Generation(const Protocol& protocol, const Folders& folders, fs::path folder,
                       bool layers, const gl::Driver& driver, const Announce& announce,
                       std::string_view code)
    : protocol_(protocol), folder_(std::move(folder)), driver_(driver), announce_(announce),
      earlier_(earlierRun(folder_, protocol.display, result_.warnings)),
      plan_(unitPlan(protocol, folders, layers, driver, code, earlier_)), recipes_(plan_.recipes()),
      renderer_(folders), warnings_(protocol, renderer_) {
    removeUnfinishedFiles(folder_);
    tasks_ = tasks();
    units_.emplace(folder_, "stimuli of obscura-stimuli, format 1\n", unitsOf(tasks_),
                   std::chrono::minutes(2),
                   [this](const auto& unit, const auto& result) { return stands(unit, result); });
    measurements_.emplace(protocol, folder_, byView(recipes_), renderer_, *units_,
                          [this] { tell(0, "waiting for a reference"); });
}

std::vector<Task> Generation::tasks() {
    std::vector<Task> tasks;
    for (const PlannedCondition& planned : plan_.conditions) {
        const Condition& condition = protocol_.conditions[planned.condition];
        tasks.push_back({{planned.unit, fmt::format("{}, {}", condition.view, condition.level),
                          static_cast<double>(planned.images.size())},
                         [this, &planned] { return made(planned); }});
    }
    tasks.push_back({{plan_.times, "times"}, [this] { return timed(); }, 1});
    tasks.push_back({{plan_.manifest, "manifest"}, [this] { return assembled(); }, 2});
    return tasks;
}

// Of the result of a condition's unit.
Manifest conditionsOf(const std::string& result) {
    return parseManifest(nlohmann::json::parse(result).at("manifest").dump(), "units");
}

// Whether the files of a result are there, byte for byte.
bool Generation::stands(const std::string& unit, const std::string& result) const {
    if (unit == plan_.times)
        return true;
    if (unit != plan_.manifest)
        return intact(folder_, conditionsOf(result));
    const fs::path file = folder_ / manifestName;
    return fs::exists(file) && readFile(file) == result &&
           intact(folder_, parseManifest(result, file));
}

// `more` images of the condition at hand are done.
void Generation::tell(int more, const std::string& note) {
    const int total = static_cast<int>(recipes_.size());
    announce_(std::min(static_cast<int>(units_->costDone()) + more, total), total, note);
}

ImageRecord Generation::imageOf(const PlannedCondition& planned, std::size_t member, bool& anew) {
    const std::string& file = planned.images[member].file;
    const Recipe& recipe = planned.recipes[member];
    ImageRecord record;
    const ImageRecord* known = earlier_.find(file);
    if (known && proves(*known, recipe, folder_, planned.exrs[member])) {
        record = *known;
    } else {
        anew = true;
        const Rendering rendering = renderer_.render(recipe, planned.exrs[member]);
        const double start = seconds();
        record = written(rendering, file, folder_, planned.exrs[member]);
        result_.writing += seconds() - start;
        ++result_.rendered;
    }
    const Role& role = protocol_.conditions[planned.condition].roles[member];
    record.role = role.name;
    record.name = role.technique;
    record.recipe = recipe;
    return record;
}

std::string Generation::made(const PlannedCondition& planned) {
    const Condition& condition = protocol_.conditions[planned.condition];
    ConditionRecord record = emptyCondition(protocol_, condition);
    std::vector<std::string> found;
    bool anew = false;
    for (std::size_t i = 0; i < planned.images.size(); ++i) {
        tell(static_cast<int>(i), planned.images[i].file);
        record.images.push_back(imageOf(planned, i, anew));
    }
    checkMatched(record, condition.place);
    measurements_->addQuality(record);
    if (anew) {
        found = ofScene(condition.view, renderer_.sceneWarnings());
        addOnce(found, warnings_.of(condition, planned.recipes));
    }
    Manifest part = emptyManifest(protocol_, folder_);
    part.conditions = {record};
    return nlohmann::json{{"warnings", found},
                          {"manifest", nlohmann::json::parse(manifestText(part))}}
        .dump();
}

// What all conditions' units give, in the order of the protocol, without times.
Manifest Generation::gathered() const {
    Manifest manifest = emptyManifest(protocol_, folder_);
    manifest.conditions.resize(protocol_.conditions.size());
    for (const PlannedCondition& planned : plan_.conditions) {
        ConditionRecord& record = manifest.conditions[planned.condition];
        record = emptyCondition(protocol_, protocol_.conditions[planned.condition]);
        record.images = conditionsOf(units_->result(planned.unit).value()).conditions.at(0).images;
    }
    return inOrder(manifest);
}

// A manifest's file has images by name, the protocol in its own order.
Manifest Generation::inOrder(Manifest manifest) const {
    for (std::size_t i = 0; i < manifest.conditions.size(); ++i) {
        std::deque<ImageRecord> images;
        for (const Role& role : protocol_.conditions[i].roles)
            images.push_back(manifest.conditions[i].image(role.name));
        manifest.conditions[i].images = images;
    }
    return manifest;
}

std::string Generation::timed() {
    Manifest manifest = gathered();
    measurements_->addTimes(manifest, earlier_.manifest, driver_);
    return manifestText(manifest);
}

std::string Generation::assembled() {
    const double start = seconds();
    const Manifest times = inOrder(parseManifest(units_->result(plan_.times).value(), folder_));
    Manifest manifest = gathered();
    manifest.timing = times.timing;
    for (std::size_t i = 0; i < manifest.conditions.size(); ++i)
        for (std::size_t j = 0; j < manifest.conditions[i].images.size(); ++j)
            manifest.conditions[i].images[j].milliseconds =
                times.conditions[i].images[j].milliseconds;
    if (protocol_.boost)
        boostImages(protocol_, manifest);
    const std::vector<Image8> sheets = contactSheets(manifest);
    for (std::size_t i = 0; i < sheets.size(); ++i)
        manifest.contactSheets.push_back(
            writtenPng(folder_, pageName("contact-sheet", i, sheets.size()), sheets[i]));
    writeManifest(folder_ / manifestName, manifest);
    result_.writing += seconds() - start;
    return manifestText(manifest);
}

GenerateResult Generation::run() {
    std::vector<const PlannedCondition*> anew; // since this run began, whoever does it
    for (const PlannedCondition& planned : plan_.conditions)
        if (!units_->isDone(planned.unit))
            anew.push_back(&planned);
    doTasks(*units_, tasks_, [&](double, const std::string& note) { tell(0, note); });
    result_.manifest =
        inOrder(parseManifest(units_->result(plan_.manifest).value(), folder_ / manifestName));
    for (const PlannedCondition* planned : anew)
        addOnce(result_.warnings, nlohmann::json::parse(units_->result(planned->unit).value())
                                      .at("warnings")
                                      .get<std::vector<std::string>>());
    result_.kept = static_cast<int>(recipes_.size()) - result_.rendered;
    result_.times = renderer_.times();
    result_.measuring = measurements_->seconds();
    return std::move(result_);
}

} // namespace

GenerateResult generate(const Protocol& protocol, const Folders& folders, const fs::path& folder,
                        bool layers, const gl::Driver& driver, const Announce& announce,
                        std::string_view code) {
    return Generation(protocol, folders, folder, layers, driver, announce, code).run();
}

} // namespace obscura
