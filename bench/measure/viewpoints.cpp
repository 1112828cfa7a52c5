#include "bench/measure/viewpoints.h"

#include "base/random.h"
#include "renderer/probe.h"
#include "renderer/reference/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace obscura {

namespace {

constexpr int width = 48, height = 27, rays = 8, candidatesPerCamera = 16;
constexpr double fovDegrees = 55;

Vec3 arrayOf(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

Camera inside(const Bounds& bounds, Random& random) {
    const glm::dvec3 low(bounds.low), size = glm::dvec3(bounds.high) - low;
    const glm::dvec3 position =
        low + size * glm::dvec3(0.05 + 0.9 * random.uniform(), 0.05 + 0.5 * random.uniform(),
                                0.05 + 0.9 * random.uniform());
    const double turn = 2 * std::numbers::pi * random.uniform(),
                 tilt = 0.5 * (random.uniform() - 0.5);
    Camera camera;
    camera.position = arrayOf(position);
    camera.target = arrayOf(position + 0.3 * glm::length(size) *
                                           glm::dvec3(std::cos(turn), tilt, std::sin(turn)));
    return camera;
}

Camera around(const Bounds& bounds, Random& random) {
    const glm::dvec3 low(bounds.low), high(bounds.high), middle = 0.5 * (low + high);
    const double distance = glm::length(high - low) * (0.45 + 0.45 * random.uniform()),
                 turn = 2 * std::numbers::pi * random.uniform(), rise = 0.8 * random.uniform();
    Camera camera;
    camera.position = arrayOf(
        middle + distance * glm::normalize(glm::dvec3(std::cos(turn), rise, std::sin(turn))));
    camera.target = arrayOf(middle);
    return camera;
}

// Higher is better; below 0 the view is of no use. A good view shows much surface, none of it
// against the lens, and occlusion that varies, because that is what a technique can get wrong.
double interest(const Subject& subject, const RayTracer& tracer, const Camera& camera,
                double radius) {
    const Probe probe(subject, camera, width, height, Normals::smooth, 1);
    const Surfaces& surfaces = probe.surfaces();
    std::vector<float> depths;
    for (std::size_t i = 0; i < surfaces.depth.size(); ++i)
        if (!surfaces.empty(i))
            depths.push_back(surfaces.depth[i]);
    const double shown =
        static_cast<double>(depths.size()) / static_cast<double>(surfaces.depth.size());
    if (shown < 0.12)
        return -1;
    const auto twentieth = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 20);
    std::nth_element(depths.begin(), twentieth, depths.end());
    if (static_cast<double>(*twentieth) < radius)
        return -1;
    TraceSettings settings;
    settings.radius = radius;
    settings.rays = rays;
    const Image visibility = tracer.trace(surfaces, settings).visibility;
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < visibility.pixels.size(); ++i)
        if (probe.shown()[i]) {
            const auto value = static_cast<double>(visibility.pixels[i]);
            sum += value;
            squares += value * value;
        }
    const auto count = static_cast<double>(depths.size());
    const double mean = sum / count, variance = squares / count - mean * mean;
    return mean < 0.2 ? -1 : shown * std::sqrt(std::max(variance, 0.0)); // dark: inside something
}

// How unlike two cameras are: distance between them and of what they look at, in scene sizes.
double apart(const Camera& a, const Camera& b, double size) {
    const auto vec = [](const Vec3& v) { return glm::dvec3(v[0], v[1], v[2]); };
    return (glm::distance(vec(a.position), vec(b.position)) +
            0.5 * glm::distance(vec(a.target), vec(b.target))) /
           size;
}

} // namespace

std::vector<View> viewpoints(const View& like, const Folders& folders, int count,
                             std::uint64_t seed) {
    const Scene scene = loadSceneOf(like, folders);
    const Subject subject(scene);
    const RayTracer tracer(scene);
    const Bounds bounds = subject.scene().bounds();
    const double size = static_cast<double>(glm::length(bounds.high - bounds.low));
    Random random(seed, "viewpoints");
    struct Candidate {
        Camera camera;
        double interest;
    };
    std::vector<Candidate> candidates;
    for (int i = 0; i < count * candidatesPerCamera; ++i) {
        Camera camera = i % 2 ? around(bounds, random) : inside(bounds, random);
        camera.fovDegrees = fovDegrees;
        camera.near = std::min(camera.near, 0.05 * like.radius);
        const double value = interest(subject, tracer, camera, like.radius);
        if (value > 0)
            candidates.push_back({camera, value});
    }
    std::vector<View> views;
    while (static_cast<int>(views.size()) < count) {
        const Candidate* best = nullptr;
        double most = 0;
        for (const Candidate& candidate : candidates) {
            double nearest = 1;
            for (const View& taken : views)
                nearest = std::min(nearest, apart(candidate.camera, taken.camera, size));
            if (candidate.interest * nearest > most) {
                most = candidate.interest * nearest;
                best = &candidate;
            }
        }
        if (!best)
            throw Error(fmt::format("expected {} cameras that see surfaces with occlusion within "
                                    "{:g} m, found {}; try another --radius, or write the views "
                                    "down in a study",
                                    count, like.radius, views.size()));
        View view = like;
        view.name = fmt::format("camera-{}", views.size() + 1);
        view.camera = best->camera;
        views.push_back(std::move(view));
    }
    return views;
}

} // namespace obscura
