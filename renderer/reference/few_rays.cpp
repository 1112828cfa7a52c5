// Compiled for vectors (CMakeLists.txt).
#include "renderer/reference/few_rays.h"

#include "base/parallel.h"
#include "renderer/reference/ray_scene.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

namespace obscura {

namespace {

constexpr int tile = 64; // pixels, after which the pattern of rays repeats
constexpr int block = 8; // pixels, whose rays are sorted by direction
constexpr int blocks = tile / block;
constexpr std::size_t blockPixels = block * block, lanes = 16;

template <typename T, std::size_t count>
struct alignas(64) Row : std::array<T, count> {};

// Sixteen rays of like direction, of pixels of one block.
struct Packet {
    Row<float, lanes> sphere[3];            // a unit vector; added to the normal it is a ray
    std::array<std::uint16_t, lanes> pixel; // in the block, row by row
};

// shaders/hilbert.glsl.
std::uint32_t hilbertIndex(std::uint32_t x, std::uint32_t y) {
    std::uint32_t index = 0;
    for (int level = 5; level >= 0; --level) {
        const std::uint32_t right = (x >> level) & 1, upper = (y >> level) & 1;
        index = 4 * index + ((3 * right) ^ upper);
        const std::uint32_t flip = 0u - (right & ~upper);
        x ^= flip;
        y ^= flip;
        const std::uint32_t swap = (x ^ y) & (upper - 1u);
        x ^= swap;
        y ^= swap;
    }
    return index;
}

// The rays of a block, sorted so that those of a packet have like directions.
std::vector<Packet> packetsOf(int blockX, int blockY, std::uint32_t rays, std::uint32_t seed) {
    struct Ray {
        std::uint32_t place, u, v;
        std::uint16_t pixel;
    };
    // Bits of u and v in turn, a Morton curve.
    const auto spread = [](std::uint32_t bits) { // the first sixteen
        std::uint32_t x = bits >> 16;
        x = (x | (x << 8)) & 0x00ff00ffu;
        x = (x | (x << 4)) & 0x0f0f0f0fu;
        x = (x | (x << 2)) & 0x33333333u;
        return (x | (x << 1)) & 0x55555555u;
    };
    std::vector<Ray> sorted;
    for (std::uint16_t pixel = 0; pixel < static_cast<std::uint16_t>(blockPixels); ++pixel) {
        const auto x = static_cast<std::uint32_t>(blockX * block + pixel % block),
                   y = static_cast<std::uint32_t>(blockY * block + pixel / block);
        const std::uint32_t first = (hilbertIndex(x, y) + 288u * seed) * rays;
        for (std::uint32_t i = 0; i < rays; ++i) {
            const std::uint32_t u = (first + i) * 3242174889u, v = (first + i) * 2447445414u;
            sorted.push_back({spread(u) << 1 | spread(v), u, v, pixel});
        }
    }
    std::sort(sorted.begin(), sorted.end(),
              [](const Ray& a, const Ray& b) { return a.place < b.place; });
    std::vector<Packet> packets(sorted.size() / lanes);
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        Packet& packet = packets[i / lanes];
        const std::size_t lane = i % lanes;
        const float u = static_cast<float>(sorted[i].u >> 8) * 0x1p-24f,
                    turn = static_cast<float>(sorted[i].v >> 8) * 0x1p-24f;
        const float angle = 2 * std::numbers::pi_v<float> * turn, ring = 2 * std::sqrt(u * (1 - u));
        packet.sphere[0][lane] = ring * std::cos(angle);
        packet.sphere[1][lane] = ring * std::sin(angle);
        packet.sphere[2][lane] = 1 - 2 * u;
        packet.pixel[lane] = sorted[i].pixel;
    }
    return packets;
}

// What a block's pixels show, in world space.
struct Points {
    Row<float, blockPixels> origin[3], normal[3];
    Row<int, blockPixels> valid, open;
};

// A picture to trace for, rows from the bottom.
struct Picture {
    Frame frame;
    int width, height;
    const float* depth;
    const std::uint16_t* normals; // half floats, four a pixel, view space
    float radius;
    float rounding; // of world positions, metres
};

// Of a number below 2. As whole numbers a half's and a float's parts only lie at other places.
inline float ofHalf(std::uint32_t half) {
    const float value = std::bit_cast<float>((half & 0x7fffu) << 13) * 0x1p112f;
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) | (half & 0x8000u) << 16);
}

