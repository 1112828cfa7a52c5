#include "renderer/reference/ray_scene.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <utility>

namespace obscura {

namespace {

// Embree's callbacks must not throw.
class Complaints {
  public:
    static void add(void* self, RTCError code, const char* message) {
        auto& complaints = *static_cast<Complaints*>(self);
        const std::lock_guard lock(complaints.mutex_);
        if (complaints.first_.empty())
            complaints.first_ = fmt::format("error {}: {}", static_cast<int>(code),
                                            message ? message : "no message");
    }
    void raise() {
        const std::lock_guard lock(mutex_);
        if (!first_.empty())
            throw Error(fmt::format(
                "Embree, the ray tracer, failed with {}; if memory ran out, trace a smaller scene",
                std::exchange(first_, {})));
    }

  private:
    std::mutex mutex_;
    std::string first_;
};

struct AlphaMap {
    int width = 0, height = 0;
    Wrap wrapU = Wrap::repeat, wrapV = Wrap::repeat;
    bool nearest = false;
    std::vector<std::uint8_t> texels;

    // OpenGL 4.5, section 8.14: GL_NEAREST or GL_LINEAR with each wrap mode; 0 ... 1.
    float at(glm::vec2 uv) const {
        if (nearest)
            return texel(wrapped(std::floor(uv.x * static_cast<float>(width)), width, wrapU),
                         wrapped(std::floor(uv.y * static_cast<float>(height)), height, wrapV)) *
                   (1.0f / 255);
        const float u = uv.x * static_cast<float>(width) - 0.5f,
                    v = uv.y * static_cast<float>(height) - 0.5f;
        const float left = std::floor(u), low = std::floor(v);
        const int x0 = wrapped(left, width, wrapU), x1 = wrapped(left + 1, width, wrapU);
        const int y0 = wrapped(low, height, wrapV), y1 = wrapped(low + 1, height, wrapV);
        const float across = u - left, up = v - low;
        const float below = texel(x0, y0) * (1 - across) + texel(x1, y0) * across;
        const float above = texel(x0, y1) * (1 - across) + texel(x1, y1) * across;
        return (below * (1 - up) + above * up) * (1.0f / 255);
    }

  private:
    float texel(int x, int y) const {
        return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    }
    static int wrapped(float place, int size, Wrap wrap) {
        const float whole = static_cast<float>(size);
        const float period = wrap == Wrap::mirrored ? 2 * whole : whole;
        if (wrap != Wrap::clamp)
            place -= period * std::floor(place / period);
        if (place >= whole && wrap == Wrap::mirrored)
            place = period - 1 - place;
        return static_cast<int>(std::clamp(place, 0.0f, whole - 1));
    }
};

// The triangles of a material that rays may pass: masked, or drawn from one side.
struct Cutout {
    // What decides on a hole, at one corner: place on the map, and alpha of vertex and material.
    struct Corner {
        glm::vec2 uv;
        float alpha;
    };
    const AlphaMap* map = nullptr; // null: alpha is the corners' alone
    float cutoff = 0;              // 0: no holes
    bool oneSided = false;
    std::vector<std::uint32_t> indices;
    std::vector<Corner> corners; // one for each index, where there are holes

    bool hole(std::uint32_t triangle, float u, float v) const {
        if (corners.empty())
            return false;
        const Corner* corner = &corners[3 * static_cast<std::size_t>(triangle)];
        const Corner &a = corner[0], &b = corner[1], &c = corner[2];
        const float w = 1 - u - v, alpha = w * a.alpha + u * b.alpha + v * c.alpha;
        return alpha * (map ? map->at(w * a.uv + u * b.uv + v * c.uv) : 1.0f) < cutoff;
    }
};

// Embree's normal is that of corners that run against the clock, as OpenGL's front is.
bool fromBehind(const RTCFilterFunctionNArguments& at, unsigned int i) {
    return RTCRayN_dir_x(at.ray, at.N, i) * RTCHitN_Ng_x(at.hit, at.N, i) +
               RTCRayN_dir_y(at.ray, at.N, i) * RTCHitN_Ng_y(at.hit, at.N, i) +
               RTCRayN_dir_z(at.ray, at.N, i) * RTCHitN_Ng_z(at.hit, at.N, i) >
           0;
}

void skipUnseen(const RTCFilterFunctionNArguments* arguments) {
    const auto& cutout = *static_cast<const Cutout*>(arguments->geometryUserPtr);
    for (unsigned int i = 0; i < arguments->N; ++i)
        if (arguments->valid[i] &&
            ((cutout.oneSided &&
              RTCRayN_id(arguments->ray, arguments->N, i) != RayScene::meetsBacks &&
              fromBehind(*arguments, i)) ||
             cutout.hole(RTCHitN_primID(arguments->hit, arguments->N, i),
                         RTCHitN_u(arguments->hit, arguments->N, i),
                         RTCHitN_v(arguments->hit, arguments->N, i))))
            arguments->valid[i] = 0;
}

AlphaMap alphaMap(const Texture& texture) {
    AlphaMap map{texture.image.width, texture.image.height, texture.wrapU,
                 texture.wrapV,       texture.nearest,      {}};
    for (std::size_t i = 3; i < texture.image.pixels.size(); i += 4)
        map.texels.push_back(texture.image.pixels[i]);
    return map;
}

} // namespace

struct RayScene::State {
    Complaints complaints; // outlives the device that calls it
    EmbreeDevice device;
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> opaque; // indices
    std::map<int, AlphaMap> maps;      // by texture
    std::map<int, Cutout> cutouts;     // by material
    // Where triangles begin in the scene's indices, by geometry; only of drawn sides.
    std::vector<std::vector<std::uint32_t>> firsts;
    EmbreeScene scene; // dies before what it points to

