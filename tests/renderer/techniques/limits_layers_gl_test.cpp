// What GTAO and the visibility bitmask know of things that other things hide, by further layers of
// depth.
#include "tests/renderer/techniques/slices_fixture.h"

namespace obscura {
namespace {

class LayersLimits : public SlicesLimits {
  protected:
    // A sheet beside the tested point, and above it roofs, more than a radius above the point, that
    // hide it from the camera and occlude nothing. Those at `heights` are over each other.
    static Scene hiddenSheet(double near, double far, double h, std::vector<float> heights) {
        Scene scene = sheet(near, far, h);
        const auto a = static_cast<float>(near), b = static_cast<float>(far);
        for (const float height : heights)
            addStrip(scene, a - 0.03f, height, b + 0.06f, height);
        return scene;
    }
    static Settings withLayers(const char* id, int count) {
        Settings settings = exact(id);
        settings.set("layers", count);
        return settings;
    }
};

// As ExactHorizonBesideACurb, under roofs.
TEST_F(LayersLimits, GtaoFindsTheHorizonUnderARoof) {
    const double expected[] = {0.2676, 0.1273, 0.2760};
    const auto beside = [](const Curb& c, std::vector<float> heights, int layers) {
        return occlusionFrom(above(c.distance, 1),
                             hiddenSheet(c.distance, c.distance + 0.12, c.step, heights),
                             withLayers("gtao", layers));
    };
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(beside(curbs[i], {2}, 1), 0, 1e-3) << i;
        EXPECT_NEAR(beside(curbs[i], {2}, 2), expected[i], 0.01) << i;
    }
    EXPECT_NEAR(beside(curbs[0], {2, 3}, 2), 0, 1e-3);
    EXPECT_NEAR(beside(curbs[0], {2, 3}, 3), expected[0], 0.01);
}

// What lies nearer behind a layer than the separation, a tenth of the radius, is skipped.
TEST_F(LayersLimits, TwoRoofsCloseTogetherAreOneLayer) {
    const auto under = [](std::vector<float> heights) {
        return occlusionFrom(above(0.25, 1), hiddenSheet(0.25, 0.37, 0.5, heights),
                             withLayers("gtao", 2));
    };
    EXPECT_NEAR(under({2, 2.08f}), 0.2676, 0.01);
    EXPECT_NEAR(under({2, 2.12f}), 0, 1e-3);
}

// As BitmaskBesideAFloatingBar, under roofs.
TEST_F(LayersLimits, BitmaskFindsAFloatingBarUnderARoof) {
    const Scene one = hiddenSheet(0.2, 0.5, 0.4, {2}), two = hiddenSheet(0.2, 0.5, 0.4, {2, 3});
    for (const double thickness : {0.06, 0.3}) {
        const double expected = sheetLimit(0.2, 0.5, 0.4, thickness);
        const auto under = [thickness](const Scene& scene, int layers) {
            Settings settings = withLayers("visibility_bitmask", layers);
            settings.set("thickness", thickness);
            return occlusionFrom(above(0.2, 1), scene, settings);
        };
        EXPECT_NEAR(under(one, 1), 0, 1e-3) << thickness;
        EXPECT_NEAR(under(one, 2), expected, 0.01) << thickness;
        EXPECT_NEAR(under(two, 2), 0, 1e-3) << thickness;
        EXPECT_NEAR(under(two, 3), expected, 0.01) << thickness;
    }
}

// Layers are those of the pixels that are worked on.
TEST_F(LayersLimits, EverySecondPixelSeesTheSameLayers) {
    for (const char* id : {"gtao", "visibility_bitmask"}) {
        Settings settings = withLayers(id, 2);
        settings.set("downscale", 2);
        EXPECT_NEAR(occlusionFrom(above(0.25, 1), hiddenSheet(0.25, 0.37, 0.5, {2}), settings),
                    occlusionFrom(above(0.25, 1), sheet(0.25, 0.37, 0.5),
                                  [&] {
                                      Settings open = exact(id);
                                      open.set("downscale", 2);
                                      return open;
                                  }()),
                    0.01)
            << id;
    }
}

} // namespace
} // namespace obscura
