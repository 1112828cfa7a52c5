#include "bench/measure/normals.h"

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

double squares(const Image& image, double count) {
    double sum = 0;
    for (const float value : image.pixels)
        sum += static_cast<double>(value) * static_cast<double>(value);
    return sum / count;
}

double difference(const Reference& a, const Reference& b, double count) {
    Image off = a.visibility;
    for (std::size_t i = 0; i < off.pixels.size(); ++i)
        off.pixels[i] -= b.visibility.pixels[i];
    const double noise = squares(a.error, count) + squares(b.error, count);
    return std::sqrt(std::max(squares(off, count) - noise, 0.0));
}

} // namespace

NormalsEffect measureNormals(const Scene& scene, const Camera& camera, int width, int height,
                             const TraceSettings& settings) {
    NormalsEffect effect;
    const RayTracer tracer(scene);
    const GpuScene gpuScene(scene);
    const GBufferPass pass;
    const Frame frame = makeFrame(camera, width, height, gpuScene.bounds(), settings.seed);
    std::vector<Reference> references;
    double count = 0; // of pixels that show a surface
    for (const Normals kind : {Normals::face, Normals::smooth, Normals::mapped}) {
        const Surfaces surfaces = surfacesOf(gpuScene, pass, frame, kind);
        count =
            static_cast<double>(std::count_if(surfaces.depth.begin(), surfaces.depth.end(),
                                              [&](float depth) { return depth < frame.depth.y; }));
        TraceSettings own = settings;
        own.seed = settings.seed + references.size(); // noise of its own
        references.push_back(tracer.trace(surfaces, own));
        double blocked = 0; // empty pixels are open
        for (const float value : references.back().visibility.pixels)
            blocked += 1 - static_cast<double>(value);
        effect.mean[references.size() - 1] = 1 - blocked / count;
    }
    effect.faceSmooth = difference(references[0], references[1], count);
    effect.smoothMapped = difference(references[1], references[2], count);
    effect.faceMapped = difference(references[0], references[2], count);
    effect.noise = std::sqrt(squares(references[1].error, count));
    return effect;
}

} // namespace obscura
