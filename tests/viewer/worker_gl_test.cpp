// The worker as a window uses it: it is asked, and says what came of it. Pictures themselves are
// painter_gl_test's.
#include "base/random.h"
#include "gl/context.h"
#include "tests/renderer/scene/small_gltf.h"
#include "tests/viewer/room.h"
#include "viewer/worker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <thread>

namespace obscura {
namespace {

namespace fs = std::filesystem;

constexpr double patience = 60; // seconds

std::shared_ptr<void> context() { return std::make_shared<gl::Context>(); }

double processSeconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

// A square, 2 m wide, as a file.
std::string squareFile(const std::string& name) {
    const std::vector<float> corners{-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, -1, 0, 1, 1, 0, -1, 1, 0};
    const fs::path folder(testing::TempDir());
    std::ofstream(folder / "t.bin", std::ios::binary) << trianglesBuffer(corners);
    std::ofstream(folder / name) << trianglesGltf(corners);
    return (folder / name).string();
}

class WorkerTest : public testing::Test {
  protected:
    // Opens a scene and waits for it.
    SceneId opened(const SceneChoice& choice) {
        const SceneId id = worker_.open(choice);
        EXPECT_TRUE(worker_.waitUntilDrawn(patience));
        return id;
    }
    Wanted wanted(SceneId scene, std::vector<Settings> panes) const {
        Wanted result = wantedOf(scene, std::move(panes));
        result.view.camera = worker_.opened()->camera;
        result.view.radius = worker_.opened()->radius;
        return result;
    }

