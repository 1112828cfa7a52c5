// Alchemy, its CS562 variant and SAO against their own limits of infinitely many samples: sheet
// A.3's curbs seen from above, each by quadrature here and as the sheet has it.
#include "renderer/builtin/builtin.h"
#include "renderer/render.h"
#include "tests/renderer/techniques/limits_fixture.h"

#include <initializer_list>
#include <utility>

namespace obscura {
namespace {

struct Curb {
    double distance, step;
};
constexpr Curb curbs[] = {{0.25, 0.5}, {0.5, 0.5}, {0.1, 0.2}, {0.25, 2}};

class ObscuranceLimits : public Limits {
  protected:
    static constexpr int size = 161;    // pixels; taps leave the others' 16 rows for good
    static constexpr double away = 200; // radii from the camera to the floor
    static constexpr int inside = 29;   // rows about the centre whose discs lie within the image

    using Limit = double (*)(const Curb&, const Settings&);

    // The mean over the disc of `term`(r) beyond the edge, an arc of arccos(d / r) to either side
    // of the wall's direction. Taps have distance r with density 2 r where they are even, 1 where r
    // is linear. The surfaces' v is (r, h), its height above the plane less the bias is `raised`.
    template <typename Term>
    static double overDisc(const Curb& curb, bool even, Term term) {
        constexpr int steps = 20000;
        double sum = 0;
        for (int i = 0; i < steps; ++i) {
            const double r = curb.distance + (1 - curb.distance) * (i + 0.5) / steps;
            sum += std::acos(curb.distance / r) / M_PI * (even ? 2 * r : 1) *
                   term(r * r + curb.step * curb.step);
        }
        return sum * (1 - curb.distance) / steps;
    }
    static double raised(const Curb& curb, double bias) { return std::max(curb.step - bias, 0.0); }

    static double formTwo(const Curb& curb, const Settings& settings) {
        const double h = raised(curb, settings["bias"] * away);
        return overDisc(curb, true, [&](double square) {
            return settings["insideSphere"] > 0 && square > 1
                       ? 0
                       : 2 * h / (square + settings["epsilon"]);
        });
    }
    static double formOne(const Curb& curb, const Settings& settings) {
        const double h = raised(curb, settings["bias"] * away), u = settings["falloffStart"];
        const bool even = settings.technique().id == "alchemy_form1";
        return overDisc(curb, even, [&](double square) {
            return square > 1 ? 0 : 2 * M_PI * u * h / std::max(u * u, square);
        });
    }
    static double scalable(const Curb& curb, const Settings& settings) {
        const double h = raised(curb, settings["bias"]);
        return overDisc(curb, false, [&](double square) {
            return 5 * std::pow(std::max(1 - square, 0.0), 3) * h / (square + settings["epsilon"]);
        });
    }

    // Without what keeps the estimators robust, which the sheet's limits have not. The low
    // intensity keeps noise from being clamped where a limit is near 1; `occlusion` undoes it.
    static Settings exact(const char* id) {
        Settings settings = unfiltered(id, 384);
        settings.set("bias", 0);
        settings.set("intensity", 0.25);
        for (const auto& [name, value] :
             {std::pair{"epsilon", 1e-6}, std::pair{"mipOffset", 16.0}, std::pair{"turns", 147.0}})
            if (settings.has(name))
                settings.set(name, value);
        return settings;
    }
    static Settings exact(const char* id,
                          std::initializer_list<std::pair<const char*, double>> set) {
        Settings settings = exact(id);
        for (const auto& [name, value] : set)
            settings.set(name, value);
        return settings;
    }