// A ray starts .8 % of a pixel's width above the surface, twice what rasterisers snap corners to
// (1/256), towards the camera and along the normal: so it starts before the face, and one that a
// tilted normal sends below the face meets that and is blocked. From higher up it would pass over
// faces that are narrower than a pixel. A depth that was rounded
// may lie half a step behind the surface; as much nearer to the camera, it does not.
#if defined(__x86_64__)
__attribute__((target_clones("avx2", "default")))
#endif
void locate(const Picture& __restrict picture, int firstX, int y, int count, std::size_t at,
            Points& __restrict points) {
    const Frame& frame = picture.frame;
    const float empty = frame.depth.y, pixel = std::fabs(frame.viewFromUv.y) * frame.size.w;
    const float vy =
        (static_cast<float>(y) + 0.5f) * frame.size.w * frame.viewFromUv.y + frame.viewFromUv.w;
    const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                            static_cast<std::size_t>(firstX);
    const glm::mat4& m = frame.worldFromView;
    for (int i = 0; i < count; ++i) {
        const std::size_t from = row + static_cast<std::size_t>(i);
        const std::size_t to = at + static_cast<std::size_t>(i);
        const float stored = picture.depth[from];
        const float step = stored * (frame.depthStep.x + stored * frame.depthStep.y);
        const float depth = stored - 0.5f * step;
        const float vx =
            (static_cast<float>(firstX + i) + 0.5f) * frame.size.z * frame.viewFromUv.x +
            frame.viewFromUv.z;
        float nx = ofHalf(picture.normals[4 * from]), ny = ofHalf(picture.normals[4 * from + 1]),
              nz = ofHalf(picture.normals[4 * from + 2]);
        const float toEye = 1 / std::sqrt(vx * vx + vy * vy + 1);
        const float length = nx * nx + ny * ny + nz * nz;
        const bool usable = length > 0.9f; // else it faces the camera
        const float scale = usable ? 1 / std::sqrt(length) : 1.0f;
        nx = usable ? nx * scale : -vx * toEye;
        ny = usable ? ny * scale : -vy * toEye;
        nz = usable ? nz * scale : toEye;
        const float offset = 0.008f * depth * pixel + picture.rounding;
        const float px = vx * depth + offset * (nx - vx * toEye),
                    py = vy * depth + offset * (ny - vy * toEye),
                    pz = -depth + offset * (nz + toEye);
        for (int axis = 0; axis < 3; ++axis) {
            points.origin[axis][to] =
                m[0][axis] * px + m[1][axis] * py + m[2][axis] * pz + m[3][axis];
            points.normal[axis][to] = m[0][axis] * nx + m[1][axis] * ny + m[2][axis] * nz;
        }
        points.valid[to] = stored < empty ? -1 : 0;
    }
}

// The one loop that every ray goes through.
#if defined(__x86_64__)
__attribute__((target_clones("avx2", "default")))
#endif
void aim(const Points& __restrict points, const Packet& __restrict packet, float radius,
         RTCRay16& __restrict rays, int* __restrict valid) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const std::size_t pixel = packet.pixel[lane];
        const float x = points.normal[0][pixel] + packet.sphere[0][lane],
                    y = points.normal[1][pixel] + packet.sphere[1][lane],
                    z = points.normal[2][pixel] + packet.sphere[2][lane];
        const float scale = 1 / std::sqrt(x * x + y * y + z * z + 1e-12f);
        rays.dir_x[lane] = x * scale;
        rays.dir_y[lane] = y * scale;
        rays.dir_z[lane] = z * scale;
        rays.org_x[lane] = points.origin[0][pixel];
        rays.org_y[lane] = points.origin[1][pixel];
        rays.org_z[lane] = points.origin[2][pixel];
        rays.tfar[lane] = radius;
        valid[lane] = points.valid[pixel];
    }
}

