#include "renderer/found_cameras.h"

#include "base/error.h"
#include "base/percentile.h"
#include "base/random.h"
#include "renderer/extent.h"
#include "renderer/frame/vec3.h"
#include "renderer/reference/sight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace obscura {

namespace {

constexpr int glimpseWidth = 48, glimpseHeight = 27, candidatesPerCamera = 16;
constexpr int raysToFind = 8, raysToMeasure = 16; // of a pixel
constexpr double fovDegrees = 55;
constexpr double leastShare = 1.0 / 16;       // of the picture's height
constexpr double hardly = 0.05, mostly = 0.5; // occluded, on average
constexpr double most = 4;                    // times that share, in doubling
constexpr int mostSteps = 4;

Camera within(const Bounds& bounds, Random& random) {
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

std::vector<double> depthsOf(const Surfaces& surfaces) {
    std::vector<double> depths;
    for (std::size_t i = 0; i < surfaces.depth.size(); ++i)
        if (!surfaces.empty(i))
            depths.push_back(static_cast<double>(surfaces.depth[i]));
    return depths;
}

// Adds up the visibility of pixels that show a surface.
struct Sum {
    double values = 0, squares = 0, count = 0;
    void add(const Surfaces& surfaces, const RayTracer& tracer, double radius, int rays) {
        TraceSettings settings;
        settings.radius = radius;
        settings.rays = rays;
        const Image visibility = tracer.trace(surfaces, settings).visibility;
        for (int y = 0; y < surfaces.height; ++y)
            for (int x = 0; x < surfaces.width; ++x)
                if (!surfaces.empty(surfaces.index(x, surfaces.height - 1 - y))) {
                    const auto value = static_cast<double>(visibility.at(x, y, 0));
                    values += value;
                    squares += value * value;
                    ++count;
                }
    }
};

// Higher is better; below 0 the view is of no use. A good view shows much surface, none of it
// against the lens, and occlusion that varies, because that is what a technique can get wrong.
double interest(const Sight& sight, const RayTracer& tracer, const Camera& camera, double radius) {
    const Surfaces surfaces = sight.surfaces(camera, glimpseWidth, glimpseHeight);
    std::vector<double> depths = depthsOf(surfaces);
    const double shown =
        static_cast<double>(depths.size()) / static_cast<double>(surfaces.depth.size());
    if (shown < 0.12)
        return -1;
    const auto twentieth = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 20);
    std::nth_element(depths.begin(), twentieth, depths.end());
    if (*twentieth < radius)
        return -1;
    Sum sum;
    sum.add(surfaces, tracer, radius, raysToFind);
    const double mean = sum.values / sum.count, variance = sum.squares / sum.count - mean * mean;
    return mean < 0.2 ? -1 : shown * std::sqrt(std::max(variance, 0.0)); // dark: inside something
}

// How unlike two cameras are: distance between them and of what they look at, in scene sizes.
double apart(const Camera& a, const Camera& b, double size) {
    const auto vec = [](const Vec3& v) { return glm::dvec3(v[0], v[1], v[2]); };
    return (glm::distance(vec(a.position), vec(b.position)) +
            0.5 * glm::distance(vec(a.target), vec(b.target))) /
           size;
}

// Cameras that see nothing nearer than a good part of the scene's size, for the first look at it; a
// smaller part where there are none.
std::vector<Camera> firstCameras(const Sight& sight, const RayTracer& tracer, int cameras,
                                 std::uint64_t seed) {
    const double size = diagonal(extentOf(sight.scene()).whole);
    for (const int part : {8, 16}) {
        try {
            return foundCameras(sight, tracer, size / part, cameras, seed);
        } catch (const Error&) {
        }
    }
    return foundCameras(sight, tracer, size / 32, cameras, seed);
}

// Over the pixels of all cameras that show a surface.
double meanOcclusion(const std::vector<Surfaces>& seen, const RayTracer& tracer, double radius) {
    Sum sum;
    for (const Surfaces& surfaces : seen)
        sum.add(surfaces, tracer, radius, raysToMeasure);
    return 1 - sum.values / sum.count;
}

} // namespace

