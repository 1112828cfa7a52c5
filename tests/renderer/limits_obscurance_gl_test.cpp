// Alchemy, its CS562 variant and SAO against their own limits of infinitely many samples: sheet
// A.3's curbs seen from above, each by quadrature here and as the sheet has it.
#include "tests/renderer/limits_fixture.h"

#include <functional>

namespace obscura {
namespace {

struct Curb {
    double distance, step;
};
constexpr Curb curbs[] = {{0.25, 0.5}, {0.5, 0.5}, {0.1, 0.2}, {0.25, 2}};

class ObscuranceLimits : public Limits {
  protected:
    static constexpr int size = 161;  // pixels; taps leave the others' 16 rows for good
    static constexpr int inside = 29; // rows about the centre whose discs lie within the image

    // The mean over both ring angle and radius r of `term`(r) on the part of the disc beyond the
    // edge: an arc of arccos(d / r) to either side. `density` is that of r.
    static double overDisc(const Curb& curb, const std::function<double(double)>& term,
                           const std::function<double(double)>& density) {
        constexpr int steps = 200000;
        double sum = 0;
        for (int i = 0; i < steps; ++i) {
            const double r = curb.distance + (1 - curb.distance) * (i + 0.5) / steps;
            sum += std::acos(curb.distance / r) / M_PI * term(r) * density(r);
        }
        return sum * (1 - curb.distance) / steps;
    }
    static double even(double r) { return 2 * r; }
    static double linear(double) { return 1; }

    static double formTwo(const Curb& curb, double reach) {
        const double h = curb.step;
        const auto term = [&](double r) {
            return r * r + h * h > reach * reach ? 0 : 2 * h / (r * r + h * h);
        };
        return overDisc(curb, term, even);
    }
    static double formOne(const Curb& curb, const std::function<double(double)>& density) {
        const double h = curb.step, u = 0.1;
        const auto term = [&](double r) {
            return r * r + h * h > 1 ? 0 : 2 * M_PI * u * h / std::max(u * u, r * r + h * h);
        };
        return overDisc(curb, term, density);
    }
    static double scalable(const Curb& curb) {
        const double h = curb.step;
        const auto term = [&](double r) {
            const double square = r * r + h * h;
            return 5 * std::pow(std::max(1 - square, 0.0), 3) * h / square;
        };
        return overDisc(curb, term, linear);
    }

    // Without what keeps the estimators robust, which the limits have not. Intensity 0.5 keeps
    // noise from being clamped where a limit is near 1; undone in `occlusion`.
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

    // Mean occlusion at the curb's distance. A pixel is 1 / (n + 1/2) of that distance, so that the
    // edge lies between two pixel columns.
    static double occlusion(const Curb& curb, const Settings& settings) {
        const double pixels = (std::floor(62 * curb.distance) + 0.5) / curb.distance;
        Camera camera;
        camera.position = {0, 200, 0};
        camera.up = {0, 0, -1};
        camera.fovDegrees = 2 * std::atan(size / pixels / 2 / 200) * 180 / M_PI;
        const Scene scene =
            Limits::curb(static_cast<float>(curb.distance), static_cast<float>(curb.step));
        const Image image = visibilityOf(scene, camera, settings, size, size);
        double sum = 0;
        for (int y = (size - inside) / 2; y < (size + inside) / 2; ++y)
            sum += 1 - static_cast<double>(image.at(size / 2, y, 0));
        return sum / inside / settings["intensity"];
    }
    static void expectLimit(const Settings& settings,
                            const std::function<double(const Curb&)>& limit,
                            const std::vector<double>& sheet) {
        for (int i = 0; i < 4; ++i) {
            if (!sheet.empty()) {
                EXPECT_NEAR(limit(curbs[i]), sheet[static_cast<std::size_t>(i)], 2e-3) << i;
            }
            const double found = occlusion(curbs[i], settings);
            EXPECT_NEAR(found, limit(curbs[i]), 0.01) << i;
            if (std::getenv("OBSCURA_SHOW"))
                std::printf("%s curb %d: limit %.4f found %.4f\n",
                            std::string(settings.technique().id).c_str(), i, limit(curbs[i]),
                            found);
        }
    }
};

TEST_F(ObscuranceLimits, AlchemyBesideACurb) {
    expectLimit(exact("alchemy"), [](const Curb& c) { return formTwo(c, 1e9); },
                {0.472, 0.223, 0.485, 0.301});
}

TEST_F(ObscuranceLimits, AlchemyWithinTheSphereBesideACurb) {
    Settings settings = exact("alchemy");
    settings.set("insideSphere", 1);
    expectLimit(settings, [](const Curb& c) { return formTwo(c, 1); }, {0.380, 0.152, 0.477, 0});
}

TEST_F(ObscuranceLimits, AlchemyFormOneBesideACurb) {
    expectLimit(exact("alchemy_form1"), [](const Curb& c) { return formOne(c, even); },
                {0.1192, 0.0476, 0.1499, 0});
}

TEST_F(ObscuranceLimits, Cs562BesideACurb) {
    expectLimit(exact("alchemy_cs562"), [](const Curb& c) { return formOne(c, linear); }, {});
}

TEST_F(ObscuranceLimits, ScalableBesideACurb) {
    expectLimit(exact("sao"), scalable, {0.1033, 0.0084, 0.8589, 0});
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

// Nor does it lose occlusion: the default offset gives the limit too, within what the edge moves
// by.
TEST_F(ObscuranceLimits, TheHierarchyKeepsTheLimit) {
    Settings settings = exact("sao");
    settings.set("mipOffset", Settings(technique("sao"))["mipOffset"]);
    for (const Curb& curb : curbs) {
        EXPECT_NEAR(occlusion(curb, settings), scalable(curb), 0.02) << curb.distance;
    }
}

} // namespace
} // namespace obscura
