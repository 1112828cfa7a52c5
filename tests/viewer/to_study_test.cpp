#include "base/files.h"
#include "base/random.h"
#include "protocols/reader/protocol.h"
#include "protocols/reader/sweep.h"
#include "tests/error_of.h"
#include "tests/folder.h"
#include "viewer/technique_words.h"
#include "viewer/to_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using test::errorOf;
using testing::ElementsAre;
using testing::HasSubstr;

Settings settingsIn(const std::string& words, double radius) {
    return settingsOf(techniqueIn(words), radius);
}

// A pair in the atrium, as a person may have found it by eye.
Seen sample() {
    Seen seen;
    seen.view.builtin = "atrium";
    seen.view.name = "Camera 1";
    seen.view.camera = {{7.61234567, 1.2, -1.0 / 3}, {-4, 2.4, 1.2}, {0, 1, 0}, 60, 0};
    seen.view.radius = 0.35;
    seen.view.exposure = 0.4;
    seen.level.name = "moderate";
    seen.level.sky = Sky{};
    seen.panes = {settingsIn("crytek samples=16", 0.35), settingsIn("gtao low", 0.35)};
    return seen;
}

// Whether b has all lines of a, in their order.
bool keepsLines(const std::string& a, const std::string& b) {
    std::istringstream rest(b);
    std::istringstream lines(a);
    for (std::string line, candidate; std::getline(lines, line);) {
        do
            if (!std::getline(rest, candidate))
                return false;
        while (candidate != line);
    }
    return true;
}

// That the protocol's last condition is what was seen.
void expectShows(const Protocol& protocol, const std::string& id, const Seen& seen) {
    const auto found = std::find_if(protocol.conditions.begin(), protocol.conditions.end(),
                                    [&](const Condition& each) { return each.id == id; });
    ASSERT_NE(found, protocol.conditions.end());
    const View &view = protocol.view(found->view), wanted = rounded(seen.view);
    EXPECT_EQ(view.builtin, wanted.builtin);
    EXPECT_EQ(view.file, wanted.file);
    EXPECT_EQ(rounded(view).camera.position, wanted.camera.position);
    EXPECT_EQ(rounded(view).camera.target, wanted.camera.target);
    EXPECT_EQ(view.camera.fovDegrees, wanted.camera.fovDegrees);
    EXPECT_EQ(view.radius, wanted.radius);
    EXPECT_EQ(view.exposure, wanted.exposure);
    EXPECT_EQ(view.ground, wanted.ground);
    const Level& level = protocol.level(found->level);
    EXPECT_EQ(fieldsOf(level), fieldsOf(seen.level));
    EXPECT_EQ(protocol.normals, seen.normals);
    ASSERT_EQ(found->roles.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_EQ(settingsOf(protocol.technique(found->roles[i].technique), view.radius).values(),
                  seen.panes[i].values());
}

TEST(ToStudy, RoundedViewsAreReadableAndAllButTheSame) {
    Random random(3, "views");
    for (int i = 0; i < 200; ++i) {
        View view = sample().view;
        const double size = std::pow(10, 6 * random.uniform() - 3);
        for (std::size_t k = 0; k < 3; ++k) {
            view.camera.position[k] = size * (random.uniform() - 0.5);
            view.camera.target[k] = size * (random.uniform() - 0.5);
        }
        const Vec3 &p = view.camera.position, &t = view.camera.target;
        const double distance = std::hypot(t[0] - p[0], t[1] - p[1], t[2] - p[2]);
        const View once = rounded(view);
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_NEAR(once.camera.position[k], p[k], 1.01e-5 * distance);
        EXPECT_EQ(fieldsOf(rounded(once)), fieldsOf(once));
    }
    EXPECT_EQ(tomlTriple(rounded(sample().view).camera.position), "[7.6123, 1.2, -0.3333]");
}

TEST(ToStudy, AWholeProtocolIsReadBack) {
    for (const Normals normals : {Normals::smooth, Normals::mapped}) {
        Seen seen = sample();
        seen.normals = normals;
        const Protocol protocol =
            parseProtocol(protocolText(seen, "mine", "/studies"), "/studies/mine.toml");
        EXPECT_EQ(protocol.name, "mine");
        EXPECT_EQ(protocol.width, 1280);
        EXPECT_EQ(protocol.height, 720);
        ASSERT_EQ(protocol.conditions.size(), 1u);
        EXPECT_EQ(protocol.conditions[0].id, "atrium-camera-1-moderate-crytek16-gtao-low");
        expectShows(protocol, protocol.conditions[0].id, seen);
    }
}

// To each of ours whose trial shows a pair, whatever its style, a condition is added, and its lines
// stay. (aalborg-2010 and demo write tables under headings, the others on lines.)
TEST(ToStudy, APairIsAddedToEveryStudyOfPairsThatWeHave) {
    int added = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(OBSCURA_SOURCE "/protocols")) {
        const std::string name = entry.path().filename().string();
        if (entry.path().extension() != ".toml" || name.starts_with("match-") ||
            name.starts_with("sweep-"))
            continue;
        const std::string text = readFile(entry.path());
        const Protocol before = parseProtocol(text, entry.path().string());
        const Seen seen = sample();
        try {
            const Added result = withPair(text, entry.path(), seen);
            const Protocol after = parseProtocol(result.text, entry.path().string());
            EXPECT_EQ(after.conditions.size(), before.conditions.size() + 1) << name;
            EXPECT_TRUE(keepsLines(text, result.text)) << name;
            expectShows(after, result.condition, seen);
            ++added;
        } catch (const Error& error) {
            // Ladders need a right answer or a score for each step, which only a person can give.
            EXPECT_THAT(error.what(),
                        testing::AnyOf(HasSubstr("shows a pair"), HasSubstr("right answer"),
                                       HasSubstr("normals"), HasSubstr("scores")))
                << name;
        }
    }
    EXPECT_GE(added, 8);
}

