#pragma once

#include "tests/renderer/techniques/limits_fixture.h"

namespace obscura {

// Sheet A.3's curbs, and what GTAO and the visibility bitmask tend to beside them, sheets and bars.
constexpr struct Curb {
    double distance, step;
} curbs[] = {{0.25, 0.5}, {0.5, 0.5}, {0.1, 0.2}, {0.25, 2}};

class SlicesLimits : public Limits {
  protected:
    // A hard radius of 1 m and nothing that only serves speed or looks.
    static Settings exact(const char* id) {
        Settings settings = neutral(id);
        for (const auto& [name, value] :
             std::initializer_list<std::pair<const char*, double>>{{"slices", 16},
                                                                   {"steps", 64},
                                                                   {"samplePower", 1},
                                                                   {"levelOffset", 16},
                                                                   {"denoise", 0},
                                                                   {"falloff", 0},
                                                                   {"minimumVisibility", 0},
                                                                   {"thickness", 1e6}})
            if (settings.has(name))
                settings.set(name, value);
        return settings;
    }

    // From straight above and far away, with all that lies within `reach` of the origin towards +x.
    struct Above {
        Camera camera;
        int width, height, column, row; // of the origin
    };
    // Pixels are so large that the edge at `distance` falls a quarter of a pixel before a pixel's
    // middle: that is where taps, rounded to pixels, see it in the mean over azimuths.
    static Above above(double distance, double reach) {
        const double pixel = distance / (std::round(60 * distance) - 0.25);
        const int most = static_cast<int>(std::ceil(reach / pixel)) + 1;
        Above view{{}, most + 5, 2 * most + 1, 4, most};
        view.width += 1 - view.width % 2;
        const double x = ((view.width - 1) / 2 - view.column) * pixel;
        view.camera.position = {x, 200, 0};
        view.camera.target = {x, 0, 0};
        view.camera.up = {0, 0, -1};
        view.camera.fovDegrees = 2 * std::atan(pixel * view.height / 2 / 200) * 180 / M_PI;
        return view;
    }
    static double occlusionFrom(const Above& view, const Scene& scene, const Settings& settings) {
        const Image image = visibilityOf(scene, view.camera, settings, view.width, view.height);
        double sum = 0;
        for (int y = view.row - 4; y <= view.row + 4; ++y)
            sum += 1 - static_cast<double>(image.at(view.column, y, 0));
        return sum / 9;
    }
    // A sheet at height h from x = near to x = far above a floor of which only the tested point is
    // there: pixels of the rest would be dark, cost time, and change nothing.
    static Scene sheet(double near, double far, double h) {
        Scene scene;
        const auto a = static_cast<float>(near), b = static_cast<float>(far);
        addQuad(scene, {glm::vec3(-0.09f, 0, 0.15f), glm::vec3(0.09f, 0, 0.15f),
                        glm::vec3(0.09f, 0, -0.15f), glm::vec3(-0.09f, 0, -0.15f)});
        addStrip(scene, a, static_cast<float>(h), b, static_cast<float>(h));
        return scene;
    }
    // Of a curb's top, only its rim counts where light passes behind nothing.
    static double besideCurb(const Curb& c, const Settings& settings, double reach = 1) {
        return occlusionFrom(above(c.distance, reach), sheet(c.distance, c.distance + 0.12, c.step),
                             settings);
    }

    // The mean over azimuths of the cosine-weighted share of a slice, seen from above, between two
    // angles from the vertical on its one occluded side: (cos 2a - cos 2b) / 4.
    template <typename Arc>
    static double overAzimuths(Arc arc) {
        double sum = 0;
        constexpr int count = 4000;
        for (int i = 0; i < count; ++i) {
            const auto [a, b] = arc(std::cos((i + 0.5) / count * M_PI / 2));
            sum += std::max(0.0, std::cos(2 * a) - std::cos(2 * std::min(b, M_PI / 2))) / 4;
        }
        return sum / count;
    }
    // A sheet at height h from x = near to x = far, `thickness` deep, and a hard radius of 1 m. In
    // a slice x stretches by 1 / cosine; fronts and backs move outwards continuously, so the union
    // of all taps' arcs is one arc.
    static double sheetLimit(double near, double far, double h, double thickness) {
        return overAzimuths([&](double cosine) {
            const double within = std::sqrt(std::max(0.0, 1 - h * h));
            const double from = near / cosine, to = std::min(far / cosine, within);
            return from > to ? std::pair(0.0, 0.0)
                             : std::pair(std::atan2(from, h), std::atan2(to, h - thickness));
        });
    }
};

} // namespace obscura