std::vector<Camera> foundCameras(const Sight& sight, const RayTracer& tracer, double radius,
                                 int count, std::uint64_t seed) {
    const Bounds bounds = extentOf(sight.scene()).whole;
    const double size = diagonal(bounds);
    Random random(seed, "viewpoints");
    struct Candidate {
        Camera camera;
        double interest;
    };
    std::vector<Candidate> candidates;
    for (int i = 0; i < count * candidatesPerCamera; ++i) {
        Camera camera = i % 2 ? around(bounds, random) : within(bounds, random);
        camera.fovDegrees = fovDegrees;
        const double value = interest(sight, tracer, camera, radius);
        if (value > 0)
            candidates.push_back({camera, value});
    }
    std::vector<Camera> found;
    while (static_cast<int>(found.size()) < count) {
        const Candidate* best = nullptr;
        double greatest = 0;
        for (const Candidate& candidate : candidates) {
            double nearest = 1;
            for (const Camera& taken : found)
                nearest = std::min(nearest, apart(candidate.camera, taken, size));
            if (candidate.interest * nearest > greatest) {
                greatest = candidate.interest * nearest;
                best = &candidate;
            }
        }
        if (!best)
            throw Error(fmt::format("expected {} cameras that see surfaces with occlusion within "
                                    "{:g} m, found {}; try another --radius, or write the views "
                                    "down in a study",
                                    count, radius, found.size()));
        found.push_back(best->camera);
    }
    return found;
}

double roundRadius(double metres) {
    const double power = std::pow(10, std::floor(std::log10(metres)));
    double best = power;
    for (const double factor : {2.0, 5.0, 10.0})
        if (std::abs(std::log(factor * power / metres)) < std::abs(std::log(best / metres)))
            best = factor * power;
    return best;
}

SuggestedRadius suggestedRadius(const Sight& sight, const RayTracer& tracer,
                                std::span<const Camera> cameras) {
    std::vector<Surfaces> seen;
    std::vector<double> depths;
    for (const Camera& camera : cameras) {
        seen.push_back(sight.surfaces(camera, glimpseWidth, glimpseHeight));
        const std::vector<double> more = depthsOf(seen.back());
        depths.insert(depths.end(), more.begin(), more.end());
    }
    const double depth = percentile(std::move(depths), 0.5),
                 high =
                     2 * depth * std::tan(cameras.front().fovDegrees / 2 * std::numbers::pi / 180);
    const double wanted = std::clamp(roundRadius(leastShare * high), lowestRadius, highestRadius);
    double radius = wanted, occlusion = meanOcclusion(seen, tracer, radius);
    for (int step = 0; step < mostSteps && (occlusion < hardly || occlusion > mostly); ++step) {
        const double next = radius * (occlusion < hardly ? 2 : 0.5);
        if (next < lowestRadius || next > std::min(most * wanted, highestRadius))
            break;
        const double then = meanOcclusion(seen, tracer, next);
        if (next > radius ? then > mostly || then <= occlusion : then < hardly)
            break; // from one side to the other, or where there is nothing more to meet
        radius = next;
        occlusion = then;
    }
    std::string why = fmt::format(
        "{} surfaces at a median depth of {:.3g} m, where the picture is {:.3g} m high, and {:g} m "
        "is about a sixteenth of that",
        cameras.size() > 1 ? fmt::format("{} cameras found in the scene see", cameras.size())
                           : "the camera sees",
        depth, high, wanted);
    if (radius != wanted)
        why += fmt::format("; {} is occluded within that, so it was {}",
                           radius > wanted ? "hardly anything" : "most of the scene",
                           radius > wanted ? "doubled" : "halved");
    return {radius, why + fmt::format("; within {:g} m, {:.0f} % of what rays could see is "
                                      "occluded, on average",
                                      radius, 100 * occlusion)};
}

SuggestedRadius suggestedRadius(const Sight& sight, const RayTracer& tracer, int cameras,
                                std::uint64_t seed) {
    return suggestedRadius(sight, tracer, firstCameras(sight, tracer, cameras, seed));
}

} // namespace obscura
