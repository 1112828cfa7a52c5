#pragma once

#include "renderer/reference/reference.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace obscura {

// Hash of our own C++ that decides a reference (code_hash.cmake). Techniques are no part of it.
std::string_view referenceCode();

// References are kept on disk, because they take seconds to minutes and do not change.

// $OBSCURA_CACHE, else $XDG_CACHE_HOME/obscura, else ~/.cache/obscura.
std::filesystem::path defaultCache();

// What decides a reference: which scene, from where, at which pixels, what is traced, and the
// programs that do it.
struct ReferenceInputs {
    std::string sceneSha256;
    Camera camera;
    int width = 0, height = 0;
    glm::vec2 jitter{0, 0}; // of makeFrame
    Normals normals = Normals::smooth;
    TraceSettings settings;
    std::string_view code = referenceCode();
};
std::string referenceKey(const ReferenceInputs& inputs); // SHA-256

// The reference under that key, or what `trace` gives, which is then kept: whole or not at all. A
// file that cannot be read is traced anew.
Reference cachedReference(const std::filesystem::path& cache, const std::string& key,
                          const std::function<Reference()>& trace);

// As EXR with the channels V, error, bentNormal.x, .y, .z; 32 bits each.
void writeReference(const std::filesystem::path& path, const Reference& reference);
Reference readReference(const std::filesystem::path& path);

// Draws what the inputs' camera sees and traces rays from those points. `scene` and `tracer` hold
// the same scene, for the GPU and for rays.
Reference traceView(const RayTracer& tracer, const GpuScene& scene, const GBufferPass& pass,
                    const ReferenceInputs& inputs, const TraceProgress& progress = {});

} // namespace obscura
