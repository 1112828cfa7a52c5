#include "viewer/to_study.h"

#include "base/error.h"
#include "base/files.h"
#include "protocols/reader/protocol.h"
#include "protocols/reader/sweep.h"
#include "protocols/reader/toml_insert.h"
#include "viewer/technique_words.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace obscura {

namespace fs = std::filesystem;

namespace {

using fmt::format;

template <typename T>
std::vector<std::string> namesOf(const std::vector<T>& items) {
    std::vector<std::string> names;
    for (const T& item : items)
        names.push_back(item.name);
    return names;
}

void expectPair(const Seen& seen) {
    if (seen.panes.size() != 2)
        throw Error(
            format("expected two techniques, the members of a pair, found {}", seen.panes.size()));
    const Settings &a = seen.panes[0], &b = seen.panes[1];
    if (&a.technique() == &b.technique() && a.values() == b.values())
        throw Error(format("expected two techniques that differ, found \"{}\" with the same "
                           "settings twice",
                           a.technique().id));
}

TomlFields conditionFields(const Condition& condition) {
    return {{"id", tomlText(condition.id)},
            {"scene", tomlText(condition.view)},
            {"level", tomlText(condition.level)},
            {"pair", tomlList({condition.roles[0].technique, condition.roles[1].technique})}};
}

// What a pair needs of a protocol, and what it must get for it.
struct Placed {
    Condition condition;
    std::vector<NewTable> added;
};

// The name of the item that says the same, or that of a new table.
template <typename T, typename Fields>
std::string placed(std::vector<NewTable>& added, const std::string& kind, const std::string& wish,
                   const std::vector<T>& items, const Fields& fields, const TomlFields& wanted) {
    for (const T& item : items)
        if (fields(item) == wanted)
            return item.name;
    added.push_back({kind, newName(wish, namesOf(items)), wanted});
    return added.back().name;
}

std::string placedTechnique(std::vector<NewTable>& added, const Protocol& protocol,
                            const Settings& settings, double radius) {
    for (const TechniqueSetting& each : protocol.techniques) {
        const Settings known = settingsOf(each, radius);
        if (&known.technique() == &settings.technique() && known.values() == settings.values())
            return each.name;
    }
    std::vector<std::string> taken = namesOf(protocol.techniques);
    for (const NewTable& table : added)
        taken.push_back(table.name);
    const TechniqueSetting setting = settingOf(settings, radius);
    added.push_back({"techniques", newName(setting.name, taken), techniqueFields(setting)});
    return added.back().name;
}

Placed placedIn(const Protocol& protocol, const fs::path& folder, const Seen& seen) {
    Placed result;
    Condition& condition = result.condition;
    const View view = rounded(seen.view);
    condition.view = placed(
        result.added, "scenes", sceneName(view), protocol.views,
        [](const View& each) { return fieldsOf(rounded(each)); }, fieldsOf(view));
    const Level level = levelIn(folder, seen.level);
    condition.level = placed(
        result.added, "levels", levelName(level), protocol.levels,
        [&](Level each) {
            if (!each.environment.empty())
                each.environment = (folder / each.environment).string();
            return fieldsOf(levelIn(folder, each));
        },
        fieldsOf(level));
    for (const Settings& pane : seen.panes)
        condition.roles.push_back(
            {condition.roles.empty() ? "a" : "b",
             placedTechnique(result.added, protocol, pane, seen.view.radius)});
    std::vector<std::string> ids;
    for (const Condition& each : protocol.conditions)
        ids.push_back(each.id);
    condition.id = newName(slug(format("{}-{}-{}-{}", condition.view, condition.level,
                                       condition.roles[0].technique, condition.roles[1].technique)),
                           ids);
    result.added.push_back({"conditions", "", conditionFields(condition)});
    return result;
}

void expectRoomFor(const Seen& seen, const Protocol& protocol) {
    const std::set<std::string> roles = rolesOf(protocol.trial);
    if (roles != std::set<std::string>{"a", "b"} || protocol.boost)
        throw Error(
            format("expected a protocol whose trial shows a pair, a and b, found one that "
                   "shows {}; add the condition by hand, or begin a new protocol",
                   protocol.boost ? "boosted images" : format("{}", fmt::join(roles, ", "))));
    if (protocol.normals != seen.normals) {
        const auto name = [](Normals normals) {
            return normalsNames()[static_cast<std::size_t>(normals)];
        };
        throw Error(format("expected normals = \"{}\", with which the pair is seen, found \"{}\", "
                           "with which the study would make other pictures; change them in the "
                           "viewer, or begin a new protocol",
                           name(seen.normals), name(protocol.normals)));
    }
}

void expectNew(const Condition& wanted, const Protocol& protocol) {
    for (const Condition& each : protocol.conditions) {
        std::set<std::string> have, want;
        for (const Role& role : each.roles)
            have.insert(role.technique);
        for (const Role& role : wanted.roles)
            want.insert(role.technique);
        if (each.view == wanted.view && each.level == wanted.level && have == want)
            throw Error(each.place, format("has this pair already, as condition \"{}\"; which of "
                                           "the two comes first is balanced over participants",
                                           each.id));
    }
}

std::vector<std::string> notesOf(const Seen& seen, const Protocol& protocol, const fs::path& file) {
    std::vector<std::string> notes;
    if (!seen.textures)
        notes.emplace_back("The study shows textures, which are off on the screen.");
    if (fs::path(seen.view.file).is_absolute())
        notes.emplace_back(
            "The scene is not in the scenes folder (--scenes), so the study names it "
            "by its whole path, which other machines do not have.");
    const double study = static_cast<double>(protocol.width) / protocol.height,
                 screen = static_cast<double>(seen.width) / seen.height;
    if (std::abs(study / screen - 1) > 0.01)
        notes.push_back(format("Images of {} are {} x {}, {} than on the screen.",
                               file.filename().string(), protocol.width, protocol.height,
                               study > screen ? "wider" : "narrower"));
    if (!protocol.claims.empty())
        notes.push_back("No [[claims]] of the study speaks of the new condition.");
    return notes;
}

// What is new in a protocol that only has this pair.
constexpr const char* protocolHead =
    R"(# Begun in obscura-view. What is on the screen there was taken over; the rest is a beginning, and yours to change:
# docs/protocols.md has every key.
#   obscura-stimuli THIS_FILE --scenes SCENES --out stimuli    makes the pictures
#   obscura-experiment --protocol THIS_FILE --stimuli stimuli --preview sheet.png    shows every page
#   obscura-analysis plan THIS_FILE    says how many people it takes
# Declare what the study is to show under [[claims]] before anybody takes part.
)";

