#include "base/files.h"
#include "protocols/reader/study_text.h"
#include "tests/error_of.h"
#include "tests/folder.h"
#include "viewer/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

View viewOf(const std::string& file, const std::string& name, double x = 1) {
    View view;
    view.file = file;
    view.name = name;
    view.camera.position = {x, 1.6, 1.0 / 3};
    view.camera.target = {0, 1.5, -4};
    view.camera.near = 0.02;
    view.radius = 0.5;
    view.exposure = -1.25;
    return view;
}

std::vector<std::string> textsOf(const std::vector<View>& views) {
    std::vector<std::string> texts;
    for (const View& view : views)
        texts.push_back(tomlTable("scenes", view.name, fieldsOf(view)));
    return texts;
}

class Presets : public testing::Test {
  protected:
    test::Folder folder_;
    View scene_ = viewOf((folder_ / "scenes/My room.glb").string(), "");
};

TEST_F(Presets, AreThereAgainAsTheyWereStored) {
    EXPECT_TRUE(storedViews(folder_.path(), scene_).empty());
    View ground = viewOf(scene_.file, "with \"quotes\", = and ü", 3);
    ground.ground = Ground{-2, {0.5, 0.25, 0.125}};
    const std::vector<View> views{viewOf(scene_.file, "window"), ground,
                                  viewOf(scene_.file, "a.b", 2)};
    for (const View& view : views)
        storeView(folder_.path(), view);
    EXPECT_EQ(textsOf(storedViews(folder_.path(), scene_)), textsOf(views));
}

TEST_F(Presets, OfOneNameTakeEachOthersPlace) {
    for (const double x : {1.0, 2.0})
        for (const char* name : {"b", "a"})
            storeView(folder_.path(), viewOf(scene_.file, name, x));
    const std::vector<View> views = storedViews(folder_.path(), scene_);
    ASSERT_EQ(views.size(), 2u);
    EXPECT_EQ(views[0].name, "b");
    EXPECT_EQ(views[0].camera.position[0], 2);
    forgetView(folder_.path(), scene_, "b");
    forgetView(folder_.path(), scene_, "unknown");
    EXPECT_EQ(storedViews(folder_.path(), scene_).size(), 1u);
}

// However its place is spelt, a scene has one file, and another one of the same name has another.
TEST_F(Presets, AreOfOneScene) {
    View same = scene_, other = scene_, builtin;
    same.file = (folder_ / "scenes/../scenes/./My room.glb").string();
    other.file = (folder_ / "other/My room.glb").string();
    builtin.builtin = "atrium";
    builtin.name = "mine";
    builtin.camera = scene_.camera;
    builtin.radius = 0.5;
    storeView(folder_.path(), viewOf(scene_.file, "window"));
    storeView(folder_.path(), builtin);
    ASSERT_EQ(storedViews(folder_.path(), same).size(), 1u);
    EXPECT_EQ(storedViews(folder_.path(), same)[0].file, same.file);
    EXPECT_TRUE(storedViews(folder_.path(), other).empty());
    EXPECT_EQ(storedViews(folder_.path(), builtin).size(), 1u);
    EXPECT_EQ(viewsFile(folder_.path(), builtin), folder_ / "atrium.toml");
    EXPECT_THAT(viewsFile(folder_.path(), scene_).filename().string(),
                testing::MatchesRegex("My-room.glb-[0-9a-f]+\\.toml"));
}

// What is wrong is told with its place, and stays as a person wrote it.
TEST_F(Presets, ThatCannotBeReadAreNotOverwritten) {
    const fs::path file = viewsFile(folder_.path(), scene_);
    const std::string place = fs::weakly_canonical(scene_.file).string();
    const auto text = [](const std::string& scene, const std::string& rest) {
        return "[scenes.window]\nfile = \"" + scene +
               "\"\ncamera = { position = [0, 1, 2], target = [0, 0, 0] }\nradius = " + rest + "\n";
    };
    const std::pair<std::string, std::string> faults[] = {
        {text(place, "-1"), ":4:10: scenes.window.radius: expected"},
        {text(place, "1\nraduis = 1"), ":5:1: scenes.window.raduis: "},
        {text(place, "1\n[views]"), ":5:2: views: unknown key"},
        {text(place, "1").substr(0, 30), ":"},
        {text("/elsewhere/room.glb", "1"), "found one of /elsewhere/room.glb; move it to "}};
    for (const auto& [broken, expected] : faults) {
        writeFile(file, broken);
        const auto load = [&] { storedViews(folder_.path(), scene_); };
        EXPECT_THAT(test::errorOf(load), HasSubstr(file.string() + ":"));
        EXPECT_THAT(test::errorOf(load), HasSubstr(expected));
        EXPECT_EQ(test::errorOf([&] { storeView(folder_.path(), viewOf(scene_.file, "new")); }),
                  test::errorOf(load));
        EXPECT_EQ(readFile(file), broken);
    }
    EXPECT_THAT(test::errorOf([&] { storeView(folder_.path(), viewOf(scene_.file, "")); }),
                HasSubstr("expected a name"));
}

TEST_F(Presets, AreOneListWithTheFilesCamerasAndTheFoundView) {
    const View found = viewOf(scene_.file, "");
    Camera other = found.camera;
    other.position = {7, 7, 7};
    const std::vector<View> views = allViews(
        found, {{"Camera", other}, {"same as found", found.camera}, {"", other}, {"", other}},
        {viewOf(scene_.file, "Camera", 9), viewOf(scene_.file, "found", 10)});
    std::vector<std::string> names;
    for (const View& view : views)
        names.push_back(view.name);
    EXPECT_THAT(names, testing::ElementsAre("found", "Camera", "camera", "camera 2", "Camera 2",
                                            "found 2"));
    EXPECT_EQ(views[1].camera.position, other.position);
    EXPECT_EQ(views[1].radius, found.radius);
    EXPECT_EQ(views[5].camera.position[0], 10);
}

TEST(PresetsFolder, FollowsXdg) {
    const auto folderWith = [](const char* config, const char* home) {
        const auto set = [](const char* name, const char* value) {
            value ? ::setenv(name, value, 1) : ::unsetenv(name);
        };
        const char* const before[] = {std::getenv("XDG_CONFIG_HOME"), std::getenv("HOME")};
        const std::string kept[] = {before[0] ? before[0] : "", before[1] ? before[1] : ""};
        set("XDG_CONFIG_HOME", config);
        set("HOME", home);
        std::string result;
        try {
            result = viewsFolder().string();
        } catch (const Error& error) {
            result = error.what();
        }
        set("XDG_CONFIG_HOME", before[0] ? kept[0].c_str() : nullptr);
        set("HOME", before[1] ? kept[1].c_str() : nullptr);
        return result;
    };
    EXPECT_EQ(folderWith("/c", "/h"), "/c/obscura/views");
    EXPECT_EQ(folderWith("relative", "/h"), "/h/.config/obscura/views");
    EXPECT_EQ(folderWith(nullptr, "/h"), "/h/.config/obscura/views");
    EXPECT_THAT(folderWith(nullptr, nullptr), HasSubstr("expected HOME or XDG_CONFIG_HOME"));
}

} // namespace
} // namespace obscura