    std::atomic<int> told_ = 0;
    Worker worker_{context, [this] { ++told_; }};
};

TEST_F(WorkerTest, OpensFindsAViewAndDraws) {
    const SceneId id = opened({squareFile("opened.gltf"), "", {}});
    const auto scene = worker_.opened();
    ASSERT_NE(scene, nullptr);
    EXPECT_EQ(scene->id, id);
    EXPECT_EQ(scene->triangles, 2U);
    EXPECT_GT(scene->radius, 0);
    EXPECT_EQ(worker_.newest(), nullptr); // nothing was wanted
    worker_.probe(std::array{80, 45});
    worker_.want(wanted(id, {settingsOf("gtao")}));
    EXPECT_TRUE(worker_.waitUntilDrawn(patience));
    const auto drawn = worker_.newest();
    ASSERT_NE(drawn, nullptr);
    EXPECT_EQ(drawn->panes.at(0).picture->width, 160);
    EXPECT_FALSE(drawn->panes[0].passes.empty());
    EXPECT_GT(drawn->panes[0].ms, 0);
    EXPECT_TRUE(worker_.probed().value().surface); // the view shows the scene
    EXPECT_EQ(worker_.status().error, "");
    EXPECT_GT(told_, 2);
}

TEST_F(WorkerTest, SleepsWhileNothingChanges) {
    const SceneId id = opened({squareFile("still.gltf"), "", {}});
    const Wanted wish = wanted(id, {settingsOf("gtao")});
    worker_.want(wish);
    EXPECT_TRUE(worker_.waitUntilDrawn(patience));
    const auto number = worker_.newest()->number;
    const int told = told_;
    const double before = processSeconds();
    for (int i = 0; i < 10; ++i) {
        worker_.want(wish); // as a window does each time that something moves elsewhere
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
    }
    EXPECT_LT(processSeconds() - before, 0.03); // of 0.3 s
    EXPECT_EQ(worker_.newest()->number, number);
    EXPECT_EQ(told_, told);
}

TEST_F(WorkerTest, TheNewestWishReplacesThoseThatWait) {
    const SceneId id = opened({squareFile("wishes.gltf"), "", {}});
    Wanted wish = wanted(id, {settingsOf("gtao")});
    for (int i = 0; i < 300; ++i) {
        wish.view.camera.position[0] += 0.001;
        worker_.want(wish);
    }
    EXPECT_TRUE(worker_.waitUntilDrawn(patience));
    EXPECT_EQ(worker_.newest()->wanted, wish);
    EXPECT_LT(worker_.newest()->number, 100U);
    EXPECT_FALSE(worker_.newest()->draft);
}

TEST_F(WorkerTest, AFileThatCannotBeReadIsToldAndTheSceneStays) {
    const SceneId id = opened({squareFile("good.gltf"), "", {}});
    Wanted wish = wanted(id, {settingsOf("gtao")});
    worker_.want(wish);
    EXPECT_TRUE(worker_.waitUntilDrawn(patience));
    opened({"no/such/file.gltf", "", {}});
    EXPECT_THAT(worker_.status().error, testing::HasSubstr("file.gltf"));
    std::ofstream(fs::path(testing::TempDir()) / "broken.gltf") << "{\"asset\":";
    opened({(fs::path(testing::TempDir()) / "broken.gltf").string(), "", {}});
    EXPECT_THAT(worker_.status().error, testing::HasSubstr("broken.gltf"));
    EXPECT_EQ(worker_.opened()->id, id);
    wish.view.exposure = 1; // it can still be drawn
    worker_.want(wish);
    EXPECT_TRUE(worker_.waitUntilDrawn(patience));
    EXPECT_EQ(worker_.newest()->wanted, wish);
    opened({squareFile("good.gltf"), "", {}});
    EXPECT_EQ(worker_.status().error, "");
}

TEST_F(WorkerTest, WhatCannotBeDrawnIsToldAndTheNextCanBe) {
    const SceneId id = opened({squareFile("drawn.gltf"), "", {}});
    Wanted wish = wanted(id, {settingsOf("gtao")});
    wish.level.ambient.reset();
    wish.level.environment = "no-such-sky.hdr";
    worker_.want(wish);
    EXPECT_TRUE(worker_.waitUntilDrawn(patience));
    EXPECT_THAT(worker_.status().error, testing::HasSubstr("no-such-sky.hdr"));
    EXPECT_EQ(worker_.newest(), nullptr);
    wish = wanted(id, {settingsOf("gtao")});
    worker_.want(wish);
    EXPECT_TRUE(worker_.waitUntilDrawn(patience));
    EXPECT_EQ(worker_.newest()->wanted, wish);
    EXPECT_EQ(worker_.status().error, "");
}

TEST_F(WorkerTest, OpeningCanBeOvertakenAndAborted) {
    worker_.open({"", "sculpture", {}});
    const SceneId second = opened({squareFile("second.gltf"), "", {}});
    EXPECT_EQ(worker_.opened()->id, second);
    worker_.open({"", "sculpture", {}});
    EXPECT_TRUE(worker_.status().loading);
    EXPECT_EQ(worker_.status().doing, Status::Doing::loading);
    worker_.abortOpening();
    EXPECT_TRUE(worker_.waitUntilDrawn(patience));
    EXPECT_FALSE(worker_.status().loading);
    EXPECT_EQ(worker_.opened()->id, second);
}

TEST_F(WorkerTest, TracesJudgesAndBeginsAnewWhereTheCameraMoves) {
    const SceneId id = opened({squareFile("traced.gltf"), "", {}});
    Wanted wish = wanted(id, {settingsOf("none"), settingsOf("ray_traced")});
    wish.show = Show::error;
    worker_.want(wish);
    ASSERT_TRUE(worker_.waitUntilDrawn(patience, 64));
    const auto drawn = worker_.newest();
    EXPECT_GE(drawn->referenceRays, 64);
    EXPECT_FALSE(drawn->panes[0].waits);
    EXPECT_EQ(drawn->panes[0].quality.value().rmse, 0); // a square alone: all is open
    EXPECT_GE(drawn->panes[1].rays, 64);
    wish.view.camera.position[0] += 0.1;
    worker_.want(wish);
    ASSERT_TRUE(worker_.waitUntilDrawn(patience));
    EXPECT_LT(worker_.newest()->referenceRays, drawn->referenceRays);
    ASSERT_TRUE(worker_.waitUntilDrawn(patience, 1024));
    EXPECT_EQ(worker_.status().rays, 1024);
    EXPECT_EQ(worker_.status().doing, Status::Doing::nothing);
}

TEST(WorkerWithoutContext, SaysWhy) {
    Worker worker([]() -> std::shared_ptr<void> { throw Error("no context to be had"); }, [] {});
    worker.want(wantedOf(1, {settingsOf("none")}));
    EXPECT_TRUE(worker.waitUntilDrawn(patience));
    EXPECT_EQ(worker.status().error, "no context to be had");
}

// Whatever comes in whatever order, from opening to closing in the midst of it.
TEST(WorkerStress, SurvivesWhateverComes) {
    Random random(1, "stress");
    const std::string file = squareFile("stress.gltf");
    for (int closed = 0; closed < 20; ++closed) {
        Worker worker(context, [] {});
        SceneId id = 0;
        for (int i = 0; i < 10; ++i) {
            Wanted wish = wantedOf(id, {settingsOf(random.below(2) ? "none" : "ray_traced")});
            wish.width = 16 + static_cast<int>(random.below(16));
            wish.height = 16;
            switch (random.below(6)) {
            case 0:
                id = worker.open({random.below(4) ? file : file + "x", "", {}});
                break;
            case 1:
                worker.abortOpening();
                break;
            case 2:
                wish.reference = true;
                [[fallthrough]];
            case 3:
                wish.view.camera.position[0] += static_cast<double>(random.below(100));
                worker.want(std::move(wish));
                break;
            case 4:
                worker.probe(std::array{3, 4});
                EXPECT_LE(worker.status().share, 1);
                break;
            default:
                worker.waitUntilDrawn(0.02);
                if (const auto drawn = worker.newest()) {
                    EXPECT_EQ(drawn->panes.size(), 1U);
                }
            }
        }
    }
}

} // namespace
} // namespace obscura
