#include "protocols/reader/claims.h"

#include "base/files.h"
#include "protocols/reader/study_parts.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
#include <tuple>

namespace obscura {

namespace {

using Conditions = std::vector<ClaimedCondition>;

const ClaimedCondition& conditionOf(const PlacedText& id, const Conditions& conditions) {
    std::vector<std::string> known;
    for (const ClaimedCondition& condition : conditions) {
        if (condition.id == id.text && !condition.isPair)
            throw Error(id.place, fmt::format("expected a condition of a pair, whose images are a "
                                              "and b, found \"{}\", which has others",
                                              id.text));
        if (condition.id == id.text)
            return condition;
        known.push_back(condition.id);
    }
    throw Error(id.place, fmt::format("expected the id of a condition, found \"{}\"{}", id.text,
                                      suggestion(id.text, known)));
}

void refuse(TomlTable& table, const char* key, const Claim& claim) {
    if (table.has(key))
        throw Error(table.placeOf(key),
                    fmt::format("means nothing to a claim of kind \"{}\"; "
                                "remove it, or choose another kind",
                                claimKindNames()[static_cast<std::size_t>(claim.kind)]));
}

// Without scores, levels count 1, 2, 3 in the order in which the claim names them.
std::vector<double> parseScores(TomlTable& table, const std::vector<std::string>& levels) {
    std::vector<double> scores;
    if (table.has("scores")) {
        scores = table.numbers("scores", -1e9, 1e9);
        if (scores.size() != levels.size())
            throw Error(table.placeOf("scores"),
                        fmt::format("expected a number for each of the {} conditions, found {}",
                                    levels.size(), scores.size()));
    } else {
        std::vector<std::string> known;
        for (const std::string& level : levels) {
            auto at = std::find(known.begin(), known.end(), level);
            if (at == known.end())
                at = known.insert(known.end(), level);
            scores.push_back(static_cast<double>(at - known.begin()) + 1);
        }
    }
    if (std::equal(scores.begin() + 1, scores.end(), scores.begin()))
        throw Error(table.placeOf(table.has("scores") ? "scores" : "conditions"),
                    "expected conditions of at least two levels, or different scores, for a trend; "
                    "found all alike");
    return scores;
}

void parseConditions(TomlTable& table, const Conditions& conditions, Claim& claim) {
    std::vector<std::string> levels;
    for (const PlacedText& id : table.requiredTexts("conditions", "a list of ids of conditions")) {
        if (std::find(claim.conditions.begin(), claim.conditions.end(), id.text) !=
            claim.conditions.end())
            throw Error(id.place,
                        fmt::format("expected each condition once, found \"{}\" again", id.text));
        levels.push_back(conditionOf(id, conditions).level);
        claim.conditions.push_back(id.text);
    }
    if (claim.kind == Claim::Kind::trend)
        claim.scores = parseScores(table, levels);
    else
        refuse(table, "scores", claim);
}

std::string parsePhrase(TomlTable& table, std::string_view key, std::optional<std::string> absent) {
    std::string text = table.text(key, std::move(absent));
    const bool plain =
        std::none_of(text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 127; });
    if (table.has(key) && (text.empty() || text.size() > 200 || !plain))
        throw Error(table.placeOf(key),
                    fmt::format("expected a phrase of 1 to 200 bytes on one line, found {}",
                                text.empty() ? "nothing" : "a text of another kind"));
    return text;
}

Claim parseClaim(TomlTable table, const Conditions& conditions) {
    Claim claim;
    claim.place = table.place();
    claim.name = parsePhrase(table, "name", std::nullopt);
    if (!table.has("kind"))
        (void)table.text("kind"); // says that it is missing
    claim.kind = static_cast<Claim::Kind>(table.choice("kind", claimKindNames(), 0));
    claim.family = parsePhrase(table, "family", "");
    parseConditions(table, conditions, claim);
    if (claim.kind == Claim::Kind::equivalent) {
        claim.margin = table.number("margin", 0.01, 0.49);
        refuse(table, "favours", claim);
    } else {
        claim.favours = table.choice("favours", {"a", "b"}, 1) == 0 ? "a" : "b";
        refuse(table, "margin", claim);
    }
    table.finish();
    return claim;
}

auto told(const Claim& claim) {
    return std::tie(claim.name, claim.kind, claim.conditions, claim.favours, claim.margin,
                    claim.scores, claim.family);
}

} // namespace

