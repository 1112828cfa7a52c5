#include "renderer/reference/reference_cache.h"

#include "base/error.h"
#include "base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>

namespace obscura {

namespace {

namespace fs = std::filesystem;

const std::array<std::string, 5> channelNames{"V", "error", "bentNormal.x", "bentNormal.y",
                                              "bentNormal.z"};

// Doubles as hexadecimal digits: exact.
std::string spelt(const Vec3& v) { return fmt::format("{:a} {:a} {:a}", v[0], v[1], v[2]); }

// `count` channels of an image, from the first on.
Image channels(const Image& image, int first, int count) {
    Image result{image.width, image.height, count, {}};
    for (std::size_t i = 0; i < image.pixels.size(); i += static_cast<std::size_t>(image.channels))
        for (int c = first; c < first + count; ++c)
            result.pixels.push_back(image.pixels[i + static_cast<std::size_t>(c)]);
    return result;
}

} // namespace

fs::path defaultCache() {
    if (const char* own = std::getenv("OBSCURA_CACHE"))
        return own;
    if (const char* shared = std::getenv("XDG_CACHE_HOME"))
        return fs::path(shared) / "obscura";
    if (const char* home = std::getenv("HOME"))
        return fs::path(home) / ".cache" / "obscura";
    throw Error("expected a folder for the cache in OBSCURA_CACHE, XDG_CACHE_HOME or HOME; none "
                "of them is set");
}

std::string referenceKey(const ReferenceInputs& inputs) {
    const Camera& camera = inputs.camera;
    const TraceSettings& settings = inputs.settings;
    // A power of two is what is traced.
    const auto rays = std::bit_ceil(static_cast<unsigned>(std::max(settings.rays, 2)));
    const std::string text = fmt::format(
        "reference\nscene {}\ncamera {} / {} / {} / {:a} / {:a}\nsize {} x {} jitter {:a} "
        "{:a}\nnormals {}\nintegral {} radius {:a} rays {} seed {} same {}\nby {} {}\n{}",
        inputs.sceneSha256, spelt(camera.position), spelt(camera.target), spelt(camera.up),
        camera.fovDegrees, camera.near, inputs.width, inputs.height, inputs.jitter.x,
        inputs.jitter.y, static_cast<int>(inputs.normals), static_cast<int>(settings.integral),
        settings.radius, rays, settings.seed, settings.sameRays, inputs.code, rayTracerVersion(),
        gbufferShaders());
    return sha256(text);
}

void writeReference(const fs::path& path, const Reference& reference) {
    const Image& visibility = reference.visibility;
    Image all{visibility.width, visibility.height, static_cast<int>(channelNames.size()), {}};
    for (std::size_t i = 0; i < visibility.pixels.size(); ++i) {
        all.pixels.push_back(visibility.pixels[i]);
        all.pixels.push_back(reference.error.pixels[i]);
        for (std::size_t c = 0; c < 3; ++c)
            all.pixels.push_back(reference.bentNormal.pixels[3 * i + c]);
    }
    writeExr(path, all, channelNames, true);
}

Reference readReference(const fs::path& path) {
    const Image all = readExr(path, channelNames);
    for (const float value : all.pixels)
        if (!std::isfinite(value))
            throw Error({path.string(), 0, 0, {}}, "expected finite numbers; trace it anew");
    return {channels(all, 0, 1), channels(all, 1, 1), channels(all, 2, 3)};
}

Reference cachedReference(const fs::path& cache, const std::string& key,
                          const std::function<Reference()>& trace) {
    const fs::path path = cache / ("reference-" + key + ".exr");
    if (fs::exists(path))
        try {
            return readReference(path);
        } catch (const Error&) { // a disk's fault, or another program's: the next line mends it
        }
    Reference reference = trace();
    removeUnfinishedFiles(cache);
    writeReference(path, reference);
    return reference;
}

Reference traceView(const RayTracer& tracer, const GpuScene& scene, const GBufferPass& pass,
                    const ReferenceInputs& inputs, const TraceProgress& progress) {
    const Frame frame = makeFrame(inputs.camera, inputs.width, inputs.height, scene.bounds(),
                                  inputs.settings.seed, inputs.jitter);
    return tracer.trace(surfacesOf(scene, pass, frame, inputs.normals), inputs.settings, progress);
}

} // namespace obscura
