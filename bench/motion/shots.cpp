#include "bench/motion/shots.h"

#include "renderer/reference/traced.h"

namespace obscura {

namespace {

TraceSettings withSameRays(TraceSettings settings) {
    settings.sameRays = true;
    return settings;
}

} // namespace

Shots::Shots(const Scene& scene, std::span<const NamedSettings> configurations, int width,
             int height)
    : subject_(scene), tracer_(scene), configurations_(configurations), width_(width),
      height_(height) {
    for (const NamedSettings& configuration : configurations) {
        const int guard = guardPixels(configuration.settings, height);
        passes_.emplace_back(configuration.settings, width + 2 * guard, height + 2 * guard);
    }
}

Shot Shots::take(const Camera& camera, std::uint64_t seed,
                 std::span<const std::size_t> which) const {
    return shoot(camera, seed, which, &Probe::visibility);
}

Shot Shots::next(const Camera& camera, std::uint64_t seed,
                 std::span<const std::size_t> which) const {
    return shoot(camera, seed, which, &Probe::next);
}

Shot Shots::shoot(const Camera& camera, std::uint64_t seed, std::span<const std::size_t> which,
                  Visibility visibility) const {
    const Probe probe(subject_, camera, width_, height_, Normals::smooth, seed);
    Shot shot{probe.surfaces(), probe.shown(), {}, {}};
    for (const std::size_t i : which) {
        const Settings& settings = configurations_[i].settings;
        shot.visibilities.push_back(settings.technique().reads & rays
                                        ? truth(shot.surfaces, traceSettings(settings, seed))
                                        : (probe.*visibility)(settings, passes_[i], 0));
    }
    return shot;
}

std::vector<Image> Shots::stills(const Camera& camera, std::uint64_t seed,
                                 std::span<const std::size_t> which) const {
    const Probe probe(subject_, camera, width_, height_, Normals::smooth, seed);
    std::vector<Image> images;
    for (const std::size_t i : which) {
        const Settings& settings = configurations_[i].settings;
        auto known = stillers_.find(i);
        if (known == stillers_.end())
            known = stillers_.emplace(i, probe.passesFor(settings)).first;
        images.push_back(probe.visibility(settings, known->second));
    }
    return images;
}

Image Shots::truth(const Surfaces& surfaces, const TraceSettings& settings) const {
    return tracer_.trace(surfaces, withSameRays(settings)).visibility;
}

FrameStep stepBetween(const Shot& before, const Shot& now) {
    FrameStep step{now.shown,
                   Reprojection(now.surfaces, before.surfaces),
                   Reprojection(before.surfaces, now.surfaces),
                   now.truth,
                   {}};
    for (std::size_t i = 0; i < now.shown.size(); ++i) {
        step.shown[i] = step.shown[i] || before.shown[i];
        step.change.pixels[i] -= before.truth.pixels[i];
    }
    step.warpedChange = warpedChange(now.truth, before.truth, step.back);
    return step;
}

} // namespace obscura
