#include "renderer/techniques/fetches.h"

#include "renderer/techniques/pass_shaders.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace obscura {

namespace {

// Before anything is counted.
FetchCount declarationOf(const Settings& settings, const Pass& pass, int level) {
    const double side = downscaleOf(settings) * pass.scale * std::pow(2, level);
    return {&pass,
            level,
            pass.layers / (side * side),
            (level > 0 ? pass.levelFetches : pass.fetches)(settings),
            0,
            0};
}

void count(FetchCount& result, const gl::Program& program, const gl::SlicedTarget& passResult,
           const OcclusionInputs& inputs) {
    const int width = passResult.width(result.level), height = passResult.height(result.level);
    const int layers = passResult.slices().layers;
    const gl::SlicedTarget target(width, height, gl::Format::r32f, {1, layers, false}, "fetches");
    drawPass(*result.pass, program, target, gl::ScreenTriangle(), inputs);
    const std::vector<float> counts =
        gl::readFloats(target.texture(), width, height * layers, gl::Format::r32f);
    result.most = *std::max_element(counts.begin(), counts.end());
    result.mean =
        std::accumulate(counts.begin(), counts.end(), 0.0) / static_cast<double>(counts.size());
}

} // namespace

double fetchesPerPixel(const Settings& settings) {
    double sum = downscaleOf(settings) > 1 ? Reduction::upsamplePass.fetches(settings) : 0;
    if (accumulatedFrames(settings) > 1)
        sum += Accumulation::pass.fetches(settings);
    const auto add = [&](const Pass& pass, int level) {
        const FetchCount declaration = declarationOf(settings, pass, level);
        sum += declaration.share * declaration.declared;
    };
    if (downscaleOf(settings) > 1)
        add(Reduction::reducePass, 0);
    if (furtherLayers(settings) > 0)
        add(FurtherLayers::pass, 0);
    for (const Pass* pass : enabledPasses(settings))
        for (int level = 0; level < pass->levels; ++level)
            add(*pass, level);
    return sum;
}

std::vector<FetchCount> countFetches(const Settings& settings, const OcclusionInputs& inputs,
                                     int width, int height) {
    const std::vector<const Pass*> own = enabledPasses(settings);
    const OcclusionPasses passes(settings, width, height);
    std::vector<FetchCount> counts;
    // When a pass has been issued, what it read and what it gave are still bound.
    passes.next(inputs, [&](const Pass& pass) {
        if (std::find(own.begin(), own.end(), &pass) == own.end())
            return;
        const gl::SlicedTarget& result = passes.result(pass.name);
        std::optional<gl::Program> program;
        for (int level = 0; level < result.slices().levels; ++level) {
            if (level < 2)
                program = passProgram(settings, pass, level, Writes::fetches);
            if (level > 0)
                result.bind(level, 0); // lets the shader see the level before
            counts.push_back(declarationOf(settings, pass, level));
            count(counts.back(), *program, result, inputs);
        }
        result.readAll();
    });
    return counts;
}

} // namespace obscura
