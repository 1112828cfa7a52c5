// Visibility is the mean over N = 2n rays: two independently scrambled Sobol nets of n points, each
// with one ray in each of n cells of the hemisphere (ray_packets.h).
//
// Its standard error. Were the rays independent within their cells (jittered sampling), the
// estimate's variance would be the sum of the cells' variances s_c^2, twice each, over N^2. Both
// nets' rays f_c, g_c in one cell are independent and spread alike, so (f_c - g_c)^2 has the mean
// 2 s_c^2, and
//
//     error^2 = sum over cells of (f_c - g_c)^2 / N^2
//
// is that variance, without bias, from as many differences as there are cells at the edge of an
// occluder: far steadier than the spread of a handful of batches, which would also need the nets
// cut into smaller, worse ones. A net does a little better than jittered sampling, because it is
// even in cells of other shapes too; so the error errs on the large side, by a fifth on the closed
// forms of reference_test.cpp (more where edges run along cells). Where the rays of every cell
// agree, something as large as one ray may still have been missed: 1 / N.
#include "renderer/reference/reference.h"

#include "base/parallel.h"
#include "renderer/reference/ray_packets.h"
#include "renderer/reference/ray_scene.h"

#include <fmt/format.h>

#include <cmath>

namespace obscura {

namespace {

template <typename T>
using Lanes = RayPackets::Lanes<T>;

// What sixteen pixels have gathered.
struct Sums {
    Lanes<float> visibility{}, squares{}; // of pairs' differences
    Lanes<float> direction[3]{};
};

class Tracer {
  public:
    Tracer(const RayScene& scene, const Surfaces& surfaces, const TraceSettings& settings,
           Reference& result)
        : scene_(scene), surfaces_(surfaces), settings_(settings),
          packets_(scene, surfaces, settings), result_(result) {}

    int groups() const { return packets_.groups(); }
    // Groups may be traced on several threads at once.
    void trace(int group) const {
        std::vector<Lanes<float>> partners(static_cast<std::size_t>(packets_.cells()));
        trace(packets_.group(group), partners);
    }

  private:
    // The integrand for each lane.
    Lanes<float> values(RayPackets::Packet& packet) const {
        Lanes<float> result;
        const float* ends = packet.rays.ray.tfar;
        if (settings_.integral == Integral::falloff)
            findNearest(scene_.handle(), packet.valid.data(), packet.rays);
        else
            findAny(scene_.handle(), packet.valid.data(), packet.rays.ray);
        const bool falloff = settings_.integral == Integral::falloff;
        const float share = falloff ? 1 / static_cast<float>(settings_.radius) : 1;
        for (std::size_t lane = 0; lane < packetSize; ++lane) {
            const float open =
                falloff ? std::fmin(ends[lane] * share, 1.0f) : (ends[lane] >= 0 ? 1.0f : 0.0f);
            result[lane] = packet.valid[lane] ? open : 0.0f;
        }
        return result;
    }

    void trace(const RayPackets::Group& group, std::vector<Lanes<float>>& partners) const {
        Sums sums;
        RayPackets::Packet packet;
        for (int scrambling = 0; scrambling < 2; ++scrambling)
            for (int point = 0; point < packets_.cells(); ++point) {
                packets_.fill(group, point, scrambling, packet);
                const Lanes<float> value = values(packet);
                Lanes<float>& partner = partners[static_cast<std::size_t>(packet.cell)];
                for (std::size_t lane = 0; lane < packetSize; ++lane) {
                    sums.visibility[lane] += value[lane];
                    for (int axis = 0; axis < 3; ++axis)
                        sums.direction[axis][lane] += value[lane] * packet.local[axis][lane];
                }
                if (scrambling == 0)
                    partner = value;
                else
                    for (std::size_t lane = 0; lane < packetSize; ++lane) {
                        const float difference = value[lane] - partner[lane];
                        sums.squares[lane] += difference * difference;
                    }
            }
        store(group, sums);
    }

    void store(const RayPackets::Group& group, const Sums& sums) const {
        const auto rays = static_cast<float>(packets_.rays());
        const glm::mat3 viewFromWorld(surfaces_.frame.viewFromWorld);
        for (std::size_t lane = 0; lane < static_cast<std::size_t>(group.size); ++lane) {
            const auto pixel = static_cast<int>(group.pixel[lane]);
            const int x = pixel % surfaces_.width;
            const int y = surfaces_.height - 1 - pixel / surfaces_.width;
            result_.visibility.at(x, y, 0) = sums.visibility[lane] / rays;
            const float squares = sums.squares[lane];
            result_.error.at(x, y, 0) = (squares > 0 ? std::sqrt(squares) : 1.0f) / rays;
            glm::vec3 local(sums.direction[0][lane], sums.direction[1][lane],
                            sums.direction[2][lane]);
            if (!(glm::length(local) > 0))
                local = {0, 0, 1};
            glm::vec3 world;
            for (int axis = 0; axis < 3; ++axis)
                world[axis] = group.across[axis][lane] * local.x + group.up[axis][lane] * local.y +
                              group.normal[axis][lane] * local.z;
            const glm::vec3 view = glm::normalize(viewFromWorld * world);
            for (int axis = 0; axis < 3; ++axis)
                result_.bentNormal.at(x, y, axis) = view[axis];
        }
    }

    const RayScene& scene_;
    const Surfaces& surfaces_;
    const TraceSettings& settings_;
    RayPackets packets_;
    Reference& result_;
};

Image filled(const Surfaces& surfaces, std::vector<float> pixel) {
    Image image{surfaces.width, surfaces.height, static_cast<int>(pixel.size()), {}};
    for (std::size_t i = 0; i < surfaces.depth.size(); ++i)
        image.pixels.insert(image.pixels.end(), pixel.begin(), pixel.end());
    return image;
}

} // namespace

const std::vector<std::string>& integralNames() {
    static const std::vector<std::string> names{"cosine", "uniform", "falloff"};
    return names;
}

std::string rayTracerVersion() {
    return fmt::format("Embree {}", RTC_VERSION_STRING); // ours: referenceCode()
}

struct RayTracer::Device {
    RayScene scene;
};

RayTracer::RayTracer(const Scene& scene)
    : device_(std::make_unique<Device>(Device{RayScene(scene)})) {}
RayTracer::~RayTracer() = default;
RayTracer::RayTracer(RayTracer&&) noexcept = default;

Reference RayTracer::trace(const Surfaces& surfaces, const TraceSettings& settings,
                           const TraceProgress& progress) const {
    Reference result{filled(surfaces, {1}), filled(surfaces, {0}), filled(surfaces, {0, 0, 1})};
    const Tracer tracer(device_->scene, surfaces, settings, result);
    forEachInParallel(
        tracer.groups(), [&](int group) { tracer.trace(group); }, progress, settings.threads);
    device_->scene.throwErrors();
    return result;
}

} // namespace obscura
