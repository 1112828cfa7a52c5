#include "protocols/reader/trial.h"

#include "protocols/reader/study_parts.h"
#include "protocols/reader/toml_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

namespace {

const std::vector<std::string> kinds = {"choice", "scale", "slider", "rank", "number", "text"};
constexpr double longest = 3600; // seconds

std::vector<std::string> textsAt(TomlTable& table, std::string_view key) {
    std::vector<std::string> result;
    for (PlacedText& text : table.texts(key, "keys of [texts]"))
        result.push_back(std::move(text.text));
    return result;
}

void parseOptions(TomlTable& table, Question& question) {
    question.options = textsAt(table, "options");
    const std::size_t count = question.options.size();
    if (count < 2 || count > 10)
        throw Error(table.placeOf("options"),
                    fmt::format("expected 2 to 10 options, keys of [texts], found {}", count));
}

void parseRange(TomlTable& table, Question& question) {
    question.least = table.number("least", -1e6, 1e6, question.least);
    question.most = table.number("most", -1e6, 1e6, question.most);
    if (question.least >= question.most)
        throw Error(table.placeOf("most"), fmt::format("expected more than \"least\", {}, found {}",
                                                       question.least, question.most));
}

void parseEndsUnless(TomlTable& table, Question& question) {
    for (PlacedText& option : table.texts("endsUnless", "options, such as [\"agree\"]")) {
        if (std::find(question.options.begin(), question.options.end(), option.text) ==
            question.options.end())
            throw Error(option.place,
                        fmt::format("expected one of the question's options, found "
                                    "\"{}\"{}",
                                    option.text, suggestion(option.text, question.options)));
        question.endsUnless.push_back(std::move(option.text));
    }
    if (!question.endsUnless.empty() && question.optional)
        throw Error(table.placeOf("optional"), "expected no \"optional\" where \"endsUnless\" asks "
                                               "for an answer");
}

Question parseQuestion(TomlTable table) {
    using Kind = Question::Kind;
    Question question;
    question.place = table.place();
    question.name = table.text("name");
    checkName(table, "name", question.name, "-", " and hyphens");
    question.kind = static_cast<Kind>(table.choice("kind", kinds, 0));
    question.text = table.text("text", "");
    question.optional = table.flag("optional", false);
    if (question.kind == Kind::choice || question.kind == Kind::scale) {
        parseOptions(table, question);
        parseEndsUnless(table, question);
    }
    if (question.kind == Kind::choice) {
        question.images = table.flag("images", false);
        question.unsure = table.text("unsure", "");
    }
    if (question.kind == Kind::scale)
        question.lowest = table.integer("lowest", -100, 100, question.lowest);
    if (question.kind == Kind::slider || question.kind == Kind::number)
        parseRange(table, question);
    if (question.kind == Kind::slider) {
        question.low = table.text("low", "");
        question.high = table.text("high", "");
    }
    table.finish();
    return question;
}

// "1" or "reference"; a place may be written as a number.
std::string imageName(const TomlTable& table, const toml::node& node, std::string_view key) {
    if (const auto place = node.value<std::int64_t>(); place && node.is_integer() && *place > 0)
        return fmt::format("{}", *place);
    if (node.is_string())
        return *node.value<std::string>();
    throw Error(table.placeOf(node, table.pathOf(key)),
                fmt::format("expected an image's place in the order, 1 for the one that comes "
                            "first, or its role, such as \"reference\", found {}",
                            TomlTable::spell(node)));
}

// What a place of `images` has in turn: adds the images, and returns how many.
int parsePlace(const TomlTable& table, const toml::node& node, std::vector<std::string>& images) {
    const toml::array* turns = node.as_array();
    if (!turns) {
        images.push_back(imageName(table, node, "images"));
        return 1;
    }
    if (turns->size() < 2)
        throw Error(table.placeOf(node, table.pathOf("images")),
                    fmt::format("expected two images or more in turn at a place, found {}",
                                TomlTable::spell(node)));
    for (const toml::node& image : *turns)
        images.push_back(imageName(table, image, "images"));
    return static_cast<int>(turns->size());
}

void parseImages(TomlTable& table, Phase& phase) {
    std::vector<std::string>& images = phase.images;
    if (const toml::node* image = table.node("image"))
        images.push_back(imageName(table, *image, "image"));
    const toml::node* several = table.node("images");
    if (!several)
        return;
    const toml::array* list = several->as_array();
    if (!list || list->size() < 2 || !images.empty())
        throw Error(table.placeOf("images"),
                    fmt::format("expected a list of two images or more, or else \"image\", found "
                                "{}",
                                TomlTable::spell(*several)));
    for (const toml::node& node : *list)
        if (const int turns = parsePlace(table, node, images); &node == &list->front())
            phase.turns = turns;
        else if (turns != phase.turns)
            throw Error(table.placeOf(node, table.pathOf("images")),
                        fmt::format("expected as many images in turn at each place, found {} and "
                                    "{}",
                                    phase.turns, turns));
}

void parseAlternation(TomlTable& table, Phase& phase) {
    phase.alternate = table.number("alternate", 0.001, 60, phase.alternate);
    if (phase.alternate == 0 && phase.turns != 1)
        throw Error(table.placeOf("images"), "expected \"alternate\", the seconds for which each "
                                             "image of a place is shown in turn");
    if (phase.alternate > 0 && phase.turns == 1) // all at one place
        phase.turns = std::max(static_cast<int>(phase.images.size()), 1);
}

void parseEnd(TomlTable& table, Phase& phase) {
    if (table.has("seconds") && table.has("frames"))
        throw Error(table.placeOf("frames"), "expected \"seconds\" or \"frames\", found both");
    phase.seconds = table.number("seconds", 0.01, longest, phase.seconds);
    phase.frames = table.integer("frames", 1, 1000000, phase.frames);
    phase.key = table.flag("key", !phase.counted());
    phase.atLeast = table.number("atLeast", 0, longest, phase.atLeast);
    if (!phase.key && !phase.counted() && phase.questions.empty())
        throw Error(table.placeOf("key"), "nothing ends this phase; expected \"key\" to be true, "
                                          "or \"seconds\" or \"frames\"");
    if (phase.atLeast > 0 && (!phase.key || !phase.questions.empty()))
        throw Error(table.placeOf("atLeast"), "expected \"atLeast\" only where a key ends the "
                                              "phase");
}

void checkShows(const TomlTable& table, const Phase& phase) {
    const bool page = !phase.text.empty() || !phase.questions.empty();
    const int shown = static_cast<int>(phase.grey >= 0) + static_cast<int>(page) +
                      static_cast<int>(!phase.images.empty() && phase.questions.empty());
    if (shown != 1)
        throw Error(table.place(), fmt::format("expected one of \"image\", \"images\", \"grey\", "
                                               "\"text\" and \"questions\" (which images may stand "
                                               "beside), found {}",
                                               shown == 0 ? "none" : "several"));
    if (phase.alternate > 0 && !phase.questions.empty())
        throw Error(table.placeOf("alternate"),
                    "expected no questions beside images that alternate; ask in the next phase");
    if (phase.alternate > 0 && (phase.turns < 2 || !phase.counted()))
        throw Error(table.placeOf("alternate"),
                    "expected two images or more and \"seconds\" or \"frames\": each change is one "
                    "of counted refreshes");
}

Phase parsePhase(TomlTable table) {
    Phase phase;
    phase.place = table.place();
    phase.name = table.text("name");
    checkName(table, "name", phase.name, "-", " and hyphens");
    parseImages(table, phase);
    parseAlternation(table, phase);
    phase.grey = table.integer("grey", 0, 255, phase.grey);
    phase.text = table.text("text", "");
    phase.progress = table.flag("progress", phase.progress);
    if (table.has("questions"))
        for (TomlTable& question : table.list("questions", "what is asked"))
            phase.questions.push_back(parseQuestion(std::move(question)));
    parseEnd(table, phase);
    checkShows(table, phase);
    table.finish();
    return phase;
}

void mustBeNew(std::set<std::string>& names, const std::string& name, const Place& place) {
    if (!names.insert(name).second)
        throw Error(place, fmt::format("expected a new name, found \"{}\" again", name));
}

void noteBeside(std::vector<Phase>& phases) {
    const bool beside = std::any_of(phases.begin(), phases.end(), [](const Phase& phase) {
        return static_cast<int>(phase.images.size()) > phase.turns;
    });
    for (Phase& phase : phases)
        for (Question& question : phase.questions)
            question.beside = question.images && beside;
}

std::vector<Phase> parsePhases(TomlTable& owner, std::string_view key, std::string_view expected) {
    std::vector<Phase> phases;
    std::set<std::string> names, answers;
    for (TomlTable& table : owner.list(key, expected)) {
        phases.push_back(parsePhase(std::move(table)));
        mustBeNew(names, phases.back().name, phases.back().place);
        for (const Question& question : phases.back().questions)
            mustBeNew(answers, question.name, question.place);
    }
    noteBeside(phases);
    return phases;
}

// What belongs around the trials is not asked in each of them.
void checkInTrial(const std::vector<Phase>& phases) {
    for (const Phase& phase : phases)
        for (const Question& question : phase.questions)
            if (!question.endsUnless.empty())
                throw Error(question.place,
                            "expected \"endsUnless\" only in questions of [[before]]");
}

bool isPlace(const std::string& image) {
    return image.size() < 4 && image.find_first_not_of("0123456789") == image.npos;
}

// The roles in order, and that no phase names a place beyond them.
void parseOrder(TomlTable& table, Trial& trial) {
    if (const auto roles = table.texts("order", "roles, such as [\"a\", \"b\"]"); !roles.empty()) {
        trial.order.clear();
        std::set<std::string> names;
        for (const PlacedText& role : roles) {
            mustBeNew(names, role.text, role.place);
            trial.order.push_back(role.text);
        }
    }
    for (const Phase& phase : trial.given)
        for (const std::string& image : phase.images)
            if (isPlace(image) && (std::stoul(image) < 1 || std::stoul(image) > trial.order.size()))
                throw Error(phase.place,
                            fmt::format("expected a place from 1 to {}, the number of roles in "
                                        "\"order\", found {}",
                                        trial.order.size(), image));
}

} // namespace

