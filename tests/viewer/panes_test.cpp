#include "viewer/panes.h"

#include <gtest/gtest.h>

namespace obscura {
namespace {

const Box area{100, 50, 802, 602};
constexpr double gap = 2;

TEST(Panes, GridHasFourOfOneSizeThatDoNotMeet) {
    const auto panes = placedPanes(Layout::grid, area, gap, 0.5, false);
    ASSERT_EQ(panes.size(), 4u);
    for (const PlacedPane& pane : panes) {
        EXPECT_EQ(pane.place.width, 400);
        EXPECT_EQ(pane.place.height, 300);
        EXPECT_LE(pane.place.right(), area.right());
        EXPECT_LE(pane.place.bottom(), area.bottom());
    }
    EXPECT_EQ(panes[1].place.x, 502);
    EXPECT_EQ(panes[2].place.y, 352);
}

TEST(Panes, SplitShowsTwoPicturesInOnePlace) {
    const auto panes = placedPanes(Layout::split, area, gap, 0.25, false);
    ASSERT_EQ(panes.size(), 2u);
    EXPECT_EQ(panes[0].place.x, panes[1].place.x);
    EXPECT_EQ(panes[0].clip.right(), panes[1].clip.x);
    EXPECT_EQ(panes[0].clip.width, 201); // of 802, rounded
    EXPECT_EQ(panes[1].clip.right(), area.right());
}

TEST(Panes, FlickerShowsOneOfTwoAndDifferenceNeither) {
    EXPECT_EQ(placedPanes(Layout::flicker, area, gap, 0.5, false)[0].pane, 0);
    EXPECT_EQ(placedPanes(Layout::flicker, area, gap, 0.5, true)[0].pane, 1);
    EXPECT_EQ(placedPanes(Layout::difference, area, gap, 0.5, false)[0].pane, -1);
    EXPECT_EQ(panesOf(Layout::difference), 2);
}

TEST(Panes, PicturesHaveThePixelsOfTheirPlaceTimesTheScale) {
    EXPECT_EQ(pictureSize(Layout::single, area, gap, 1), std::pair(802, 602));
    EXPECT_EQ(pictureSize(Layout::sideBySide, area, gap, 0.5), std::pair(200, 301));
    EXPECT_EQ(pictureSize(Layout::single, {0, 0, 1, 1}, gap, 1), std::pair(16, 16));
}

TEST(Panes, MagnifyingKeepsThePointUnderTheCursor) {
    const Magnification once = magnified({}, 4, 0.9, 0.2);
    const auto seen = [](const Magnification& m, double x, double y) {
        const Box part = shownPart(m);
        return std::pair(part.x + x * part.width, part.y + y * part.height);
    };
    EXPECT_NEAR(seen(once, 0.9, 0.2).first, 0.9, 1e-12);
    EXPECT_NEAR(seen(once, 0.9, 0.2).second, 0.2, 1e-12);
    const Magnification back = magnified(once, 0.25, 0.5, 0.5);
    EXPECT_NEAR(back.factor, 1, 1e-12);
    EXPECT_NEAR(back.x, 0.5, 1e-12); // all of it, whatever the cursor was on
    EXPECT_EQ(magnified({}, 1e9, 0, 0).factor, 64);
}

TEST(Panes, DraggingNeverLeavesThePicture) {
    const Magnification twice = magnified({}, 2, 0.5, 0.5);
    EXPECT_NEAR(shifted(twice, 0.1, 0).x, 0.45, 1e-12);
    EXPECT_NEAR(shownPart(shifted(twice, 9, -9)).x, 0, 1e-12);
    EXPECT_NEAR(shownPart(shifted(twice, 9, -9)).bottom(), 1, 1e-12);
}

TEST(Panes, TheProbeSeesThePixelUnderTheCursor) {
    const auto split = placedPanes(Layout::split, {0, 0, 100, 50}, gap, 0.5, false);
    const auto left = pixelAt(split, {}, 200, 100, 10.5, 49.9);
    ASSERT_TRUE(left);
    EXPECT_EQ(left->pane, 0);
    EXPECT_EQ(left->x, 21);
    EXPECT_EQ(left->y, 99);
    EXPECT_EQ(pixelAt(split, {}, 200, 100, 75, 0)->pane, 1);
    EXPECT_EQ(pixelAt(split, magnified({}, 2, 0, 0), 200, 100, 99.9, 0)->x, 99);
    EXPECT_FALSE(pixelAt(split, {}, 200, 100, 100, 10));
}

} // namespace
} // namespace obscura
