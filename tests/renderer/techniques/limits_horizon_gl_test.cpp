// HBAO and its kin against their own limits of infinitely many samples, and against each other.
#include "tests/renderer/techniques/limits_fixture.h"

namespace obscura {
namespace {

struct Curb {
    float distance, step;
};
constexpr Curb curbs[] = {{0.25f, 0.5f}, {0.5f, 0.5f}, {0.1f, 0.2f}, {0.25f, 2}};

// The mean over a quarter turn of a function of the cosine of a line's angle to the curb; the
// other three quarters are its mirror image and two that see no curb.
template <typename Function>
double lines(Function f) {
    const int count = 1000;
    double sum = 0;
    for (int i = 0; i < count; ++i)
        sum += f(std::cos((i + 0.5) / count * M_PI / 2));
    return sum / count / 2;
}

// Occlusion that hbao.glsl's header says; lengths in radii.
double horizonLimit(Curb curb, double attenuation, double biasDegrees) {
    return lines([&](double cosine) {
        const double squared =
            std::pow(curb.distance / cosine, 2) + std::pow(static_cast<double>(curb.step), 2);
        const double rise = curb.step / std::sqrt(squared) - std::sin(biasDegrees * M_PI / 180);
        return squared < 1 && rise > 0 ? (1 - attenuation * squared) * rise : 0;
    });
}

// The same of hbao_plus.glsl: taps evenly along each line, which end at so many radii.
double plusLimit(Curb curb, double bias, double end) {
    return lines([&](double cosine) {
        const int count = 1000;
        double sum = 0;
        for (int i = 0; i < count; ++i) {
            const double along = (i + 0.5) / count * end;
            const double squared = along * along + std::pow(static_cast<double>(curb.step), 2);
            if (along > curb.distance / cosine && squared < 1)
                sum += std::max(curb.step / std::sqrt(squared) - bias, 0.0) * (1 - squared);
        }
        return sum / count;
    });
}

class HorizonLimits : public Limits, public testing::WithParamInterface<const char*> {
  protected:
    // A tap in every pixel of 11 lines, which the noise tile turns, or in every one of the lattice
    // that the row samples.
    static Settings exhaustive(const char* id,
                               std::initializer_list<std::pair<const char*, double>> others) {
        Settings settings = neutral(id);
        settings.set("directions", 11);
        settings.set("steps", 512);
        settings.set("screenReach", 100);
        settings.set("blur", 0);
        for (const auto& [name, value] : others)
            settings.set(name, value);
        return settings;
    }
    static double occlusion(Curb c, const Settings& settings) {
        return 1 - centre(curb(c.distance, c.step), settings);
    }
};

// Sheet A.3, rows "HBAO, no W" and "W = 1 - t^2 / R^2". The last curb's rim is out of reach.

TEST(HorizonIntegral, IsTheSheets) {
    const double withoutW[] = {0.3273, 0.1959, 0.3491, 0}, withW[] = {0.1983, 0.0768, 0.3213, 0};
    for (int i = 0; i < 4; ++i) {
        EXPECT_NEAR(horizonLimit(curbs[i], 0, 0), withoutW[i], 2e-4) << i;
        EXPECT_NEAR(horizonLimit(curbs[i], 1, 0), withW[i], 2e-4) << i;
    }
}

TEST_P(HorizonLimits, BesideACurbWithoutW) {
    for (const Curb& c : curbs)
        EXPECT_NEAR(occlusion(c, exhaustive(GetParam(), {{"angleBias", 0}, {"attenuation", 0}})),
                    horizonLimit(c, 0, 0), 0.01)
            << c.distance << " " << c.step;
}

TEST_P(HorizonLimits, BesideACurb) {
    for (const Curb& c : curbs)
        EXPECT_NEAR(occlusion(c, exhaustive(GetParam(), {{"angleBias", 0}})), horizonLimit(c, 1, 0),
                    0.01)
            << c.distance << " " << c.step;
}

TEST_P(HorizonLimits, TheBiasTakesItsSineOffTheHorizon) {
    for (const Curb& c : {curbs[0], curbs[2]})
        EXPECT_NEAR(occlusion(c, exhaustive(GetParam(), {{"angleBias", 30}})),
                    horizonLimit(c, 1, 30), 0.01)
            << c.distance << " " << c.step;
}

// Of two stairs each counts with its own W, and the second only by what it adds to the horizon.
TEST_P(HorizonLimits, TwoStairsRaiseTheHorizonTwice) {
    const double near = 0.2, low = 0.1, far = 0.4, high = 0.5;
    Scene scene;
    addStrip(scene, -5, 0, 0.2f, 0);
    addStrip(scene, 0.2f, 0.1f, 0.4f, 0.1f);
    addStrip(scene, 0.4f, 0.5f, 5, 0.5f);
    const double expected = lines([&](double cosine) {
        const double first = std::pow(near / cosine, 2) + low * low;
        const double second = std::pow(far / cosine, 2) + high * high;
        const double sine = first < 1 ? low / std::sqrt(first) : 0;
        const double more = second < 1 ? high / std::sqrt(second) - sine : 0;
        return (1 - first) * sine + (1 - second) * std::max(more, 0.0);
    });
    EXPECT_NEAR(1 - centre(scene, exhaustive(GetParam(), {{"angleBias", 0}})), expected, 0.01);
}

TEST_P(HorizonLimits, SlopesAndConvexEdgesAreOpen) {
    const Settings settings = exhaustive(GetParam(), {{"angleBias", 0}, {"attenuation", 0}});
    Scene slope;
    addStrip(slope, -5, -5, 5, 5);
    EXPECT_NEAR(centre(slope, settings), 1, 0.01);
    EXPECT_NEAR(centre(wedge(-1), settings), 1, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Table, HorizonLimits,
                         testing::Values("hbao", "hbao_deinterleaved", "multi_scale"),
                         [](const auto& test) { return std::string(test.param); });

using OneHorizon = HorizonLimits;

// Its values are small, so is what is allowed; beside the nearest curb, five pixels of its lattice
// away, half a lattice pixel more or less is most of the difference.
TEST_F(OneHorizon, PlusBesideACurb) {
    for (const double bias : {0.0, 0.1})
        for (const Curb& c : curbs)
            EXPECT_NEAR(occlusion(c, exhaustive("hbao_plus", {{"bias", bias}})),
                        plusLimit(c, bias, 1), c.distance < 0.2f ? 0.01 : 0.002)
                << c.distance << " " << c.step << " " << bias;
    EXPECT_NEAR(occlusion(curbs[0], exhaustive("hbao_plus", {{"bias", 0.1}, {"lineLength", 0.5}})),
                plusLimit(curbs[0], 0.1, 0.5), 0.005);
}

// Visibility at the whole radius times visibility at half of it, which is a curb twice as large.
TEST_F(OneHorizon, MultipliedScalesBesideACurb) {
    const Settings settings =
        exhaustive("multi_scale", {{"angleBias", 0}, {"multiply", 1}, {"detailRadius", 0.5}});
    for (const Curb& c : {curbs[0], curbs[2]})
        EXPECT_NEAR(1 - occlusion(c, settings),
                    (1 - horizonLimit(c, 1, 0)) *
                        (1 - horizonLimit({2 * c.distance, 2 * c.step}, 1, 0)),
                    0.01)
            << c.distance;
}

// A floor, two walls and a block, through a wide lens; odd sizes leave the layers incomplete.
class Corner : public GlTest {
  protected:
    static Image picture(const char* id,
                         std::initializer_list<std::pair<const char*, double>> others,
                         bool furnished = true) {
        Scene scene;
        addQuad(scene, {glm::vec3(-9, 0, 9), glm::vec3(9, 0, 9), glm::vec3(9, 0, -9),
                        glm::vec3(-9, 0, -9)});
        if (furnished) {
            addQuad(scene, {glm::vec3(-9, 0, -2), glm::vec3(9, 0, -2), glm::vec3(9, 9, -2),
                            glm::vec3(-9, 9, -2)});
            addQuad(scene, {glm::vec3(-2, 0, 9), glm::vec3(-2, 0, -9), glm::vec3(-2, 9, -9),
                            glm::vec3(-2, 9, 9)});
            addQuad(scene, {glm::vec3(-1, 0.7f, 1), glm::vec3(1, 0.7f, 1), glm::vec3(1, 0.7f, -1),
                            glm::vec3(-1, 0.7f, -1)});
        }
        Camera camera;
        camera.position = {1.5, 2, 3};
        camera.target = {-0.5, 0, -1};
        camera.fovDegrees = 75;
        Settings settings(technique(id));
        settings.set("radius", 1);
        settings.set("blur", 0);
        for (const auto& [name, value] : others)
            settings.set(name, value);
        return visibilityOf(scene, camera, settings, 253, 167);
    }
};

TEST_F(Corner, DeinterleavingOnlyMovesWhatIsRead) {
    const Image whole = picture("hbao", {{"ownLayer", 1}});
    const Difference difference = compare(whole, picture("hbao_deinterleaved", {}));
    EXPECT_LT(difference.rms, 1e-3);
    EXPECT_LT(difference.largest, 0.02);
}

// Without that flag the taps differ, but not what they are taken of.
TEST_F(Corner, TheLatticeOfALayerIsUnbiased) {
    const Difference difference =
        compare(picture("hbao", {{"steps", 16}}), picture("hbao_deinterleaved", {{"steps", 16}}));
    EXPECT_LT(std::abs(difference.mean), 0.01);
}

// Tangents follow the line of sight, so no bias is needed to keep a plane open in the corners of a
// wide image.
TEST_F(Corner, AFloorIsOpenThroughAWideLens) {
    for (const char* id : {"hbao", "hbao_deinterleaved", "multi_scale"})
        for (const float value : picture(id, {{"angleBias", 0}}, false).pixels)
            ASSERT_GT(value, 0.99f) << id;
    for (const float value : picture("hbao_plus", {{"bias", 0}}, false).pixels)
        ASSERT_GT(value, 0.99f);
}

} // namespace
} // namespace obscura