bool Claim::operator==(const Claim& other) const { return told(*this) == told(other); }

const std::vector<std::string>& claimKindNames() {
    static const std::vector<std::string> names = {"superior", "equivalent", "trend"};
    return names;
}

std::vector<Claim> parseClaims(TomlTable& root, const Conditions& conditions) {
    std::vector<Claim> claims;
    if (!root.has("claims"))
        return claims;
    std::set<std::string> names;
    for (TomlTable& table : root.list("claims", "a list of tables, [[claims]]")) {
        Claim claim = parseClaim(std::move(table), conditions);
        if (!names.insert(claim.name).second)
            throw Error(claim.place,
                        fmt::format("expected a new name, found \"{}\" again", claim.name));
        claims.push_back(std::move(claim));
    }
    return claims;
}

ExclusionRules parseExclusions(TomlTable table) {
    ExclusionRules rules;
    rules.catches = table.number("catches", 0, 1, rules.catches);
    rules.onePosition = table.number("onePosition", 0.5, 1, rules.onePosition);
    rules.fastest = table.number("fastest", 0, 10, rules.fastest);
    rules.incomplete = table.flag("incomplete", rules.incomplete);
    rules.interrupted = table.flag("interrupted", rules.interrupted);
    rules.wrongMasks = table.flag("wrongMasks", rules.wrongMasks);
    rules.voided = table.flag("voided", rules.voided);
    table.finish();
    return rules;
}

namespace {

using nlohmann::json;

Claim claimOf(const json& one) {
    const std::string kind = one.at("kind");
    const auto& kinds = claimKindNames();
    const auto at = std::find(kinds.begin(), kinds.end(), kind);
    if (at == kinds.end())
        throw Error(fmt::format("\"{}\" is no kind of claim", kind));
    Claim claim;
    one.at("name").get_to(claim.name);
    claim.kind = static_cast<Claim::Kind>(at - kinds.begin());
    one.at("conditions").get_to(claim.conditions);
    one.at("favours").get_to(claim.favours);
    one.at("margin").get_to(claim.margin);
    one.at("scores").get_to(claim.scores);
    one.at("family").get_to(claim.family);
    return claim;
}

Declared declaredOf(const json& design) {
    Declared declared;
    declared.sha256 = sha256(design.dump());
    declared.order = design.value("order of conditions", std::vector<std::string>());
    for (const json& one : design.value("claims", json::array()))
        declared.claims.push_back(claimOf(one));
    declared.correct = design.value("correct answers", std::map<std::string, std::string>());
    if (const auto found = design.find("exclusions"); found != design.end()) {
        ExclusionRules& rules = declared.exclusions;
        found->at("catches").get_to(rules.catches);
        found->at("onePosition").get_to(rules.onePosition);
        found->at("fastest").get_to(rules.fastest);
        found->at("incomplete").get_to(rules.incomplete);
        found->at("interrupted").get_to(rules.interrupted);
        found->at("wrongMasks").get_to(rules.wrongMasks);
        found->at("voided").get_to(rules.voided);
    }
    return declared;
}

} // namespace

Declared declaredIn(std::string_view text, const std::string& file) {
    std::string why = "it is no JSON object with a design";
    try {
        const json kept = json::parse(text, nullptr, false);
        if (kept.is_object() && kept.contains("design") && kept["design"].is_object())
            return declaredOf(kept["design"]);
    } catch (const std::exception& fault) {
        why = fault.what();
    }
    throw Error({file, 0, 0, {}},
                fmt::format("expected a study's design in JSON as obscura-experiment wrote it, "
                            "found another text ({}); put the original back, or remove the file",
                            why));
}

} // namespace obscura
