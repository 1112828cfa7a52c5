#include "bench/measure/layers.h"

#include "base/parallel.h"
#include "renderer/reference/ray_packets.h"
#include "renderer/reference/ray_scene.h"

#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace obscura {

namespace {

constexpr int mostLayers = 3;
constexpr int mostMet = 16; // surfaces along a ray
constexpr double guardBands[] = {0, 0.1};
constexpr float tolerance = 1e-4f; // of the distance from the camera

// Which layer of a view shows a point.
class Layers {
  public:
    Layers(const Scene& scene, const Surfaces& surfaces, float separation)
        : scene_(scene, RayScene::Sides::drawn), frame_(surfaces.frame),
          eye_(surfaces.frame.worldFromView[3]), separation_(separation) {}

    // How far beyond the image's border a point of the world lies, as a share of its height; 0
    // inside, and without end behind the near plane.
    double beyond(glm::vec3 point) const {
        const glm::vec3 view(frame_.viewFromWorld * glm::vec4(point, 1));
        if (-view.z < frame_.depth.x)
            return std::numeric_limits<double>::infinity();
        const glm::vec4 map = frame_.viewFromUv;
        const glm::vec2 uv =
            (glm::vec2(view) / -view.z - glm::vec2(map.z, map.w)) / glm::vec2(map.x, map.y);
        const float shape = frame_.size.x / frame_.size.y;
        const glm::vec2 out = glm::max(glm::max(-uv, uv - 1.0f), 0.0f);
        return static_cast<double>(std::max(out.x * shape, out.y));
    }

    // 1 for what a picture shows; above mostLayers where none of them has it.
    int at(glm::vec3 point) const {
        const glm::vec3 way = point - eye_;
        const float distance = glm::length(way);
        const float slant = distance / -(frame_.viewFromWorld * glm::vec4(point, 1)).z;
        RTCRayHit ray{};
        float from = frame_.depth.x * slant;
        for (int layer = 1; layer <= mostLayers; ++layer) {
            const glm::vec3 direction = way / distance;
            ray.ray = {eye_.x,      eye_.y,      eye_.z,
                       from,        direction.x, direction.y,
                       direction.z, 0,           distance * (1 + tolerance),
                       ~0u,         0,           0};
            ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            if (from >= ray.ray.tfar)
                break;
            findNearest(scene_.handle(), ray);
            if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID)
                break;
            if (ray.ray.tfar >= distance * (1 - tolerance))
                return layer;
            from = ray.ray.tfar + separation_ * slant;
        }
        return mostLayers + 1;
    }

  private:
    RayScene scene_;
    const Frame& frame_;
    glm::vec3 eye_;
    float separation_;
};

// Visibility of each pixel, rows as in Surfaces.
struct Sums {
    std::vector<float> truth;
    std::vector<float> known[std::size(guardBands)][mostLayers];
};

class Counting {
  public:
    Counting(const Scene& scene, const Surfaces& surfaces, const TraceSettings& settings)
        : radius_(static_cast<float>(settings.radius)), rays_(scene),
          layers_(scene, surfaces, layerSeparation * static_cast<float>(settings.radius)),
          packets_(rays_, surfaces, settings) {
        sums_.truth.assign(surfaces.depth.size(), 1);
        for (auto& band : sums_.known)
            for (std::vector<float>& each : band)
                each = sums_.truth;
    }

    Sums run() {
        forEachInParallel(packets_.groups(), [&](int index) {
            const RayPackets::Group group = packets_.group(index);
            RayPackets::Packet packet;
            for (int scrambling = 0; scrambling < 2; ++scrambling)
                for (int point = 0; point < packets_.cells(); ++point) {
                    packets_.fill(group, point, scrambling, packet);
                    findNearest(rays_.handle(), packet.valid.data(), packet.rays);
                    for (int lane = 0; lane < group.size; ++lane)
                        count(group, packet, static_cast<std::size_t>(lane));
                }
        });
        return std::move(sums_);
    }

  private:
    // Takes a blocked ray from all that know anything of what blocks it. A ray below the face,
    // which the reference counts as blocked, is known to be.
    void count(const RayPackets::Group& group, const RayPackets::Packet& packet, std::size_t lane) {
        const std::size_t pixel = group.pixel[lane];
        const float share = 1 / static_cast<float>(packets_.rays());
        Known known{1, 1};
        if (packet.valid[lane]) {
            if (packet.rays.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID)
                return;
            known = knownOf(packet.rays.ray, lane);
        }
        sums_.truth[pixel] -= share;
        for (std::size_t band = 0; band < std::size(guardBands); ++band)
            for (int most = known[band]; most <= mostLayers; ++most)
                sums_.known[band][most - 1][pixel] -= share;
    }

    // The first layer that shows anything that the ray meets, for each guard band.
    using Known = std::array<int, std::size(guardBands)>;
    Known knownOf(const RTCRay16& rays, std::size_t lane) const {
        const glm::vec3 origin(rays.org_x[lane], rays.org_y[lane], rays.org_z[lane]),
            direction(rays.dir_x[lane], rays.dir_y[lane], rays.dir_z[lane]);
        Known known{mostLayers + 1, mostLayers + 1};
        float met = rays.tfar[lane];
        for (int i = 0; i < mostMet && met < radius_; ++i) {
            const glm::vec3 place = origin + direction * met;
            const double beyond = layers_.beyond(place);
            const int layer = beyond <= guardBands[1] ? layers_.at(place) : mostLayers + 1;
            for (std::size_t band = 0; band < std::size(guardBands); ++band)
                if (beyond <= guardBands[band])
                    known[band] = std::min(known[band], layer);
            if (known[0] == 1)
                break;
            met = nextAlong(origin, direction, met + tolerance * radius_);
        }
        return known;
    }

    float nextAlong(glm::vec3 origin, glm::vec3 direction, float from) const {
        RTCRayHit ray{};
        ray.ray = {origin.x,    origin.y, origin.z, from, direction.x, direction.y,
                   direction.z, 0,        radius_,  ~0u,  0,           0};
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        if (from < radius_)
            findNearest(rays_.handle(), ray);
        return ray.hit.geomID == RTC_INVALID_GEOMETRY_ID ? radius_ : ray.ray.tfar;
    }

    float radius_;
    RayScene rays_;
    Layers layers_;
    RayPackets packets_;
    Sums sums_;
};

Image imageOf(const Surfaces& surfaces, const std::vector<float>& values) {
    Image image{surfaces.width, surfaces.height, 1, {}};
    for (int y = surfaces.height - 1; y >= 0; --y)
        for (int x = 0; x < surfaces.width; ++x)
            image.pixels.push_back(values[surfaces.index(x, y)]);
    return image;
}

} // namespace

std::vector<LayersFloor> measureLayers(const Scene& scene, const Probe& probe,
                                       const TraceSettings& settings) {
    assert(settings.integral != Integral::falloff);
    const Surfaces& surfaces = probe.surfaces();
    const Sums sums = Counting(scene, surfaces, settings).run();
    const Image truth = imageOf(surfaces, sums.truth);
    std::vector<LayersFloor> floors;
    for (std::size_t band = 0; band < std::size(guardBands); ++band)
        for (int layers = 1; layers <= mostLayers; ++layers)
            floors.push_back({layers, guardBands[band],
                              imageError(imageOf(surfaces, sums.known[band][layers - 1]), truth,
                                         probe.shown())});
    return floors;
}

} // namespace obscura