TEST(ToStudy, WhatTheProtocolHasIsUsed) {
    const fs::path file = OBSCURA_SOURCE "/protocols/demo.toml";
    const Protocol demo = readProtocol(file);
    Seen seen = sample();
    seen.view = demo.view("atrium");
    seen.view.name = "another name";
    seen.level = demo.level("high");
    seen.panes = {settingsIn("blizzard samples=8", seen.view.radius),
                  settingsIn("crytek samples=24", seen.view.radius)};
    const Added result = withPair(readFile(file), file, seen);
    const Protocol after = parseProtocol(result.text, file.string());
    EXPECT_EQ(after.views.size(), demo.views.size());
    EXPECT_EQ(after.levels.size(), demo.levels.size());
    EXPECT_EQ(after.techniques.size(), demo.techniques.size());
    EXPECT_EQ(result.condition, "atrium-high-blizzard8-crytek24");
    EXPECT_THAT(result.notes, ElementsAre(HasSubstr("[[claims]]")));
}

TEST(ToStudy, NamesThatAreTakenGetNumbers) {
    const std::string first = protocolText(sample(), "mine", "/studies");
    Seen other = sample();
    other.view.camera.position[0] += 1;
    other.level.sun = Sun{};
    other.panes[1].set("intensity", 0.5);
    Added second = withPair(first, "/studies/mine.toml", other);
    other.panes[1].set("intensity", 0.25);
    const Added third = withPair(second.text, "/studies/mine.toml", other);
    const Protocol protocol = parseProtocol(third.text, "mine.toml");
    std::vector<std::string> names;
    for (const View& view : protocol.views)
        names.push_back(view.name);
    for (const Level& level : protocol.levels)
        names.push_back(level.name);
    for (const TechniqueSetting& technique : protocol.techniques)
        names.push_back(technique.name);
    EXPECT_THAT(names, ElementsAre("atrium-camera-1", "atrium-camera-1-2", "moderate", "moderate-2",
                                   "crytek16", "gtao-low", "gtao-low-tuned", "gtao-low-tuned-2"));
    expectShows(protocol, third.condition, other);
}

TEST(ToStudy, WhatClashesIsExplained) {
    const std::string text = protocolText(sample(), "mine", "/studies");
    const auto error = [](const std::string& of, const Seen& seen) {
        return errorOf([&] { withPair(of, "/studies/mine.toml", seen); });
    };
    EXPECT_THAT(error(text, sample()),
                HasSubstr("this pair already, as condition \"atrium-camera-1"));
    Seen exchanged = sample();
    std::swap(exchanged.panes[0], exchanged.panes[1]);
    EXPECT_THAT(error(text, exchanged), HasSubstr("this pair already"));
    Seen mapped = sample();
    mapped.normals = Normals::mapped;
    EXPECT_THAT(error(text, mapped), HasSubstr("expected normals = \"mapped\""));
    Seen alike = sample();
    alike.panes[1] = alike.panes[0];
    EXPECT_THAT(error(text, alike), HasSubstr("\"crytek\" with the same settings twice"));
    Seen reach = sample();
    reach.panes[0].set("radius", 0.8);
    EXPECT_THAT(error(text, reach), HasSubstr("has radius 0.8 m"));
    const fs::path single = OBSCURA_SOURCE "/protocols/p910-acr.toml";
    EXPECT_THAT(error(readFile(single), sample()), HasSubstr("mine.toml: expected a protocol whose "
                                                             "trial shows a pair"));
}

TEST(ToStudy, WhatTheStudyShowsOtherwiseIsSaid) {
    Seen seen = sample();
    seen.textures = false;
    seen.view.radius = 0.5;
    seen.width = 720;
    const Added result =
        withPair(protocolText(sample(), "mine", "/studies"), "/studies/mine.toml", seen);
    EXPECT_THAT(result.notes, ElementsAre(HasSubstr("textures"), HasSubstr("1280 x 720, wider")));
    seen.view.builtin.clear();
    seen.view.file = "/elsewhere/room.glb";
    EXPECT_THAT(withPair(result.text, "/studies/mine.toml", seen).notes,
                testing::Contains(HasSubstr("not in the scenes folder")));
}