bool admits(const Question& question, const std::string& value) {
    if (question.endsUnless.empty())
        return true;
    const int lowest = question.kind == Question::Kind::scale ? question.lowest : 1;
    for (std::size_t i = 0; i < question.options.size(); ++i)
        if (value == fmt::format("{}", lowest + static_cast<int>(i)))
            return std::find(question.endsUnless.begin(), question.endsUnless.end(),
                             question.options[i]) != question.endsUnless.end();
    return false;
}

std::string nameOf(Question::Kind kind) { return kinds[static_cast<std::size_t>(kind)]; }

std::vector<Phase> phasesOf(const Trial& trial) {
    if (!trial.given.empty())
        return trial.given;
    Phase start, first, mask, second, question;
    start.name = "start";
    start.text = "start";
    start.progress = true;
    first.name = "first";
    first.images = {"1"};
    second.name = "second";
    second.images = {"2"};
    first.atLeast = second.atLeast = trial.minimumView;
    mask.name = "mask";
    mask.grey = trial.grey;
    mask.seconds = trial.mask;
    mask.key = false;
    Question which;
    which.name = "choice";
    which.text = "question";
    which.options = {"first", "second"};
    which.images = true;
    question.name = "question";
    question.questions = {which};
    return {start, first, mask, second, question};
}

