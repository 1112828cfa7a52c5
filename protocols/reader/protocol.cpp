#include "protocols/reader/protocol.h"

#include "base/files.h"
#include "protocols/reader/languages.h"
#include "protocols/reader/study_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <set>

namespace obscura {

namespace {

template <typename T>
const T& find(const std::vector<T>& items, const std::string& name) {
    return *std::find_if(items.begin(), items.end(),
                         [&](const T& item) { return item.name == name; });
}

// A name of something declared elsewhere in the file.
template <typename T>
std::string reference(TomlTable& table, std::string_view key, const std::vector<T>& items,
                      std::string_view kind) {
    std::string name = table.text(key);
    mustExist(table.placeOf(*table.node(key), table.pathOf(key)), name, items, kind);
    return name;
}

Sky parseSky(TomlTable table) {
    Sky sky;
    sky.zenith = table.triple("zenith", 0, 1e3, sky.zenith);
    sky.horizon = table.triple("horizon", 0, 1e3, sky.horizon);
    sky.ground = table.triple("ground", 0, 1e3, sky.ground);
    table.finish();
    return sky;
}

Sun parseSun(TomlTable table) {
    Sun sun;
    sun.azimuthDegrees = table.number("azimuthDegrees", -360, 360);
    sun.elevationDegrees = table.number("elevationDegrees", 0.5, 90);
    sun.irradiance = table.triple("irradiance", 0, 1e4, sun.irradiance);
    table.finish();
    return sun;
}

} // namespace

Level parseLevel(const std::string& name, TomlTable table) {
    Level level;
    level.name = name;
    level.place = table.place();
    const bool constant = table.has("ambient"), sky = table.has("sky"),
               image = table.has("environment");
    if (constant + sky + image != 1)
        throw Error(level.place, fmt::format("expected exactly one of \"ambient\", \"sky\" and "
                                             "\"environment\", found {}",
                                             constant + sky + image == 0 ? "none" : "several"));
    if (constant) {
        level.ambient = table.triple("ambient", 0, 1e3);
        level.background = table.triple("background", 0, 1, level.background);
    } else if (sky) {
        level.sky = parseSky(*table.table("sky"));
    } else {
        level.environment = table.text("environment");
    }
    if (auto sun = table.table("sun"))
        level.sun = parseSun(std::move(*sun));
    level.sceneLights = table.flag("sceneLights", level.sceneLights);
    level.curve = static_cast<Curve>(
        table.choice("curve", curveNames(),
                     static_cast<std::size_t>(constant ? Curve::clamp : Curve::reinhard)));
    level.white = table.number("white", 0.01, 1e4, level.white);
    level.occludeDirect = table.flag("occludeDirect", level.occludeDirect);
    table.finish();
    return level;
}

namespace {

// An image's technique: a name. It is no table, because a table could only say things that must not
// differ.
std::string parseMember(TomlTable& condition, const toml::node& node, const std::string& key,
                        const Protocol& protocol) {
    const std::string path = condition.pathOf(key);
    const Place place = condition.placeOf(node, path);
    if (const toml::table* table = node.as_table()) {
        for (const auto& [inner, value] : *table)
            if (inner.str() != "technique")
                throw Error(condition.placeOf(value, fmt::format("{}.{}", path, inner.str())),
                            fmt::format("the images of a condition may differ only in the "
                                        "technique; \"{}\" belongs to the condition",
                                        inner.str()));
    }
    const toml::node* named = node.is_table() ? node.as_table()->get("technique") : &node;
    if (!named || !named->is_string())
        throw Error(place, fmt::format("expected the name of a technique under [techniques], "
                                       "found {}",
                                       TomlTable::spell(node)));
    std::string name = *named->value<std::string>();
    mustExist(place, name, protocol.techniques, "a technique under [techniques]");
    return name;
}

std::optional<double> ownRadius(const TechniqueSetting& technique) {
    for (const Setting& setting : technique.settings)
        if (setting.name == "radius")
            return setting.value;
    return std::nullopt;
}

// Of those between which the order decides, no two may be the same; and all reach equally far.
void checkRoles(const Condition& condition, const Protocol& protocol, const Place& place) {
    const double common = protocol.view(condition.view).radius;
    const Role* reaching = nullptr; // the first of a technique with a radius
    for (const Role& role : condition.roles) {
        const TechniqueSetting& technique = protocol.technique(role.technique);
        for (const Role& other : condition.roles)
            if (&other != &role && other.technique == role.technique &&
                isOrdered(protocol.trial, role.name) && isOrdered(protocol.trial, other.name))
                throw Error(place, fmt::format("expected different techniques, found \"{}\" twice",
                                               role.technique));
        if (technique.technique == "none")
            continue;
        if (!reaching)
            reaching = &role;
        const TechniqueSetting& first = protocol.technique(reaching->technique);
        const double one = ownRadius(first).value_or(common),
                     here = ownRadius(technique).value_or(common);
        if (one != here)
            throw Error(place,
                        fmt::format("the images of a condition may differ only in the technique; "
                                    "\"{}\" has radius {} m, \"{}\" {} m. Give both the same, or "
                                    "none, and the scene's radius is used",
                                    first.name, one, technique.name, here));
    }
}

// What the phases show must be there, and what images are boosted against.
void checkShown(const Condition& condition, const Protocol& protocol, const Place& place) {
    std::set<std::string> needed = rolesOf(protocol.trial);
    if (protocol.boost)
        needed.insert(protocol.boost->reference);
    for (const std::string& role : needed)
        if (std::none_of(condition.roles.begin(), condition.roles.end(),
                         [&](const Role& each) { return each.name == role; }))
            throw Error(place,
                        fmt::format("expected an image \"{}\", which the {}, found none", role,
                                    rolesOf(protocol.trial).contains(role)
                                        ? "trial shows"
                                        : "others are boosted against"));
}

void parsePair(TomlTable& table, const toml::node& pair, Condition& condition,
               const Protocol& protocol) {
    const toml::array* members = pair.as_array();
    if (!members || members->size() != 2)
        throw Error(
            table.placeOf(pair, table.pathOf("pair")),
            fmt::format("expected the names of two techniques, found {}", TomlTable::spell(pair)));
    for (std::size_t i = 0; i < 2; ++i)
        condition.roles.push_back(
            {i == 0 ? "a" : "b",
             parseMember(table, *members->get(i), fmt::format("pair[{}]", i + 1), protocol)});
}

void parseRoles(TomlTable& table, Condition& condition, const Protocol& protocol) {
    const toml::node *pair = table.node("pair"), *roles = table.node("roles");
    if ((pair != nullptr) == (roles != nullptr))
        throw Error(table.place(),
                    fmt::format("expected either \"pair\", the names of two techniques, or "
                                "\"roles\", a technique for each image's role, found {}",
                                pair ? "both" : "neither"));
    if (pair) {
        parsePair(table, *pair, condition, protocol);
        return;
    }
    const toml::table* named = roles->as_table();
    if (!named || named->empty())
        throw Error(table.placeOf(*roles, table.pathOf("roles")),
                    fmt::format("expected a technique for each role, such as {{ a = \"none\" }}, "
                                "found {}",
                                TomlTable::spell(*roles)));
    for (const auto& [name, node] : *named) {
        checkName(table, "roles", std::string(name.str()), "", "");
        if (std::isdigit(static_cast<unsigned char>(name.str().front())))
            throw Error(table.placeOf(node, table.pathOf(fmt::format("roles.{}", name.str()))),
                        fmt::format("expected a role that begins with a letter, for numbers are "
                                    "places in the order; found \"{}\"",
                                    name.str()));
        condition.roles.push_back(
            {std::string(name.str()),
             parseMember(table, node, fmt::format("roles.{}", name.str()), protocol)});
    }
}

Condition parseCondition(TomlTable table, const Protocol& protocol) {
    Condition condition;
    condition.place = table.place();
    condition.id = table.text("id");
    checkName(table, "id", condition.id, "-", " and hyphens");
    condition.view = reference(table, "scene", protocol.views, "a scene under [scenes]");
    condition.level = reference(table, "level", protocol.levels, "a level under [levels]");
    condition.hypothesis = table.text("hypothesis", "-");
    condition.simulated.chooseB =
        table.number("simulatedPreference", 0, 1, condition.simulated.chooseB);
    condition.correct = table.text("correct", condition.correct);
    parseRoles(table, condition, protocol);
    const char* const given = table.has("pair") ? "pair" : "roles";
    const Place place = table.placeOf(*table.node(given), table.pathOf(given));
    checkRoles(condition, protocol, place);
    checkShown(condition, protocol, place);
    table.finish();
    return condition;
}

void parseConditions(TomlTable& root, Protocol& protocol) {
    std::set<std::string> ids;
    for (TomlTable& table : root.list("conditions", "at least one [[conditions]] table")) {
        Condition condition = parseCondition(std::move(table), protocol);
        if (!ids.insert(condition.id).second)
            throw Error(condition.place,
                        fmt::format("expected a new id, found \"{}\" again", condition.id));
        protocol.conditions.push_back(std::move(condition));
    }
}

std::vector<ConditionLabels> labelsOf(const Protocol& protocol) {
    std::vector<ConditionLabels> labels;
    labels.reserve(protocol.conditions.size());
    for (const Condition& one : protocol.conditions) {
        labels.push_back({one.id, one.view, one.level, one.correct, {}});
        for (const std::string& shown : protocol.trial.order)
            for (const Role& role : one.roles)
                if (role.name == shown)
                    labels.back().shown.push_back(role.technique);
    }
    return labels;
}

bool contains(const std::vector<std::string>& ids, const std::string& id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

// Main trials, whose answers are counted.
std::vector<ClaimedCondition> claimableOf(const Protocol& protocol) {
    std::vector<ClaimedCondition> claimable;
    for (const Condition& one : protocol.conditions)
        if (!contains(protocol.ordering.practice, one.id) &&
            !contains(protocol.ordering.catches, one.id))
            claimable.push_back(
                {one.id, one.level,
                 one.roles.size() == 2 && one.roles[0].name == "a" && one.roles[1].name == "b"});
    return claimable;
}

ExclusionRules parseExclusions(TomlTable table, const Protocol& protocol) {
    const Place place = table.has("catches") ? table.placeOf("catches") : table.place();
    ExclusionRules rules = parseExclusions(std::move(table));
    const bool answered =
        std::any_of(protocol.conditions.begin(), protocol.conditions.end(), [&](const auto& one) {
            return contains(protocol.ordering.catches, one.id) && !one.correct.empty();
        });
    if (rules.catches > 0 && !answered)
        throw Error(place, "expected catch trials with a right answer (ordering.catch, and "
                           "\"correct\" of their conditions), found none");
    return rules;
}

std::vector<Question> questionsOf(const std::vector<Phase>& phases) {
    std::vector<Question> questions;
    for (const Phase& phase : phases)
        questions.insert(questions.end(), phase.questions.begin(), phase.questions.end());
    return questions;
}

std::set<std::string> textsOf(const Protocol& protocol) {
    std::set<std::string> keys = textsOf(phasesOf(protocol.trial));
    keys.merge(textsOf(protocol.before));
    keys.merge(textsOf(protocol.after));
    return keys;
}

// Where another key than Space goes on, the texts that the study has not written name it.
void nameGo(const Keys& keys, Texts& texts) {
    if (keys.go.front() == Keys().go.front())
        return;
    if (!texts.places.contains("space"))
        texts.space = capOf(keys.go.front());
    if (texts.rest == Texts().rest) // translations of it name no key
        texts.rest = fmt::format("Take a break. Press {} to go on.", texts.space);
}

ExGaussian parseTime(std::optional<TomlTable> table, ExGaussian fallback) {
    if (!table)
        return fallback;
    fallback.mean = table->number("mean", 0, 600, fallback.mean);
    fallback.deviation = table->number("deviation", 0, 600, fallback.deviation);
    fallback.tail = table->number("tail", 0, 600, fallback.tail);
    table->finish();
    return fallback;
}

Simulation parseSimulation(TomlTable table) {
    Simulation simulation;
    simulation.positionBias = table.number("positionBias", -0.5, 0.5, simulation.positionBias);
    simulation.lapse = table.number("lapse", 0, 1, simulation.lapse);
    simulation.view = parseTime(table.table("view"), simulation.view);
    simulation.decision = parseTime(table.table("decision"), simulation.decision);
    table.finish();
    return simulation;
}

void parseImage(TomlTable table, Protocol& protocol) {
    protocol.width = table.integer("width", 16, 8192, protocol.width);
    protocol.height = table.integer("height", 16, 8192, protocol.height);
    protocol.antialiasing = table.integer("antialiasing", 1, 64, protocol.antialiasing);
    table.finish();
}

Protocol parseRoot(TomlTable root, std::string& includedSha256) {
    Protocol protocol;
    protocol.name = root.text("name");
    checkName(root, "name", protocol.name, "-", " and hyphens");
    protocol.title = root.text("title", protocol.name);
    protocol.seed = static_cast<std::uint64_t>(root.integer("seed", 0, 2147483647));
    if (auto image = root.table("image"))
        parseImage(std::move(*image), protocol);
    protocol.normals = parseNormals(root);
    for (auto& [name, table] : root.tables("scenes", "at least one scene, [scenes.NAME]"))
        protocol.views.push_back(parseView(name, std::move(table)));
    for (auto& [name, table] : root.tables("levels", "at least one level, [levels.NAME]"))
        protocol.levels.push_back(parseLevel(name, std::move(table)));
    Techniques techniques = parseTechniques(root);
    protocol.techniques = std::move(techniques.techniques);
    protocol.includes = std::move(techniques.includes);
    includedSha256 = techniques.includedSha256;
    if (auto trial = root.table("trial"))
        protocol.trial = parseTrial(std::move(*trial));
    if (auto boost = root.table("boost"))
        protocol.boost =
            parseBoost(std::move(*boost), protocol.width, protocol.height, protocol.views);
    parseConditions(root, protocol);
    if (auto ordering = root.table("ordering"))
        protocol.ordering =
            parseOrdering(*ordering, labelsOf(protocol), questionsOf(phasesOf(protocol.trial)));
    protocol.claims = parseClaims(root, claimableOf(protocol));
    if (auto exclusions = root.table("exclusions"))
        protocol.exclusions = parseExclusions(std::move(*exclusions), protocol);
    if (auto screen = root.table("screen"))
        protocol.screen = parseScreenNeeds(std::move(*screen));
    const toml::table nothing;
    protocol.display =
        parseDisplay(root.table("display").value_or(TomlTable(nothing, "", "display")),
                     protocol.screen.distanceCm);
    if (auto keys = root.table("keys"))
        protocol.keys = parseKeys(std::move(*keys));
    protocol.before = parsePages(root, "before");
    protocol.after = parsePages(root, "after");
    std::vector<Texts> languages = parseLanguages(root, textsOf(protocol));
    protocol.texts = std::move(languages.front());
    protocol.translations.assign(std::make_move_iterator(languages.begin() + 1),
                                 std::make_move_iterator(languages.end()));
    nameGo(protocol.keys, protocol.texts);
    for (Texts& translation : protocol.translations)
        nameGo(protocol.keys, translation);
    if (auto simulation = root.table("simulation"))
        protocol.simulation = parseSimulation(std::move(*simulation));
    root.finish();
    return protocol;
}

} // namespace

const View& Protocol::view(const std::string& wanted) const { return find(views, wanted); }
const Level& Protocol::level(const std::string& wanted) const { return find(levels, wanted); }
const TechniqueSetting& Protocol::technique(const std::string& wanted) const {
    return find(techniques, wanted);
}

std::vector<const Texts*> Protocol::languages() const {
    std::vector<const Texts*> all = {&texts};
    for (const Texts& translation : translations)
        all.push_back(&translation);
    return all;
}

Protocol parseProtocol(const std::string& text, const std::string& file) {
    const toml::table table = parseToml(text, file);
    std::string includedSha256;
    Protocol protocol = parseRoot(TomlTable(table, file, ""), includedSha256);
    protocol.sha256 = studySha256(text, includedSha256);
    return protocol;
}

Protocol readProtocol(const std::filesystem::path& path) {
    Protocol protocol = parseProtocol(readFile(path), path.string());
    protocol.path = path;
    return protocol;
}

} // namespace obscura
