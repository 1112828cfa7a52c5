#include "protocols/reader/design_facts.h"

#include "protocols/reader/claims.h"

#include <nlohmann/json.hpp>

namespace obscura {

namespace {

using nlohmann::json;

const json& at(const json& object, const char* key) {
    static const json nothing;
    const auto found = object.is_object() ? object.find(key) : object.end();
    return object.is_object() && found != object.end() ? *found : nothing;
}

std::string textOf(const json& value) {
    return value.is_string() ? value.get<std::string>() : std::string();
}

std::vector<std::string> textsOf(const json& list) {
    std::vector<std::string> texts;
    for (const json& one : list)
        texts.push_back(textOf(one));
    return texts;
}

DesignFacts::Shown shownOf(const json& condition) {
    DesignFacts::Shown shown;
    if (const json& pair = at(condition, "pair"); pair.is_array() && pair.size() == 2)
        shown.techniques = {{"a", textOf(pair[0])}, {"b", textOf(pair[1])}};
    for (const auto& [role, technique] : at(condition, "roles").items())
        shown.techniques[role] = textOf(technique);
    return shown;
}

DesignFacts::Asked askedOf(const json& question, const json& phase) {
    DesignFacts::Asked asked;
    if (const json& kind = at(question, "kind"); kind.is_number_integer())
        asked.kind = static_cast<Question::Kind>(kind.get<int>());
    asked.images = at(question, "images") == true;
    asked.options = static_cast<int>(at(question, "options").size());
    if (const json& lowest = at(question, "lowest"); lowest.is_number_integer())
        asked.lowest = lowest.get<int>();
    asked.beside = textsOf(at(phase, "images"));
    return asked;
}

} // namespace

DesignFacts designFacts(std::string_view design, const std::string& file) {
    DesignFacts facts;
    const Declared declared = declaredIn(design, file); // throws where it is no JSON
    facts.order = declared.order;
    const json parsed = json::parse(design).at("design");
    for (const auto& [id, condition] : at(parsed, "conditions").items())
        facts.conditions[id] = shownOf(condition);
    for (const auto& [id, correct] : declared.correct)
        facts.conditions[id].correct = correct;
    const json& trial = at(parsed, "trial");
    facts.roles = textsOf(at(trial, "roles"));
    const json& phases = at(trial, "phases");
    for (const std::string& phase : textsOf(at(phases, "order"))) {
        const json& shown = at(phases, phase.c_str());
        const json& questions = at(shown, "questions");
        for (const std::string& question : textsOf(at(questions, "order")))
            facts.questions[question] = askedOf(at(questions, question.c_str()), shown);
    }
    facts.boostReference = textOf(at(at(parsed, "boost"), "reference"));
    facts.isAdaptive = textOf(at(at(parsed, "ordering"), "scheme")) == "staircase";
    return facts;
}

} // namespace obscura