    void sort(const Scene& from, Sides sides);
    void attach(const std::vector<std::uint32_t>& indices, Cutout* cutout);
};

void RayScene::State::sort(const Scene& from, Sides sides) {
    for (const Vertex& vertex : from.vertices)
        positions.push_back(vertex.position);
    positions.emplace_back(0.0f); // Embree reads 16 bytes of each
    std::map<int, std::vector<std::uint32_t>> places;
    for (const Mesh& mesh : from.meshes) {
        const Material& material = from.materials[static_cast<std::size_t>(mesh.material)];
        const auto first = from.indices.begin() + mesh.firstIndex;
        const bool oneSided = sides == Sides::drawn && !material.doubleSided,
                   plain = material.alphaCutoff <= 0 && !oneSided;
        if (sides == Sides::drawn)
            for (std::uint32_t i = 0; i < mesh.indexCount; i += 3)
                places[plain ? -1 : mesh.material].push_back(mesh.firstIndex + i);
        if (plain) {
            opaque.insert(opaque.end(), first, first + mesh.indexCount);
            continue;
        }
        Cutout& cutout = cutouts[mesh.material];
        cutout.cutoff = material.alphaCutoff;
        cutout.oneSided = oneSided;
        const bool masked = material.alphaCutoff > 0;
        const TextureUse& use = material.baseColourTexture;
        if (masked && use.exists()) {
            if (!maps.contains(use.texture))
                maps[use.texture] = alphaMap(from.textures[static_cast<std::size_t>(use.texture)]);
            cutout.map = &maps[use.texture];
        }
        cutout.indices.insert(cutout.indices.end(), first, first + mesh.indexCount);
        for (std::uint32_t i = 0; masked && i < mesh.indexCount; ++i) {
            const Vertex& vertex = from.vertices[first[i]];
            cutout.corners.push_back({use.at(vertex), material.baseColour.a * vertex.colour.a});
        }
    }
    for (auto& [material, each] : places) // as they will be attached
        firsts.push_back(std::move(each));
}

void RayScene::State::attach(const std::vector<std::uint32_t>& indices, Cutout* cutout) {
    if (indices.empty())
        return;
    const EmbreeGeometry geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               positions.data(), 0, sizeof(glm::vec3), positions.size() - 1);
    rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               indices.data(), 0, 3 * sizeof(std::uint32_t), indices.size() / 3);
    if (cutout) {
        rtcSetGeometryUserData(geometry.get(), cutout);
        rtcSetGeometryOccludedFilterFunction(geometry.get(), skipUnseen);
        rtcSetGeometryIntersectFilterFunction(geometry.get(), skipUnseen);
    }
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(scene.get(), geometry.get());
}

RayScene::RayScene(const Scene& scene, Sides sides, bool robust)
    : state_(std::make_unique<State>()) {
    State& state = *state_;
    state.device.reset(rtcNewDevice(nullptr));
    if (!state.device)
        throw Error(fmt::format("expected Embree, the ray tracer, to start; it failed with error "
                                "{}: it needs a processor with SSE2 or NEON, and memory",
                                static_cast<int>(rtcGetDeviceError(nullptr))));
    rtcSetDeviceErrorFunction(state.device.get(), Complaints::add, &state.complaints);
    state.sort(scene, sides);
    state.scene.reset(rtcNewScene(state.device.get()));
    rtcSetSceneFlags(state.scene.get(), robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    rtcSetSceneBuildQuality(state.scene.get(), sides == Sides::both ? RTC_BUILD_QUALITY_HIGH
                                                                    : RTC_BUILD_QUALITY_MEDIUM);
    state.attach(state.opaque, nullptr);
    for (auto& [material, cutout] : state.cutouts)
        state.attach(cutout.indices, &cutout);
    rtcCommitScene(state.scene.get());
    throwErrors();
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;

RTCScene RayScene::handle() const { return state_->scene.get(); }

std::uint32_t RayScene::firstIndex(const RTCHit& hit) const {
    return state_->firsts[hit.geomID][hit.primID];
}

void RayScene::throwErrors() const { state_->complaints.raise(); }

} // namespace obscura
