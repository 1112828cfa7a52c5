#include "protocols/reader/design.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <set>

namespace obscura {

namespace {

using nlohmann::json;

// Each struct is taken apart into all its fields, so that a new field does not compile until it has
// been given to one of the parts.

json toJson(const Camera& camera) {
    const auto& [position, target, up, fovDegrees, near] = camera;
    return {{"position", position},
            {"target", target},
            {"up", up},
            {"fovDegrees", fovDegrees},
            {"near", near}};
}

json toJson(const Ground& ground) {
    const auto& [wall, colour] = ground;
    return {{"wall", wall}, {"colour", colour}};
}

json toJson(const View& view) {
    const auto& [name, file, builtin, camera, radius, exposure, ground, place] = view;
    json result = {{"camera", toJson(camera)}, {"radius", radius}, {"exposure", exposure}};
    result[file.empty() ? "builtin" : "file"] = file.empty() ? builtin : file;
    if (ground)
        result["ground"] = toJson(*ground);
    return result;
}

json toJson(const Sky& sky) {
    const auto& [zenith, horizon, ground] = sky;
    return {{"zenith", zenith}, {"horizon", horizon}, {"ground", ground}};
}

json toJson(const Sun& sun) {
    const auto& [azimuthDegrees, elevationDegrees, irradiance] = sun;
    return {{"azimuthDegrees", azimuthDegrees},
            {"elevationDegrees", elevationDegrees},
            {"irradiance", irradiance}};
}

json toJson(const Level& level) {
    const auto& [name, ambient, background, sky, environment, sun, sceneLights, curve, white,
                 occludeDirect, place] = level;
    json result = {{"curve", curveNames()[static_cast<std::size_t>(curve)]},
                   {"white", white},
                   {"occludeDirect", occludeDirect}};
    if (ambient) {
        result["ambient"] = *ambient;
        result["background"] = background;
    }
    if (sky)
        result["sky"] = toJson(*sky);
    if (!environment.empty())
        result["environment"] = environment;
    if (sun)
        result["sun"] = toJson(*sun);
    if (sceneLights) // designs without stay the same
        result["sceneLights"] = true;
    return result;
}

json toJson(const TechniqueSetting& setting) {
    const auto& [name, technique, settings, place, preset] = setting;
    json result = {{"technique", technique}};
    for (const Setting& one : settings) {
        const auto& [key, value, ownPlace] = one;
        result[key] = value;
    }
    if (preset)
        result["preset"] = preset->name;
    return result;
}

json toJson(const ExGaussian& time) {
    const auto& [mean, deviation, tail] = time;
    return {{"mean", mean}, {"deviation", deviation}, {"tail", tail}};
}

json toJson(const Texts& texts) {
    json words;
    for (const TextKey& key : textKeys())
        words[std::string(key.name)] = texts.*key.text;
    words.update(json(texts.own));
    if (!texts.language.empty())
        words["language"] = texts.language;
    if (!texts.name.empty())
        words["name"] = texts.name;
    return words;
}

json toJson(const Adaptive& adaptive) {
    const auto& [trials, width, answer, scores, guess] = adaptive;
    return {{"trials", trials},
            {"width", width},
            {"answer", answer},
            {"scores", scores},
            {"guess", guess}};
}

// All that decides an order, and of that only what differs from how it was before there was a
// choice: the designs of studies that run must not change. The planned number of participants
// and how long sessions can be gone on with decide none.
json toJson(const Ordering& ordering) {
    const auto& [scheme, participants, resumeMinutes, repeats, blocks, apart, practice, catches,
                 catchEvery, breakEvery, staircase, adaptive] = ordering;
    const auto& [down, up, reversals, trials, answer] = staircase;
    const auto nameOf = [](Likeness one) { return likenessNames()[static_cast<std::size_t>(one)]; };
    json result = {{"scheme", orderSchemeNames()[static_cast<std::size_t>(scheme)]}};
    if (repeats != 1)
        result["repeats"] = repeats;
    if (blocks)
        result["blocks"] = nameOf(*blocks);
    if (apart)
        result["apart"] = nameOf(*apart);
    if (!practice.empty())
        result["practice"] = practice;
    if (!catches.empty())
        result.update({{"catch", catches}, {"catchEvery", catchEvery}});
    if (breakEvery)
        result["breakEvery"] = breakEvery;
    if (scheme == OrderScheme::staircase)
        result.update({{"down", down},
                       {"up", up},
                       {"reversals", reversals},
                       {"trials", trials},
                       {"answer", answer}});
    if (scheme == OrderScheme::quest || scheme == OrderScheme::information)
        result["adaptive"] = toJson(adaptive);
    return result;
}

json toJson(const Question& question) {
    const auto& [name, kind, text, options, images, beside, unsure, lowest, least, most, low, high,
                 optional, endsUnless, place] = question; // `beside` follows from the phases
    json result = {{"kind", static_cast<int>(kind)},
                   {"text", text},
                   {"options", options},
                   {"images", images},
                   {"unsure", unsure},
                   {"lowest", lowest},
                   {"range", {least, most}},
                   {"ends", {low, high}},
                   {"optional", optional}};
    if (!endsUnless.empty())
        result["endsUnless"] = endsUnless;
    return result;
}

// Lists are kept by name and place, so that what differs is told by name.
json toJson(const std::vector<Phase>& phases) {
    json result = {{"order", json::array()}};
    for (const Phase& phase : phases) {
        const auto& [name, images, alternate, turns, grey, text, progress, questions, key, atLeast,
                     seconds, frames, place] = phase;
        json asked = {{"order", json::array()}};
        for (const Question& question : questions) {
            asked["order"].push_back(question.name);
            asked[question.name] = toJson(question);
        }
        result["order"].push_back(name);
        result[name] = {{"images", images}, {"alternate", alternate}, {"grey", grey},
                        {"text", text},     {"progress", progress},   {"questions", asked},
                        {"key", key},       {"atLeast", atLeast},     {"seconds", seconds},
                        {"frames", frames}};
        if (static_cast<int>(images.size()) > turns && turns > 1) // at several places
            result[name]["turns"] = turns;
    }
    return result;
}

// The shorthand as it has always been written, so that a study goes on under a later version.
json toJson(const Trial& trial) {
    const auto& [mask, grey, minimumView, given, order] = trial;
    if (!given.empty())
        return {{"grey", grey}, {"phases", toJson(given)}, {"roles", order}};
    return {{"mask", mask}, {"grey", grey}, {"minimumView", minimumView}};
}

// Of the scenes in use.
json toJson(const Boost& boost, const std::set<std::string>& views) {
    const auto& [reference, amplify, magnify, crop] = boost;
    json result = {{"reference", reference}, {"amplify", amplify}, {"magnify", magnify}};
    for (const auto& [view, corner] : crop)
        if (views.contains(view))
            result["crop"][view] = corner;
    return result;
}

// Conditions are kept by their ids, because pictures do not depend on their order.
struct SplitConditions {
    json stimuli = json::object(), simulated = json::object(), order = json::array();
    json correct = json::object();                   // where there is a right answer
    std::set<std::string> views, levels, techniques; // used
};

// A pair as it has always been written, so that a study goes on under a later version.
void addRoles(json& condition, const std::vector<Role>& roles) {
    if (roles.size() == 2 && roles[0].name == "a" && roles[1].name == "b")
        condition["pair"] = {roles[0].technique, roles[1].technique};
    else
        for (const Role& role : roles)
            condition["roles"][role.name] = role.technique;
}

SplitConditions split(const std::vector<Condition>& conditions) {
    SplitConditions result;
    for (const Condition& condition : conditions) {
        const auto& [id, view, level, hypothesis, roles, simulated, correct, place] = condition;
        result.stimuli[id] = {{"scene", view}, {"level", level}, {"hypothesis", hypothesis}};
        addRoles(result.stimuli[id], roles);
        result.simulated[id] = {{"simulatedPreference", simulated.chooseB}};
        result.order.push_back(id);
        if (!correct.empty())
            result.correct[id] = correct;
        result.views.insert(view);
        result.levels.insert(level);
        for (const Role& role : roles)
            result.techniques.insert(role.technique);
    }
    return result;
}

// Puts what is declared, by name, into the part for what conditions use or into that for the rest.
template <typename T>
void split(const std::vector<T>& items, const std::set<std::string>& used, const char* key,
           json& ifUsed, json& otherwise) {
    for (const T& item : items)
        (used.contains(item.name) ? ifUsed : otherwise)[key][item.name] = toJson(item);
}

json toJson(const ScreenNeeds& needs) {
    const auto& [distanceCm, degrees, pixelsPerDegree] = needs;
    json result = {{"distanceCm", distanceCm}};
    if (degrees)
        result["degrees"] = *degrees;
    if (pixelsPerDegree)
        result["pixelsPerDegree"] = {{"min", (*pixelsPerDegree)[0]},
                                     {"max", (*pixelsPerDegree)[1]}};
    return result;
}

json toJson(const Display& display) {
    const auto& [name, width, height, diagonalInches, distance, peak, contrast, ambient] = display;
    return {{"name", name},         {"width", width},
            {"height", height},     {"diagonalInches", diagonalInches},
            {"distance", distance}, {"peak", peak},
            {"contrast", contrast}, {"ambient", ambient}};
}

json toJson(const Claim& claim) {
    const auto& [name, kind, conditions, favours, margin, scores, family, place] = claim;
    return {{"name", name},
            {"kind", claimKindNames()[static_cast<std::size_t>(kind)]},
            {"conditions", conditions},
            {"favours", favours},
            {"margin", margin},
            {"scores", scores},
            {"family", family}};
}

json toJson(const ExclusionRules& rules) {
    const auto& [catches, onePosition, fastest, incomplete, interrupted, wrongMasks, voided] =
        rules;
    return {{"catches", catches},       {"onePosition", onePosition}, {"fastest", fastest},
            {"incomplete", incomplete}, {"interrupted", interrupted}, {"wrongMasks", wrongMasks},
            {"voided", voided}};
}

std::vector<std::string> spelt(const std::vector<int>& keys) {
    std::vector<std::string> names;
    for (const int key : keys)
        names.emplace_back(nameOfKey(key));
    return names;
}

struct Parts {
    json stimuli, procedure, texts;
};

Parts split(const Protocol& protocol) {
    const auto& [name, title, seed, width, height, antialiasing, normals, views, levels, techniques,
                 includes, conditions, boost, trial, before, after, keys, screen, display, ordering,
                 claims, exclusions, words, translations, simulation, path, sha256] = protocol;
    const auto& [positionBias, lapse, viewTime, decision] = simulation;
    const SplitConditions parts = split(conditions);

    Parts result;
    result.stimuli = {
        {"seed", seed},
        {"image", {{"width", width}, {"height", height}, {"antialiasing", antialiasing}}},
        {"normals", normalsNames()[static_cast<std::size_t>(normals)]},
        {"conditions", parts.stimuli}};
    if (boost)
        result.stimuli["boost"] = toJson(*boost, parts.views);
    result.procedure = {{"trial", toJson(trial)},
                        {"ordering", toJson(ordering)},
                        {"order of conditions", parts.order}};
    if (screen.distanceCm > 0)
        result.procedure["screen"] = toJson(screen);
    if (!(keys == Keys())) // which hand does what
        result.procedure["keys"] = {
            {"first", spelt(keys.first)}, {"second", spelt(keys.second)}, {"go", spelt(keys.go)}};
    // Who takes part, and what they have been asked before: studies that ask nothing keep theirs.
    if (!before.empty())
        result.procedure["before"] = toJson(before);
    if (!after.empty())
        result.procedure["after"] = toJson(after);
    // What is claimed must not change once answers are known.
    for (const Claim& claim : claims)
        result.procedure["claims"].push_back(toJson(claim));
    if (!(exclusions == ExclusionRules()))
        result.procedure["exclusions"] = toJson(exclusions);
    if (!parts.correct.empty())
        result.procedure["correct answers"] = parts.correct;
    result.texts = {
        {"name", name},
        {"title", title},
        {"texts", toJson(words)},
        {"ordering",
         {{"participants", ordering.participants}, {"resumeMinutes", ordering.resumeMinutes}}},
        {"simulation",
         {{"positionBias", positionBias},
          {"view", toJson(viewTime)},
          {"decision", toJson(decision)}}},
        {"conditions", parts.simulated}};
    if (lapse > 0) // studies without keep their hash
        result.texts["simulation"]["lapse"] = lapse;
    if (!(display == displays().front())) // it only predicts
        result.texts["display"] = toJson(display);
    for (const Texts& translation : translations)
        result.texts["languages"][translation.language] = toJson(translation);
    split(views, parts.views, "scenes", result.stimuli, result.texts);
    split(levels, parts.levels, "levels", result.stimuli, result.texts);
    split(techniques, parts.techniques, "techniques", result.stimuli, result.texts);
    return result;
}

// A value as a person reads it: 2, not 2.0, and of a hash only its beginning.
std::string spell(const json& value) {
    if (value.is_number_float())
        return fmt::format("{}", value.get<double>());
    const std::string text = value.dump();
    return value.is_string() && text.size() > 60 ? text.substr(0, 13) + "...\"" : text;
}

void compare(const json& before, const json& now, const std::string& path,
             std::vector<std::string>& found) {
    if (before == now)
        return;
    if (!before.is_object() || !now.is_object()) {
        found.push_back(fmt::format("{} was {}, is now {}", path, spell(before), spell(now)));
        return;
    }
    json keys = before;
    keys.update(now);
    for (const auto& [key, ignored] : keys.items()) {
        const std::string inner = path.empty() ? key : fmt::format("{}.{}", path, key);
        if (!now.contains(key))
            found.push_back(inner + " is gone");
        else if (!before.contains(key))
            found.push_back(inner + " is new");
        else
            compare(before[key], now[key], inner, found);
    }
}

} // namespace

ProtocolParts partsOf(const Protocol& protocol) {
    const Parts parts = split(protocol);
    return {parts.stimuli.dump(), parts.procedure.dump(), parts.texts.dump()};
}

std::string designOf(const Protocol& protocol) {
    Parts parts = split(protocol);
    parts.stimuli.update(parts.procedure);
    return parts.stimuli.dump();
}

std::vector<std::string> differences(std::string_view before, std::string_view now) {
    std::vector<std::string> found;
    compare(json::parse(before), json::parse(now), "", found);
    return found;
}

} // namespace obscura