TEST(ToStudy, AFileIsWrittenWholeOrNotAtAll) {
    const test::Folder folder;
    const fs::path file = folder / "My study.toml", link = folder / "link.toml";
    const Added begun = addPair(file, sample());
    EXPECT_EQ(readFile(file), begun.text);
    EXPECT_EQ(readProtocol(file).name, "my-study");

    fs::create_symlink(file.filename(), link);
    fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
    Seen other = sample();
    other.view.exposure = -1;
    addPair(link, other);
    EXPECT_EQ(readProtocol(file).conditions.size(), 2u);
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);

    const std::string before = readFile(file);
    EXPECT_THAT(errorOf([&] { addPair(file, other); }), HasSubstr("already"));
    EXPECT_EQ(readFile(file), before);
}

TEST(ToStudy, EnvironmentsAreNamedFromTheProtocolsFolder) {
    const test::Folder folder;
    Seen seen = sample();
    seen.level = Level();
    seen.level.environment = (folder / "skies/noon.hdr").string();
    const std::string text = protocolText(seen, "mine", folder.path());
    EXPECT_THAT(text, HasSubstr("environment = \"skies/noon.hdr\""));
    EXPECT_THAT(protocolText(seen, "mine", folder / "deeper"),
                HasSubstr("environment = \"" + seen.level.environment + "\""));
    Seen other = seen;
    other.view.exposure = 1;
    const Added result = withPair(text, folder / "mine.toml", other);
    EXPECT_EQ(parseProtocol(result.text, "mine.toml").levels.size(), 1u);
    EXPECT_EQ(inScenesFolder(folder / "a/b.gltf", folder.path()), "a/b.gltf");
    EXPECT_EQ(inScenesFolder("/elsewhere/b.gltf", folder.path()), "/elsewhere/b.gltf");
}

TEST(ToStudy, TablesCanBePastedIntoAProtocol) {
    const std::string text = tablesText(sample());
    EXPECT_THAT(text, testing::StartsWith("[scenes.atrium-camera-1]\nbuiltin = \"atrium\"\n"));
    const Protocol protocol = parseProtocol(
        "name = \"x\"\nseed = 1\n" + text +
            "[[conditions]]\nid = \"c\"\nscene = \"atrium-camera-1\"\nlevel = \"moderate\"\npair = "
            "[\"crytek16\", \"gtao-low\"]\n[texts]\ninstructions = \"a\"\nstart = \"a\"\nquestion "
            "= "
            "\"a\"\nfirst = \"a\"\nsecond = \"a\"\nthanks = \"a\"\n",
        "pasted.toml");
    expectShows(protocol, "c", sample());
}

TEST(ToStudy, CamerasMakeASweep) {
    Seen seen = sample();
    seen.panes.push_back(settingsIn("ray_traced", 0.35));
    std::vector<View> cameras(5, seen.view);
    for (std::size_t i = 0; i < 4; ++i)
        cameras[i].camera.position[1] += static_cast<double>(i);
    cameras[4] = cameras[0]; // stored twice
    cameras[2].name = "Nave";
    const SweepStudy study =
        parseSweepStudy(sweepText("mine", cameras, seen, "/studies"), "mine.toml");
    std::vector<std::string> names;
    for (const std::vector<View>* views : {&study.match.train, &study.match.test})
        for (const View& view : *views)
            names.push_back(view.name);
    EXPECT_THAT(names, ElementsAre("atrium-camera-1", "atrium-camera-1-3", "atrium-camera-1-2",
                                   "atrium-nave"));
    EXPECT_EQ(study.match.test.size(), 2u);
    EXPECT_EQ(study.sizes[0].width, 960);
    EXPECT_EQ(study.match.techniques.size(), 2u); // not what is compared with
    EXPECT_EQ(fieldsOf(*study.light), fieldsOf(seen.level));
    EXPECT_EQ(settingsOf(study.match.techniques[1], 0.35).values(), seen.panes[1].values());

    EXPECT_THAT(errorOf([&] {
                    sweepText("mine", {cameras[0], cameras[4]}, seen, "/studies");
                }),
                HasSubstr("two cameras that differ"));
    seen.panes = {seen.panes[2]};
    EXPECT_THAT(errorOf([&] { sweepText("mine", cameras, seen, "/studies"); }),
                HasSubstr("besides ray_traced"));
}

TEST(ToStudy, ASweepIsNeverWrittenOverAFile) {
    const test::Folder folder;
    std::vector<View> cameras(2, sample().view);
    cameras[1].exposure = 1;
    writeSweep(folder / "sweep.toml", cameras, sample());
    EXPECT_EQ(readSweepStudy(folder / "sweep.toml").match.name, "sweep");
    EXPECT_THAT(errorOf([&] { writeSweep(folder / "sweep.toml", cameras, sample()); }),
                HasSubstr("new file"));
}

} // namespace
} // namespace obscura
