#include "bench/measure/rays.h"

#include "renderer/reference/ray_packets.h"
#include "renderer/reference/ray_scene.h"

#include <atomic>
#include <chrono>
#include <ctime>
#include <thread>

namespace obscura {

namespace {

double cpuSeconds(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

// The rays of a group of pixels, for the bare loops to run through.
struct Rays {
    std::vector<RTCRayHit16> packets;
    std::vector<RayPackets::Lanes<int>> valid;
    std::vector<RTCRayHit> single;

    void take(const RayPackets& maker, const RayPackets::Group& group) {
        packets.clear();
        valid.clear();
        single.clear();
        RayPackets::Packet packet;
        for (int scrambling = 0; scrambling < 2; ++scrambling)
            for (int point = 0; point < maker.cells(); ++point) {
                maker.fill(group, point, scrambling, packet);
                packets.push_back(packet.rays);
                valid.push_back(packet.valid);
                for (unsigned int lane = 0; lane < packetSize; ++lane)
                    if (packet.valid[lane])
                        single.push_back(ray(packet.rays.ray, lane));
            }
    }
    static RTCRayHit ray(const RTCRay16& from, unsigned int lane) {
        RTCRayHit to{};
        to.ray = {from.org_x[lane],
                  from.org_y[lane],
                  from.org_z[lane],
                  from.tnear[lane],
                  from.dir_x[lane],
                  from.dir_y[lane],
                  from.dir_z[lane],
                  0,
                  from.tfar[lane],
                  ~0u,
                  0,
                  0};
        to.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        return to;
    }
};

struct Totals {
    std::atomic<int> next = 0;
    std::atomic<double> rays = 0, single = 0, packets = 0; // seconds
};

void bareLoops(const RayScene& scene, const RayPackets& maker, bool nearest, Totals& totals) {
    Rays rays;
    const auto timed = [](std::atomic<double>& seconds, const auto& loop) {
        const double start = cpuSeconds(CLOCK_THREAD_CPUTIME_ID);
        loop();
        seconds += cpuSeconds(CLOCK_THREAD_CPUTIME_ID) - start;
    };
    for (int i = totals.next++; i < maker.groups(); i = totals.next++) {
        rays.take(maker, maker.group(i));
        totals.rays += static_cast<double>(rays.single.size());
        timed(totals.single, [&] {
            for (RTCRayHit& ray : rays.single)
                nearest ? findNearest(scene.handle(), ray) : findAny(scene.handle(), ray.ray);
        });
        timed(totals.packets, [&] {
            for (std::size_t p = 0; p < rays.packets.size(); ++p)
                nearest ? findNearest(scene.handle(), rays.valid[p].data(), rays.packets[p])
                        : findAny(scene.handle(), rays.valid[p].data(), rays.packets[p].ray);
        });
    }
}

} // namespace

RayRates measureRays(const Scene& scene, const Surfaces& surfaces, const TraceSettings& settings) {
    RayRates rates;
    Totals totals;
    {
        const RayScene bare(scene);
        const RayPackets maker(bare, surfaces, settings);
        const auto loops = [&] {
            bareLoops(bare, maker, settings.integral == Integral::falloff, totals);
        };
        const std::jthread other(loops);
        loops();
    }
    const RayTracer tracer(scene);
    const auto start = std::chrono::steady_clock::now();
    const double cpu = cpuSeconds(CLOCK_PROCESS_CPUTIME_ID);
    tracer.trace(surfaces, settings);
    rates.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    rates.rays = totals.rays;
    rates.ours = totals.rays / (cpuSeconds(CLOCK_PROCESS_CPUTIME_ID) - cpu);
    rates.single = totals.rays / totals.single;
    rates.packets = totals.rays / totals.packets;
    return rates;
}

} // namespace obscura