void trace(const RayScene& scene, const Picture& picture, std::span<const Packet> packets,
           int firstX, int firstY, float* visibility) {
    const int width = std::min(block, picture.width - firstX),
              height = std::min(block, picture.height - firstY);
    Points points{}; // numbers also beyond the picture, because Embree's assertions read every lane
    for (int y = 0; y < height; ++y)
        locate(picture, firstX, firstY + y, width, static_cast<std::size_t>(y * block), points);
    RTCRay16 rays;
    Row<int, lanes> valid;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        rays.tnear[lane] = 0;
        rays.time[lane] = 0;
        rays.mask[lane] = ~0u;
        rays.flags[lane] = 0;
        rays.id[lane] = 0;
    }
    for (const Packet& packet : packets) {
        aim(points, packet, picture.radius, rays, valid.data());
        findAny(scene.handle(), valid.data(), rays, Coherence::none);
        for (std::size_t lane = 0; lane < lanes; ++lane)
            points.open[packet.pixel[lane]] += rays.tfar[lane] >= 0 ? 1 : 0;
    }
    const float share =
        static_cast<float>(blockPixels) / static_cast<float>(packets.size() * lanes);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto at = static_cast<std::size_t>(y * block + x);
            visibility[static_cast<std::size_t>(firstY + y) *
                           static_cast<std::size_t>(picture.width) +
                       static_cast<std::size_t>(firstX + x)] =
                points.valid[at] ? static_cast<float>(points.open[at]) * share : 1.0f;
        }
}

} // namespace

struct FewRays::State {
    std::shared_ptr<const Scene> geometry;
    std::optional<RayScene> scene;
    std::array<std::vector<Packet>, static_cast<std::size_t>(blocks* blocks)> pattern;
    std::uint32_t rays = 0, seed = 0; // of the pattern
    std::vector<float> visibility;
    gl::Texture texture{};
    int width = 0, height = 0; // of the texture

    void prepare(std::uint32_t wantedRays, std::uint32_t wantedSeed) {
        if (!scene)
            scene.emplace(*geometry, RayScene::Sides::both, false);
        if (rays == wantedRays && seed == wantedSeed)
            return;
        forEachInParallel(blocks * blocks, [&](int i) {
            pattern[static_cast<std::size_t>(i)] =
                packetsOf(i % blocks, i / blocks, wantedRays, wantedSeed);
        });
        rays = wantedRays;
        seed = wantedSeed;
    }
};

FewRays::FewRays(std::shared_ptr<const Scene> scene) : state_(std::make_unique<State>()) {
    state_->geometry = std::move(scene);
}
FewRays::~FewRays() = default;
FewRays::FewRays(FewRays&&) noexcept = default;

const gl::Texture& FewRays::operator()(const GBuffer& gbuffer, const Frame& frame, float radius,
                                       int rays) const {
    State& state = *state_;
    const int width = gbuffer.target().width(), height = gbuffer.target().height();
    state.prepare(static_cast<std::uint32_t>(rays),
                  static_cast<std::uint32_t>(frame.seed.x + frame.seed.y));
    const std::vector<float> depth =
        gl::readFloats(gbuffer.depth(), width, height, gl::Format::r32f);
    const std::vector<std::byte> normals =
        gl::readBytes(*gbuffer.occlusionNormal(), width, height, gl::Format::rgba16f);
    const glm::vec3 eye(frame.worldFromView[3]);
    const float farthest =
        std::max({std::abs(eye.x), std::abs(eye.y), std::abs(eye.z), frame.depth.y});
    const Picture picture{frame,
                          width,
                          height,
                          depth.data(),
                          reinterpret_cast<const std::uint16_t*>(normals.data()),
                          radius,
                          8 * std::numeric_limits<float>::epsilon() * farthest};
    state.visibility.resize(depth.size());
    const int across = (width + block - 1) / block, down = (height + block - 1) / block;
    forEachInParallel(across * down, [&](int i) {
        const int x = i % across, y = i / across;
        trace(*state.scene, picture,
              state.pattern[static_cast<std::size_t>(y % blocks * blocks + x % blocks)], x * block,
              y * block, state.visibility.data());
    });
    state.scene->throwErrors();
    if (state.width != width || state.height != height) {
        state.texture = gl::targetTexture(width, height, gl::Format::r32f, "traced visibility");
        state.width = width;
        state.height = height;
    }
    gl::writeFloats(state.texture, width, height, state.visibility);
    return state.texture;
}

} // namespace obscura
