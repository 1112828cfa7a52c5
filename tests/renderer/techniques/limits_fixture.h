#pragma once

#include "tests/renderer/techniques/occlusion_fixture.h"

#include <algorithm>
#include <cmath>

namespace obscura {

// Scenes whose limits of infinitely many samples are known in closed form: prisms along z, seen
// from straight above and so far away that rays are parallel to 0.4 degrees. The pixel column under
// test lies exactly on the edge, or at its distance from the wall. The radius is 1 m.
class Limits : public GlTest {
  protected:
    static constexpr float length = 50; // of the prisms, metres
    static constexpr int width = 513, height = 16;
    static constexpr double field = 2.6; // metres across the image

    // A strip from (x0, y0) to (x1, y1) along z, facing up.
    static void addStrip(Scene& scene, float x0, float y0, float x1, float y1) {
        addQuad(scene, {glm::vec3(x0, y0, length), glm::vec3(x1, y1, length),
                        glm::vec3(x1, y1, -length), glm::vec3(x0, y0, -length)});
    }
    static Scene wedge(float slope) { // y = slope |x|
        Scene scene;
        addStrip(scene, -5, 5 * slope, 0, 0);
        addStrip(scene, 0, 0, 5, 5 * slope);
        return scene;
    }
    // A floor, and from x = `distance` on a step of that height.
    static Scene curb(float distance, float step) {
        Scene scene;
        addStrip(scene, -5, 0, distance, 0);
        addStrip(scene, distance, step, 5, step);
        return scene;
    }

    // A radius of 1 m, and the technique's own result: what matching fits is neutral.
    static Settings neutral(const char* id) {
        Settings settings(technique(id));
        settings.set("radius", 1);
        for (const char* name : {"radiusMultiplier", "intensity", "power"})
            if (settings.has(name))
                settings.set(name, 1);
        return settings;
    }
    static Settings unfiltered(const char* id, int samples) {
        Settings settings = neutral(id);
        settings.set("samples", samples);
        settings.set("blur", 0);
        return settings;
    }

    // The mean of `f` of visibility over the column at x = 0, and over noise tiles of many seeds.
    template <typename Function>
    static double centre(const Scene& scene, const Settings& settings, Function f, int seeds) {
        Camera camera;
        camera.position = {0, 200, 0};
        camera.up = {0, 0, -1};
        camera.fovDegrees = 2 * std::atan(field / 2 * height / width / 200) * 180 / M_PI;
        double sum = 0;
        for (int seed = 0; seed < seeds; ++seed) {
            const Image image = visibilityOf(scene, camera, settings, width, height,
                                             static_cast<std::uint64_t>(seed));
            for (int y = 0; y < height; ++y)
                sum += f(static_cast<double>(image.at(width / 2, y, 0)));
        }
        return sum / (height * seeds);
    }
    static double centre(const Scene& scene, const Settings& settings) {
        return centre(
            scene, settings, [](double v) { return v; }, 1);
    }
};

} // namespace obscura