    // Mean occlusion at the curb's distance. A pixel is 1 / (n + 1/2) of that distance, so that the
    // edge lies between two pixel columns.
    static double occlusion(const Curb& curb, const Settings& settings) {
        const double pixels = (std::floor(62 * curb.distance) + 0.5) / curb.distance;
        Camera camera;
        camera.position = {0, away, 0};
        camera.up = {0, 0, -1};
        camera.fovDegrees = 2 * std::atan(size / pixels / 2 / away) * 180 / M_PI;
        const Scene scene =
            Limits::curb(static_cast<float>(curb.distance), static_cast<float>(curb.step));
        const Image image = visibilityOf(scene, camera, settings, size, size);
        double sum = 0;
        for (int y = (size - inside) / 2; y < (size + inside) / 2; ++y)
            sum += 1 - static_cast<double>(image.at(size / 2, y, 0));
        return sum / inside / settings["intensity"];
    }
    static void expectLimit(const Settings& settings, Limit limit, double tolerance) {
        for (const Curb& curb : curbs)
            EXPECT_NEAR(occlusion(curb, settings), limit(curb, settings), tolerance)
                << curb.distance << " " << curb.step;
    }
    // The quadrature itself against sheet A.3, which gives three or four digits.
    static void expectSheet(const Settings& settings, Limit limit, std::array<double, 4> sheet) {
        for (std::size_t i = 0; i < 4; ++i)
            EXPECT_NEAR(limit(curbs[i], settings), sheet[i], 2e-3) << i;
    }
};

TEST_F(ObscuranceLimits, AlchemyBesideACurb) {
    const Settings settings = exact("alchemy");
    expectSheet(settings, formTwo, {0.472, 0.223, 0.485, 0.301});
    expectLimit(settings, formTwo, 0.01);
}

TEST_F(ObscuranceLimits, AlchemyWithinTheSphereBesideACurb) {
    const Settings settings = exact("alchemy", {{"insideSphere", 1}});
    expectSheet(settings, formTwo, {0.380, 0.152, 0.477, 0});
    expectLimit(settings, formTwo, 0.01);
}

TEST_F(ObscuranceLimits, AlchemyFormOneBesideACurb) {
    const Settings settings = exact("alchemy_form1");
    expectSheet(settings, formOne, {0.1192, 0.0476, 0.1499, 0});
    expectLimit(settings, formOne, 0.004);
}

// The sheet's row for CS562 has the even disc; the report's own taps are not even.
TEST_F(ObscuranceLimits, Cs562BesideACurb) {
    const Settings settings = exact("alchemy_cs562");
    expectSheet(settings, formOne, {0.1095, 0.0342, 0.1983, 0});
    expectLimit(settings, formOne, 0.004);
}

TEST_F(ObscuranceLimits, ScalableBesideACurb) {
    const Settings settings = exact("sao");
    expectSheet(settings, scalable, {0.1033, 0.0084, 0.8589, 0});
    expectLimit(settings, scalable, 0.005);
}

// What keeps the estimators robust, each a tenth of a radius or more so that it shows.
TEST_F(ObscuranceLimits, BiasEpsilonAndFalloffEnterAsTheirFormulasSay) {
    expectLimit(exact("alchemy", {{"bias", 0.1 / away}, {"epsilon", 0.1}}), formTwo, 0.01);
    expectLimit(exact("alchemy_form1", {{"bias", 0.1 / away}, {"falloffStart", 0.5}}), formOne,
                0.01);
    expectLimit(exact("sao", {{"bias", 0.1}, {"epsilon", 0.1}}), scalable, 0.005);
}

// The report's delta goes with the tap's depth: of a floor 2 m below the camera and a step on it,
// whose top is h above every pixel's plane and 2 - h deep, each term shrinks by delta (2 - h) / h.
TEST_F(ObscuranceLimits, Cs562sBiasIsOfTheTapsDepth) {
    constexpr double h = 0.5, delta = 0.29;
    Camera camera;
    camera.position = {0, 2, 0};
    camera.up = {0, 0, -1};
    const auto sumOf = [&](double bias) {
        const Image image = visibilityOf(Limits::curb(0.1f, static_cast<float>(h)), camera,
                                         exact("alchemy_cs562", {{"bias", bias}}), 64, 64);
        double sum = 0;
        for (int y = 16; y < 48; ++y)
            for (int x = 20; x < 32; ++x) // of the floor
                sum += 1 - static_cast<double>(image.at(x, y, 0));
        return sum;
    };
    EXPECT_NEAR(sumOf(delta) / sumOf(0), 1 - delta * (2 - h) / h, 0.01);
}

// The darkest pixel, unfiltered and with default bias, of a tilted plane that fills the view; the
// radius covers `pixels` at its middle, `distance` radii away.
float darkestOfPlane(const char* id, float distance, float tilt, int size, int pixels) {
    const float x = 9 * distance, c = x * std::cos(glm::radians(tilt)),
                s = x * std::sin(glm::radians(tilt));
    Scene scene;
    addQuad(scene,
            {glm::vec3(-x, -c, s), glm::vec3(x, -c, s), glm::vec3(x, c, -s), glm::vec3(-x, c, -s)});
    Camera camera;
    camera.position = {0, 0, static_cast<double>(distance)};
    camera.fovDegrees =
        2 * std::atan(0.5 * size / pixels / static_cast<double>(distance)) * 180 / M_PI;
    Settings settings(technique(id));
    settings.set("radius", 1);
    settings.set("blur", 0);
    const Image image = visibilityOf(scene, camera, settings, size, size);
    return *std::min_element(image.pixels.begin(), image.pixels.end());
}

// Rounding of depth must not show as occlusion.
TEST_F(ObscuranceLimits, APlaneIsOpenUpToAThousandRadiiAway) {
    for (const char* id : {"alchemy", "alchemy_form1", "alchemy_cs562", "sao"})
        for (const float distance : {10.0f, 100.0f, 1000.0f})
            for (const float tilt : {0.0f, 60.0f, 80.0f})
                EXPECT_GT(darkestOfPlane(id, distance, tilt, 64, 24), 0.98f)
                    << id << " " << distance << " " << tilt;
}

// Nor must the hierarchy, whose texels stand for pixels up to 8 apart here.
TEST_F(ObscuranceLimits, ATiltedPlaneIsOpenThroughTheHierarchy) {
    for (const float tilt : {0.0f, 30.0f, 60.0f, 80.0f}) {
        EXPECT_GT(darkestOfPlane("sao", 10, tilt, 200, 190), 0.98f) << tilt;
    }
}

// Nor does it lose occlusion: the default offset keeps the limit, up to what moves the edge by.
TEST_F(ObscuranceLimits, TheHierarchyKeepsTheLimit) {
    expectLimit(exact("sao", {{"mipOffset", 3}}), scalable, 0.02);
}

// The band is rendered for the technique alone and cut off again: away from the border, pictures
// with and without it differ by noise only (it was once lost on the way, and all was open).
TEST_F(ObscuranceLimits, TheGuardBandReachesPictures) {
    Recipe recipe;
    recipe.width = recipe.height = 48;
    recipe.view.builtin = "sculpture";
    recipe.view.camera.position = {0, 1.5, 4};
    recipe.view.camera.target = {0, 1, 0};
    recipe.level.ambient = Vec3{1, 1, 1};
    recipe.sceneSha256 = builtinScene("sculpture").sha256;
    recipe.technique = "sao";
    RecipeRenderer renderer{Folders{}};
    const auto meanOcclusion = [&](double guardBand) {
        recipe.settings = {{"guardBand", guardBand}, {"radius", 1}};
        return renderer.render(recipe).meanOcclusion;
    };
    const double without = meanOcclusion(0);
    EXPECT_GT(without, 0.1);
    EXPECT_NEAR(meanOcclusion(0.2), without, 0.05);
}

} // namespace
} // namespace obscura
