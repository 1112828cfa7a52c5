#pragma once

#include "bench/sweep/row.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace obscura::test {

// A sweep with plausible numbers that nobody measured: techniques of a price and a floor of error
// each, at several counts of samples, reductions and switches.

struct SampleTechnique {
    const char* id;
    double price, overhead; // milliseconds per sample and megapixel, and without any
    double floor, noise;    // of RMSE: what remains with many samples, and what few add
};
inline constexpr SampleTechnique sampleTechniques[] = {
    {"alchemy", .11, .2, .045, .12},
    {"crytek", .13, .15, .11, .2},
    {"gtao", .17, .4, .021, .09},
    {"hbao", .14, .35, .037, .13},
    {"none", 0, 0, .17, 0},
    {"ray_traced", 9, 2, .002, .1},
    {"sao", .08, .3, .042, .14},
    {"starcraft", .1, .15, .06, .18},
    {"vao_plus_plus", .12, .3, .051, .1},
    {"visibility_bitmask", .2, .4, .017, .1},
};

struct SampleConfiguration {
    const SampleTechnique* technique;
    int samples = 0;
    std::string extras;         // more settings
    double cost = 1, error = 1; // factors
};

inline std::vector<SampleConfiguration> sampleConfigurations() {
    std::vector<SampleConfiguration> all;
    for (const SampleTechnique& technique : sampleTechniques)
        for (const int samples : {2, 4, 8, 16, 32}) {
            const std::string id = technique.id;
            if (id == "none" && samples != 2)
                continue;
            if (id == "vao_plus_plus") {
                for (const int adaptive : {0, 1})
                    for (const int culling : {0, 2})
                        all.push_back({&technique, samples,
                                       fmt::format(" adaptive={} culling={}", adaptive, culling),
                                       (1.0 - .012 * samples * adaptive) *
                                           (culling ? .9 - .006 * samples : 1),
                                       1 + .02 * adaptive + .01 * culling});
            } else {
                all.push_back({&technique, samples, " blur=1", 1, 1});
            }
        }
    return all;
}

inline SweepRow sampleRow(const SampleConfiguration& configuration, const std::string& scene,
                          int view, int width, int height) {
    const SampleTechnique& t = *configuration.technique;
    const double wobble = 1 + .13 * std::sin(view * 2.1 + configuration.samples + t.price * 50);
    const double megapixels = width * height * 1e-6;
    SweepRow row;
    row.technique = row.name = t.id;
    row.configuration =
        fmt::format("{} samples={}{}", t.id, configuration.samples, configuration.extras);
    row.settings =
        fmt::format("samples={} radius=0.5{}", configuration.samples, configuration.extras);
    row.scene = scene;
    row.view = fmt::format("view {}", view + 1);
    row.radius = .5;
    row.width = width;
    row.height = height;
    row.frames = 200;
    const double ms =
        (t.overhead + t.price * configuration.samples) * megapixels * configuration.cost * wobble;
    row.total = {ms, ms * .96, ms * 1.09};
    row.work = {ms * .08, ms * .7, ms * .2, 0};
    row.gbuffer = 2.2 * megapixels;
    row.toGbuffer = ms / row.gbuffer;
    row.toStarcraft = ms / ((.15 + .1 * 16) * megapixels);
    row.bytes = 4 + 2 * t.overhead * 10;
    row.fetches = configuration.samples + 9;
    const double rmse = (t.floor + t.noise / std::sqrt(configuration.samples) * .5) *
                        configuration.error * (2 - wobble) * (scene == "atrium" ? 1 : 1.3);
    const auto error = [&](double factor) {
        return PictureError{rmse * factor, rmse * (factor - 1.2), 1 - rmse * 1.5 * factor,
                            rmse * .8 * factor};
    };
    row.raw = error(1.6);
    row.matched = error(1);
    row.depthRaw = error(1.3);
    row.depthMatched = error(.7);
    row.litRaw = error(.6);
    row.litMatched = error(.4);
    row.litRaw.jod = 10 - 12 * rmse;
    row.litMatched.jod = 10 - 9 * rmse;
    return row;
}

inline Sweep sampleSweep() {
    Sweep sweep;
    sweep.machine.vendor = "Mesa";
    sweep.machine.renderer = "llvmpipe (LLVM 15.0.6, 256 bits)";
    sweep.machine.glVersion = "4.5 (Core Profile) Mesa 22.3.6";
    sweep.machine.processor = "Intel(R) Xeon(R), 2 cores";
    sweep.machine.method =
        "glFinish and steady clock, because this driver's timer queries are not honest";
    sweep.machine.clocks = "2.1 GHz";
    sweep.machine.date = "2026-11-22T06:21:00Z";
    sweep.machine.program = "obscura-bench 0.1.0 (994ab97d1a2b)";
    sweep.machine.study = std::string(64, 'a');
    for (const char* scene : {"atrium", "sponza/Sponza.gltf"})
        for (const auto& [width, height] : {std::pair(640, 360), std::pair(1920, 1080)})
            for (const SampleConfiguration& configuration : sampleConfigurations())
                for (int view = 0; view < 4; ++view)
                    sweep.rows.push_back(sampleRow(configuration, scene, view, width, height));
    for (const SampleTechnique& t : sampleTechniques)
        for (const double scale : {1.0, 2.0, 4.0, 8.0}) {
            const std::string configuration = fmt::format("{} samples=16 blur=1", t.id);
            const double ms = (t.overhead + 16 * t.price) * 2;
            sweep.growth.push_back(
                {configuration, "samples", 4 * scale, 2 * (t.overhead + t.price * 4 * scale)});
            sweep.growth.push_back({configuration, "radius", .25 * scale,
                                    ms * std::pow(scale, .1 + .5 * std::min(t.price, 1.0))});
            sweep.growth.push_back({configuration, "pixels", .52 * scale, ms * .25 * scale});
            sweep.growth.push_back(
                {configuration, "silhouettes", .01 * scale, ms * std::pow(scale, .05)});
        }
    return sweep;
}

// One scene and resolution, two views, and fewer configurations.
inline Sweep smallSweep() {
    const Sweep all = sampleSweep();
    Sweep sweep{all.machine, {}, all.growth};
    for (const SweepRow& row : all.rows)
        if (row.scene == "atrium" && row.width == 640 && row.view < "view 3" &&
            (row.technique == "none" || row.technique == "hbao" ||
             row.technique == "vao_plus_plus"))
            sweep.rows.push_back(row);
    return sweep;
}

} // namespace obscura::test