std::set<std::string> rolesOf(const Trial& trial) {
    std::set<std::string> roles(trial.order.begin(), trial.order.end());
    for (const Phase& phase : trial.given)
        for (const std::string& image : phase.images)
            if (!isPlace(image))
                roles.insert(image);
    return roles;
}

bool isOrdered(const Trial& trial, const std::string& role) {
    return std::find(trial.order.begin(), trial.order.end(), role) != trial.order.end();
}

std::set<std::string> textsOf(const std::vector<Phase>& phases) {
    std::set<std::string> keys;
    for (const Phase& phase : phases) {
        keys.insert(phase.text);
        for (const Question& question : phase.questions) {
            keys.insert({question.text, question.unsure, question.low, question.high});
            keys.insert(question.options.begin(), question.options.end());
        }
    }
    keys.erase("");
    return keys;
}

Trial parseTrial(TomlTable table) {
    Trial trial;
    trial.grey = table.integer("grey", 0, 255, trial.grey);
    if (table.has("phases")) {
        trial.given = parsePhases(table, "phases", "[[trial.phases]]");
        checkInTrial(trial.given);
        parseOrder(table, trial);
    } else {
        trial.mask = table.number("mask", 0.1, 60, trial.mask);
        trial.minimumView = table.number("minimumView", 0, 60, trial.minimumView);
    }
    table.finish();
    return trial;
}

namespace {

void checkPage(const Phase& page, bool before) {
    if (page.text.empty() && page.questions.empty())
        throw Error(page.place, "expected \"text\" or \"questions\"; grey is for trials");
    if (!page.images.empty() || page.progress)
        throw Error(page.place, "expected no images and no \"progress\" outside trials");
    for (const Question& question : page.questions) {
        if (question.images || question.kind == Question::Kind::rank)
            throw Error(question.place, "expected no question about images outside trials");
        if (!before && !question.endsUnless.empty())
            throw Error(question.place, "expected \"endsUnless\" only in questions of [[before]]");
    }
}

} // namespace

std::vector<Phase> parsePages(TomlTable& root, std::string_view key) {
    if (!root.has(key))
        return {};
    std::vector<Phase> pages = parsePhases(root, key, "pages of text or questions");
    for (const Phase& page : pages)
        checkPage(page, key == "before");
    return pages;
}

} // namespace obscura
