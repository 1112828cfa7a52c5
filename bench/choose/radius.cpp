#include "bench/choose/radius.h"

#include "bench/measure/timing.h"
#include "bench/measure/viewpoints.h"
#include "renderer/probe.h"
#include "renderer/reference/reference.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace obscura {

namespace {

constexpr int width = 48, height = 27, rays = 16;
constexpr double share = 1.0 / 16;            // of the picture's height
constexpr double hardly = 0.05, mostly = 0.5; // occluded, on average
constexpr int mostSteps = 4;

// Cameras that see nothing nearer than a good part of the scene's size, for the first look at it; a
// smaller part where there are none.
std::vector<View> firstCameras(View view, const Folders& folders, int cameras, std::uint64_t seed,
                               double size) {
    for (const int part : {8, 16}) {
        view.radius = size / part;
        try {
            return viewpoints(view, folders, cameras, seed);
        } catch (const Error&) {
        }
    }
    view.radius = size / 32;
    return viewpoints(view, folders, cameras, seed);
}

// Over the pixels of all cameras that show a surface.
double meanOcclusion(const std::vector<Probe>& probes, const RayTracer& tracer, double radius) {
    TraceSettings settings;
    settings.radius = radius;
    settings.rays = rays;
    double sum = 0, count = 0;
    for (const Probe& probe : probes) {
        const Image visibility = tracer.trace(probe.surfaces(), settings).visibility;
        for (std::size_t i = 0; i < visibility.pixels.size(); ++i)
            if (probe.shown()[i]) {
                sum += 1 - static_cast<double>(visibility.pixels[i]);
                ++count;
            }
    }
    return sum / count;
}

} // namespace

double roundRadius(double metres) {
    const double power = std::pow(10, std::floor(std::log10(metres)));
    double best = power;
    for (const double factor : {2.0, 5.0, 10.0})
        if (std::abs(std::log(factor * power / metres)) < std::abs(std::log(best / metres)))
            best = factor * power;
    return best;
}

SuggestedRadius suggestedRadius(const View& like, const Folders& folders, int cameras,
                                std::uint64_t seed) {
    const Scene scene = loadSceneOf(like, folders);
    const Subject subject(scene);
    const RayTracer tracer(scene);
    const Bounds bounds = scene.bounds();
    std::vector<Probe> probes;
    std::vector<double> depths;
    double fovDegrees = 0;
    for (const View& found :
         firstCameras(like, folders, cameras, seed,
                      static_cast<double>(glm::length(bounds.high - bounds.low)))) {
        fovDegrees = found.camera.fovDegrees;
        probes.emplace_back(subject, found.camera, width, height, Normals::smooth, seed);
        const Surfaces& surfaces = probes.back().surfaces();
        for (std::size_t i = 0; i < surfaces.depth.size(); ++i)
            if (!surfaces.empty(i))
                depths.push_back(static_cast<double>(surfaces.depth[i]));
    }
    const double depth = summaryOf(depths).median,
                 seen = 2 * depth * std::tan(fovDegrees / 2 * std::numbers::pi / 180);
    const double wanted = roundRadius(share * seen);
    double radius = wanted, occlusion = meanOcclusion(probes, tracer, radius);
    for (int step = 0; step < mostSteps && (occlusion < hardly || occlusion > mostly); ++step) {
        const double factor = occlusion < hardly ? 2 : 0.5,
                     next = meanOcclusion(probes, tracer, radius * factor);
        if (factor > 1 ? next > mostly : next < hardly)
            break; // from one side to the other
        radius *= factor;
        occlusion = next;
    }
    std::string why = fmt::format(
        "{} cameras found in the scene see surfaces at a median depth of {:.3g} m, where the "
        "picture is {:.3g} m high, and {:g} m is about a sixteenth of that",
        cameras, depth, seen, wanted);
    if (radius != wanted)
        why += fmt::format("; {} is occluded within that, so it was {}",
                           radius > wanted ? "hardly anything" : "most of the scene",
                           radius > wanted ? "doubled" : "halved");
    return {radius, why + fmt::format("; within {:g} m, {:.0f} % of what rays could see is "
                                      "occluded, on average",
                                      radius, 100 * occlusion)};
}

} // namespace obscura
