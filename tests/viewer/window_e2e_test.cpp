// The window as a person has it: on a screen of its own (Xvfb), with real events of mouse and
// keyboard. All in one test, because a window takes seconds to open.
#include "base/files.h"
#include "gl/fingers.h"
#include "protocols/reader/protocol.h"
#include "renderer/levels.h"
#include "tests/experiment/desktop.h"
#include "tests/folder.h"
#include "tests/renderer/scene/small_gltf.h"
#include "tests/viewer/file_drag.h"
#include "viewer/application.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>

namespace obscura {
namespace {

namespace fs = std::filesystem;

// Two triangles of the rectangle with corners a, b and c and the fourth.
void addRectangle(std::vector<float>& positions, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    for (const glm::vec3& p : {a, b, c, a, c, a + c - b})
        positions.insert(positions.end(), {p.x, p.y, p.z});
}

// A floor, two walls and, on the floor, a board that stands on end: NAME/NAME.gltf.
void writeScene(const std::string& name, float board) {
    std::vector<float> positions;
    addRectangle(positions, {-3, 0, 3}, {3, 0, 3}, {3, 0, -3});
    addRectangle(positions, {-3, 0, -3}, {3, 0, -3}, {3, 3, -3});
    addRectangle(positions, {-3, 0, 3}, {-3, 0, -3}, {-3, 3, -3});
    addRectangle(positions, {0, 0, -2}, {board, 0, -2}, {board, 2, -2.5F});
    fs::create_directories(name);
    writeFile(name + "/t.bin", trianglesBuffer(positions));
    writeFile(name + "/" + name + ".gltf", trianglesGltf(positions));
}

class ViewerTest : public testing::Test {
  protected:
    static constexpr int width = 820, height = 640;

    void SetUp() override {
        ::setenv("DISPLAY", desktop.name().c_str(), 1);
        ::setenv("XDG_CONFIG_HOME", folder.path().c_str(), 1); // where views are stored
        fs::current_path(folder.path());
        writeScene("first", 1);
        writeScene("second", 2);
        CommandLine line;
        line.scene.file = "first/first.gltf";
        line.level = levelNamed("low");
        line.width = width;
        line.height = height;
        line.uiScale = 1;
        line.renderScale = 0.25;
        viewer = std::make_unique<Application>(line);
        fingers = std::make_unique<gl::Fingers>();
        settle();
    }

    // Frames until something is so; a program that stands still for a minute has failed.
    template <typename Reached>
    void await(const std::string& what, const Reached& reached) {
        constexpr int most = 1200;
        for (int i = 0; i < most; ++i) {
            if (reached())
                return;
            viewer->step(0.05);
        }
        FAIL() << "waited in vain for " << what << "; the window says: " << viewer->message();
    }
    void settle() {
        for (int i = 0; i < 3; ++i)
            viewer->step(0.01);
        await("the picture", [&] { return viewer->settled(); });
        viewer->step(0.01);
    }
    Box where(const std::string& label) {
        await("the widget " + label, [&] { return viewer->where(label).has_value(); });
        return viewer->where(label).value_or(Box{});
    }
    // At a share of a widget. ImGui sees a press in one frame and its end in the next.
    void point(const std::string& label, double x = 0.5, double y = 0.5) {
        const Box box = where(label);
        fingers->moveTo(static_cast<int>(box.x + x * box.width),
                        static_cast<int>(box.y + y * box.height));
        viewer->step(0.02);
        viewer->step(0.02);
    }
    void hold(int button = 1) {
        fingers->pressButton(button);
        viewer->step(0.05);
    }
    void letGo(int button = 1) {
        fingers->releaseButton(button);
        viewer->step(0.05);
    }
    void click(const std::string& label, double x = 0.5, double y = 0.5) {
        point(label, x, y);
        hold();
        letGo();
        viewer->step(0.01);
    }
    void drag(const std::string& label, double fromX, double toX, int button = 1) {
        point(label, fromX);
        hold(button);
        point(label, (fromX + toX) / 2);
        point(label, toX);
        letGo(button);
    }
    void tap(gl::Key key) {
        fingers->tap(key);
        viewer->step(0.05);
        viewer->step(0.01);
    }
    void tap(char key) { tap(static_cast<gl::Key>(key)); }
    // Of the part of the window where pictures are.
    Image8 pictures() {
        const Image8 all = viewer->picture();
        const Box area = where("pictures");
        Image8 part{static_cast<int>(area.width), static_cast<int>(area.height), 3, {}};
        for (int y = 0; y < part.height; ++y)
            for (int i = 0; i < 3 * part.width; ++i)
                part.pixels.push_back(all.pixels[static_cast<std::size_t>(
                    (y + static_cast<int>(area.y)) * 3 * all.width + 3 * static_cast<int>(area.x) +
                    i)]);
        return part;
    }

