#include "renderer/techniques/fetches.h"
#include "viewer/state.h"
#include "viewer/worker.h"

#include <gtest/gtest.h>

namespace obscura {
namespace {

Opened opened() {
    Opened scene;
    scene.id = 7;
    scene.bounds = {{0, 0, 0}, {3, 4, 12}}; // a diagonal of 13 m
    scene.camera = {{1, 2, 10}, {1, 2, 0}, {0, 1, 0}, 60, 0.1};
    scene.radius = 0.75;
    scene.cameras.push_back({"door", {{0, 1, 0}, {0, 1, 5}, {0, 1, 0}, 40, 0}});
    return scene;
}

TEST(ViewerState, AnOpenedSceneBringsItsViewsAndItsRadiusToEveryPane) {
    State state;
    adopt(state, opened());
    EXPECT_NEAR(state.size, 13, 1e-5);
    EXPECT_EQ(state.view.camera.fovDegrees, 60);
    for (const Settings& settings : state.panes)
        EXPECT_EQ(settings.has("radius") ? settings["radius"] : 0.75F, 0.75F);
    ASSERT_EQ(state.views.size(), 2U);
    EXPECT_EQ(state.views[1].name, "door");
}

TEST(ViewerState, ViewsGoRoundBothWaysAndStoredOnesJoinThem) {
    State state;
    adopt(state, opened());
    cycleViews(state, -1);
    EXPECT_EQ(state.view.camera.fovDegrees, 40);
    cycleViews(state, 1);
    EXPECT_EQ(state.view.camera.fovDegrees, 60);
    state.view.camera.fovDegrees = 33;
    EXPECT_EQ(storeView(state), "stored-1");
    EXPECT_EQ(storeView(state), "stored-2");
    cycleViews(state, 1);
    cycleViews(state, -2);
    EXPECT_EQ(state.views[static_cast<std::size_t>(state.viewAt)].name, "stored-1");
    EXPECT_EQ(state.view.camera.fovDegrees, 33);
}

TEST(ViewerState, OneRadiusIsThatOfAllTechniques) {
    State state;
    setRadius(state, 2);
    setTechnique(state, 0, technique("sao"));
    EXPECT_EQ(state.panes[0]["radius"], 2);
    EXPECT_EQ(state.panes[1]["radius"], 2);
}

TEST(ViewerState, WhatIsWantedFollowsTheLayout) {
    State state;
    const Box area{0, 0, 800, 600};
    state.layout = Layout::grid;
    EXPECT_EQ(wantedOf(state, area, 2).panes.size(), 4U);
    EXPECT_EQ(wantedOf(state, area, 2).width, 399);
    state.layout = Layout::difference;
    state.renderScale = 0.5;
    EXPECT_TRUE(wantedOf(state, area, 2).difference);
    EXPECT_EQ(wantedOf(state, area, 2).width, 400);
    state.divider = 0.9; // which draws nothing anew
    EXPECT_EQ(wantedOf(state, area, 2), wantedOf(state, area, 2));
}

// Every technique that counts its samples comes within a quarter of the fetches it is to make.
TEST(ViewerState, SameSamplesIsAsManyFetches) {
    for (const char* id : {"starcraft", "hbao", "gtao", "sao", "alchemy", "ray_march"}) {
        const Settings matched = withFetches(Settings(technique(id)), 120);
        EXPECT_NEAR(fetchesPerPixel(matched), 120, 30) << id;
    }
    const Settings none(technique("none"));
    EXPECT_EQ(withFetches(none, 50).values(), none.values());

    State state;
    state.sameSamples = true;
    setTechnique(state, 0, technique("starcraft"));
    setTechnique(state, 1, technique("hbao"));
    EXPECT_NEAR(fetchesPerPixel(state.panes[1]), fetchesPerPixel(state.panes[0]),
                fetchesPerPixel(state.panes[0]) / 4);
}

} // namespace
} // namespace obscura