constexpr const char* protocolTail = R"(
# Image 1 until Space, two seconds of mid-grey, image 2 until Space, then the question.
[trial]
mask = 2.0
grey = 128
minimumView = 0.5

[ordering] # balanced orders, and each pair in both orders
scheme = "williams"
participants = 28

[texts]
instructions = """
You will see pairs of computer-generated pictures, one picture after the other. Look at each for as \
long as you like, then press the space bar. The screen turns grey for two seconds between the two.

You will then be asked which of the two looked most realistic. No answer is right or wrong. If you \
are unsure, trust your first impression."""
start = "Press the space bar to see the next pair."
question = "Which picture looked most realistic?"
first = "the first"
second = "the second"
thanks = "That was the last pair. Thank you for taking part!"
)";

std::string normalsLine(Normals normals) {
    return normals == Normals::smooth
               ? ""
               : format("normals = {}\n",
                        tomlText(normalsNames()[static_cast<std::size_t>(normals)]));
}

// Puts a text in the place of the one that was read, if it still is there. A link stays a link.
void replace(const fs::path& file, const std::string& read, const std::string& text) {
    const fs::path real = fs::canonical(file);
    if (readFile(real) != read)
        throw Error({file.string(), 0, 0, {}},
                    "was changed while the pair was added; nothing was written, try again");
    const fs::perms permissions = fs::status(real).permissions();
    writeFile(real, text);
    std::error_code ignored;
    fs::permissions(real, permissions, ignored);
}

void writeNew(const fs::path& file, const std::string& text) {
    if (!writeNewFile(file, text))
        throw Error({file.string(), 0, 0, {}},
                    "expected the name of a new file, found one that is there");
}

} // namespace