    test::Folder folder;
    test::Desktop desktop{width, height};
    std::unique_ptr<Application> viewer;
    std::unique_ptr<gl::Fingers> fingers;
};

double meanOf(const Image8& image) {
    double sum = 0;
    for (const std::uint8_t value : image.pixels)
        sum += value;
    return sum / static_cast<double>(image.pixels.size());
}

TEST_F(ViewerTest, APersonOpensFliesTunesComparesTestsAndSavesAPair) {
    // It opened split, and rests: nothing changes, nothing is drawn.
    ASSERT_EQ(viewer->state().layout, Layout::split);
    ASSERT_TRUE(viewer->drawn());
    EXPECT_EQ(viewer->drawn()->panes.size(), 2U);
    EXPECT_EQ(viewer->message(), "");
    const std::uint64_t still = viewer->drawn()->number;
    for (int i = 0; i < 5; ++i)
        viewer->step(0.01);
    EXPECT_EQ(viewer->drawn()->number, still);

    // Another scene by the menu and the browser, which is where the first was.
    click("scene");
    click("Open a file…");
    click("file ..");
    click("file second");
    click("file second.gltf");
    await("the second scene",
          [&] { return viewer->state().view.file.ends_with("second.gltf") && viewer->settled(); });

    // Occlusion, B alone: a technique is chosen, and its slider darkens the picture.
    tap('2');
    point("pictures", 0.5, 0.9);
    tap('O');
    EXPECT_EQ(viewer->state().show, Show::occlusion);
    click("pane B");
    EXPECT_EQ(viewer->state().selected, 1);
    tap(']');
    EXPECT_EQ(viewer->state().panes[1].technique().id, "visibility_bitmask");
    tap('[');
    EXPECT_EQ(viewer->state().panes[1].technique().id, "gtao");
    settle();
    const double before = meanOf(pictures());
    drag("setting intensity", 0.4, 0.75);
    EXPECT_GT(viewer->state().panes[1]["intensity"], 1);
    settle();
    EXPECT_LT(meanOf(pictures()), before - 1);
    EXPECT_EQ(viewer->drawn()->wanted.panes[1]["intensity"], viewer->state().panes[1]["intensity"]);

    // The divider is dragged to the right: more of A, which has no occlusion and is lighter.
    const double split = meanOf(pictures());
    drag("divider", 0.5, 0.5 + 150 / where("divider").width);
    EXPECT_GT(viewer->state().divider, 0.6);
    EXPECT_GT(meanOf(pictures()), split);

    // Flying: W goes forward for as long as it is held, and the wheel comes nearer.
    const Camera start = viewer->state().view.camera;
    point("pictures", 0.2, 0.5);
    fingers->press(static_cast<gl::Key>('W'));
    const auto moved = [&] {
        const Camera& now = viewer->state().view.camera;
        return std::hypot(now.position[0] - start.position[0],
                          now.position[2] - start.position[2]) > 1e-3;
    };
    await("flight", moved);
    fingers->release(static_cast<gl::Key>('W'));
    settle();
    EXPECT_EQ(viewer->drawn()->wanted.view.camera.position, viewer->state().view.camera.position);
    drag("pictures", 0.2, 0.3, 3); // looks around
    EXPECT_NE(viewer->state().view.camera.target, start.target);
    tap('P');
    EXPECT_EQ(viewer->state().views.back().name, "stored-1");
    EXPECT_FALSE(fs::is_empty("obscura/views"));
    tap('F');
    EXPECT_EQ(viewer->state().view.camera.target, start.target);

    // The reference is traced, and B is judged by it.
    click("tab Measure");
    click("Trace the reference");
    await("the reference", [&] { return viewer->drawn()->panes[1].quality.has_value(); });
    EXPECT_LT(viewer->drawn()->panes[1].quality->rmse, viewer->drawn()->panes[0].quality->rmse + 1);
    click("Trace the reference");

    // Pixels are enlarged under the cursor, and probed.
    point("pictures", 0.4, 0.6);
    await("the probe", [&] { return viewer->settled() && viewer->probed().has_value(); });
    fingers->press(gl::Key::leftControl);
    fingers->turnWheel(3);
    await("enlarged pixels", [&] { return viewer->state().magnification.factor > 2; });
    fingers->release(gl::Key::leftControl);
    tap('0');
    EXPECT_EQ(viewer->state().magnification.factor, 1);

    // All layouts; the flicker goes to and fro.
    for (const char key : {'1', '3', '4', '6'}) {
        tap(key);
        settle();
        EXPECT_EQ(static_cast<int>(viewer->drawn()->panes.size()), panesOf(viewer->state().layout));
        if (viewer->state().layout == Layout::single) { // of all panes, the selected one
            EXPECT_EQ(viewer->drawn()->wanted.panes[0].technique().id, "gtao");
        }
    }
    tap(gl::Key::space);
    EXPECT_TRUE(viewer->state().flipped && viewer->state().layout == Layout::flicker);
    tap('2');

    // A pair for people, read back by the studies' own reader.
    click("tab Study");
    click("Add A and B as a condition");
    await("the protocol", [&] { return fs::exists("study.toml"); });
    const Protocol protocol = readProtocol("study.toml");
    ASSERT_EQ(protocol.conditions.size(), 1U);
    EXPECT_EQ(fs::path(protocol.views.front().file).filename(), "second.gltf");

    // The test mode, for as short as it goes.
    drag("Seconds of each", 0.2, 0);
    drag("Rounds", 0.3, 0);
    click("Start test");
    await("the test", [&] { return viewer->test() && viewer->test()->finished(); });
    EXPECT_FALSE(viewer->test()->failed()) << viewer->test()->outcome();
    EXPECT_TRUE(fs::exists("obscura-test/test.csv"));

    // A file that is none is a message, and the scene stays.
    tap(gl::Key::tab);
    EXPECT_FALSE(viewer->state().panels);
    tap(gl::Key::tab);
    tap('H');
    EXPECT_TRUE(viewer->state().help);
    tap(gl::Key::escape);
    EXPECT_FALSE(viewer->state().help);
    writeFile("second/broken.gltf", "{");
    click("scene");
    click("Open a file…");
    click("file broken.gltf");
    await("a message", [&] { return viewer->message().find("broken.gltf") != std::string::npos; });
    EXPECT_TRUE(viewer->state().scene.file.ends_with("second.gltf"));

    // A file manager's drag and drop.
    test::FileDrag dragged("first/first.gltf", 200, 300);
    await("the drop", [&] { return dragged.serve(); });
    await("the dropped scene",
          [&] { return viewer->state().view.file.ends_with("first.gltf") && viewer->settled(); });
}

} // namespace
} // namespace obscura