std::string protocolText(const Seen& seen, const std::string& name, const fs::path& folder) {
    expectPair(seen);
    const Placed pair = placedIn(Protocol(), folder, seen);
    std::string text =
        format("{}name = {}\ntitle = \"Which picture looks more realistic?\"\nseed = "
               "1\n{}\n[image]\nwidth = 1280\nheight = 720\nantialiasing = 4\n",
               protocolHead, tomlText(name), normalsLine(seen.normals));
    for (const NewTable& table : pair.added)
        text += table.name.empty() ? format("\n[[{}]]\n{}", table.parent, tomlLines(table.fields))
                                   : "\n" + tomlTable(table.parent, table.name, table.fields);
    return text + protocolTail;
}

Added withPair(const std::string& text, const fs::path& file, const Seen& seen) {
    expectPair(seen);
    const Protocol protocol = parseProtocol(text, file.string());
    try {
        expectRoomFor(seen, protocol);
    } catch (const Error& error) {
        throw Error({file.string(), 0, 0, {}}, error.what());
    }
    const Placed pair = placedIn(protocol, fs::absolute(file).parent_path(), seen);
    expectNew(pair.condition, protocol);
    Added result{withTables(text, file.string(), pair.added), pair.condition.id,
                 notesOf(seen, protocol, file)};
    parseProtocol(result.text, file.string());
    return result;
}

Added addPair(const fs::path& file, const Seen& seen) {
    if (fs::exists(file)) {
        const std::string text = readFile(file);
        Added result = withPair(text, file, seen);
        replace(file, text, result.text);
        return result;
    }
    const std::string text = protocolText(seen, studyName(file), fs::absolute(file).parent_path());
    const Protocol protocol = parseProtocol(text, file.string());
    writeNew(file, text);
    return {text, protocol.conditions.front().id, notesOf(seen, protocol, file)};
}

std::string sweepText(const std::string& name, const std::vector<View>& cameras, const Seen& seen,
                      const fs::path& folder) {
    std::vector<NewTable> scenes, techniques;
    std::vector<std::string> taken, train, test;
    for (const View& camera : cameras) {
        const View view = rounded(camera);
        const TomlFields fields = fieldsOf(view);
        if (std::any_of(scenes.begin(), scenes.end(),
                        [&](const NewTable& each) { return each.fields == fields; }))
            continue;
        taken.push_back(newName(sceneName(view), taken));
        (scenes.size() % 3 == 0 ? train : test).push_back(taken.back());
        scenes.push_back({"scenes", taken.back(), fields});
    }
    if (test.empty())
        throw Error(format("expected two cameras that differ, for what is fitted on one is judged "
                           "on another, found {}; store another one",
                           scenes.size()));
    taken.clear();
    for (const Settings& pane : seen.panes) {
        if (pane.technique().reads & rays)
            continue;
        const TechniqueSetting setting = settingOf(pane, seen.view.radius);
        taken.push_back(newName(setting.name, taken));
        techniques.push_back({"techniques", taken.back(), techniqueFields(setting)});
    }
    if (techniques.empty())
        throw Error("expected a technique besides ray_traced, which is what a sweep compares with, "
                    "found none");
    std::string text = format(
        "# Cameras and techniques of obscura-view: obscura-bench sweep THIS_FILE --scenes SCENES\n"
        "# A list in a setting's place (samples = [8, 16]) measures each of its values.\n"
        "name = {}\nseed = 1\nreference = \"cosine\"\nrays = 256\n{}train = {}\ntest = {}\nsizes "
        "= [[960, 540]]\n\n[training]\nwidth = 480\nheight = 270\n\n[light] # for errors of lit "
        "images\n{}",
        tomlText(name), normalsLine(seen.normals), tomlList(train), tomlList(test),
        tomlLines(fieldsOf(levelIn(folder, seen.level))));
    for (const std::vector<NewTable>* tables : {&scenes, &techniques})
        for (const NewTable& table : *tables)
            text += "\n" + tomlTable(table.parent, table.name, table.fields);
    return text;
}

void writeSweep(const fs::path& file, const std::vector<View>& cameras, const Seen& seen) {
    const std::string text =
        sweepText(studyName(file), cameras, seen, fs::absolute(file).parent_path());
    parseSweepStudy(text, file.string());
    writeNew(file, text);
}

} // namespace obscura
