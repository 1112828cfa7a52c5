// Compiled for vectors (CMakeLists.txt): the loops over lanes are most of a ray's cost besides
// Embree's own.
#include "renderer/reference/ray_packets.h"

#include "renderer/reference/sobol.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

namespace obscura {

namespace {

// How far above its triangle a ray starts: some units in the last place of the scene's size, for
// Embree's error grows with a triangle's.
constexpr float roundingShare = 8 * std::numeric_limits<float>::epsilon();

std::uint64_t mixed(std::uint64_t value) { // Steele et al. 2014, "splitmix64"
    value += 0x9e3779b97f4a7c15u;
    value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9u;
    value = (value ^ (value >> 27)) * 0x94d049bb133111ebu;
    return value ^ (value >> 31);
}

// Sine and cosine of 2 pi (turn - 1/2), within 1e-6: Taylor series on an eighth of the circle, and
// the angle doubled twice. Branch-free, so that it runs on vectors.
struct SineCosine {
    float sine, cosine;
};
inline SineCosine ofTurn(float turn) {
    const float x = (turn - 0.5f) * (std::numbers::pi_v<float> / 2), x2 = x * x;
    float s = x * (1 + x2 * (-1.0f / 6 + x2 * (1.0f / 120 + x2 * (-1.0f / 5040 + x2 / 362880))));
    float c = 1 + x2 * (-1.0f / 2 + x2 * (1.0f / 24 + x2 * (-1.0f / 720 + x2 / 40320)));
    for (int doubling = 0; doubling < 2; ++doubling) {
        const float sine = 2 * s * c;
        c = 1 - 2 * s * s;
        s = sine;
    }
    return {s, c};
}

bool usable(glm::vec3 unit) { return std::abs(glm::dot(unit, unit) - 1) < 0.01f; } // not NaN

float largest(glm::vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// Bits of a and b in turn: the order of a Morton curve.
std::uint64_t interleaved(std::uint32_t a, std::uint32_t b) {
    std::uint64_t result = 0;
    for (int bit = 31; bit >= 0; --bit)
        result = (result << 2) | ((a >> bit) & 1) << 1 | ((b >> bit) & 1);
    return result;
}

} // namespace

RayPackets::RayPackets(const RayScene& scene, const Surfaces& surfaces,
                       const TraceSettings& settings)
    : scene_(scene), surfaces_(surfaces), settings_(settings) {
    const auto cells = std::bit_ceil(static_cast<std::uint32_t>(std::max(settings.rays, 2))) / 2;
    // More digits for the azimuth make cells of about equal width and length.
    const int digits = std::countr_zero(cells);
    firstDigits_ = std::max(digits - 1, 0) / 2;
    secondDigits_ = digits - firstDigits_;
    for (std::uint32_t i = 0; i < cells; ++i)
        points_.push_back({{i, reversedBits(sobolSecondDimension(i))}});
    std::sort(points_.begin(), points_.end(), [](const Point& p, const Point& q) {
        const auto place = [](const Point& point) {
            return interleaved(reversedBits(point.digits[1]), reversedBits(point.digits[0]));
        };
        return place(p) < place(q);
    });
    constexpr int tile = 4;
    for (int tileY = 0; tileY < surfaces.height; tileY += tile)
        for (int tileX = 0; tileX < surfaces.width; tileX += tile)
            for (int y = tileY; y < std::min(tileY + tile, surfaces.height); ++y)
                for (int x = tileX; x < std::min(tileX + tile, surfaces.width); ++x)
                    if (const std::size_t i = surfaces.index(x, y); !surfaces.empty(i))
                        pixels_.push_back(static_cast<std::uint32_t>(i));
}

// Rasterisers snap corners to 1/256 pixel, so a G-buffer's point may lie beside its triangle: in a
// concave edge, behind the next one. The ray through the pixel's centre meets the true surface
// nearby. Where it meets none within a pixel's width, the G-buffer's own point must do.
RayPackets::Start RayPackets::startOf(std::size_t pixel) const {
    const Frame& frame = surfaces_.frame;
    const glm::mat3 worldFromView(frame.worldFromView);
    const auto width = static_cast<std::size_t>(surfaces_.width);
    const float depth = surfaces_.depth[pixel];
    const glm::vec3 view = surfaces_.position(static_cast<float>(pixel % width),
                                              static_cast<float>(pixel / width), depth);
    // A triangle seen edge-on, or a vertex without a normal, may have none that is a number.
    glm::vec3 face = surfaces_.faceNormal[pixel], normal = surfaces_.normal[pixel];
    if (!usable(face))
        face = usable(normal) ? normal : -glm::normalize(view);
    if (!usable(normal))
        normal = face;
    Start start{glm::vec3(frame.worldFromView * glm::vec4(view, 1)),
                glm::normalize(worldFromView * normal), worldFromView * face, 0};
    const glm::vec3 camera(frame.worldFromView[3]);
    start.offset = roundingShare * std::max({largest(start.point), largest(camera), frame.depth.y});
    const float reach =
        4 * start.offset + depth * std::abs(frame.viewFromUv.y) * frame.size.w; // a pixel's width
    const glm::vec3 ahead = worldFromView * glm::normalize(view);
    const float distance = glm::length(view), first = std::max(distance - reach, 0.0f);
    const glm::vec3 from = start.point + ahead * (first - distance);
    RTCRayHit ray{};
    ray.ray = {from.x, from.y, from.z, 0, ahead.x, ahead.y, ahead.z, 0, distance - first + reach,
               ~0u,    0,      0};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    findNearest(scene_.handle(), ray);
    const glm::vec3 cross(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z);
    const glm::vec3 found = glm::normalize(cross);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID || !usable(found))
        return start;
    start.point = from + ahead * ray.ray.tfar;
    start.face = glm::dot(found, ahead) > 0 ? -found : found;
    return start;
}

RayPackets::Group RayPackets::group(int index) const {
    Group group;
    const auto first = static_cast<std::size_t>(index) * packetSize;
    group.size = static_cast<int>(std::min<std::size_t>(packetSize, pixels_.size() - first));
    for (int scrambling = 0; scrambling < 2; ++scrambling) {
        const std::uint64_t seed =
            mixed(mixed(settings_.seed) + static_cast<std::uint64_t>(scrambling));
        const std::uint64_t shared = settings_.sameRays
                                         ? mixed(seed)
                                         : mixed(seed ^ mixed(~static_cast<std::uint64_t>(index)));
        group.leading[scrambling][0] = static_cast<std::uint32_t>(shared);
        group.leading[scrambling][1] = static_cast<std::uint32_t>(shared >> 32);
        for (std::size_t lane = 0; lane < packetSize; ++lane) {
            const std::uint64_t own = settings_.sameRays ? seed : mixed(seed ^ mixed(first + lane));
            group.digits[scrambling][0][lane] = static_cast<std::uint32_t>(own);
            group.digits[scrambling][1][lane] = static_cast<std::uint32_t>(own >> 32);
        }
    }
    for (int lane = 0; lane < packetSize; ++lane) {
        const auto l = static_cast<std::size_t>(lane);
        const std::size_t pixel = pixels_[first + (lane < group.size ? l : 0)];
        group.pixel[l] = pixel;
        group.valid[l] = lane < group.size ? -1 : 0;
        const Start start = startOf(pixel);
        const glm::mat3 basis = basisAround(start.normal);
        const glm::vec3 origin = start.point + start.face * start.offset;
        const glm::vec3 local = glm::transpose(basis) * start.face;
        group.begin[l] = std::min(start.offset, static_cast<float>(settings_.radius) / 2);
        for (int axis = 0; axis < 3; ++axis) {
            group.origin[axis][l] = origin[axis];
            group.across[axis][l] = basis[0][axis];
            group.up[axis][l] = basis[1][axis];
            group.normal[axis][l] = basis[2][axis];
            group.face[axis][l] = local[axis];
        }
    }
    return group;
}

namespace {

// The first `count` of 32 binary digits.
std::uint32_t leadingMask(int count) { return count == 0 ? 0u : ~std::uint32_t{0} << (32 - count); }

// What all lanes of a packet share.
struct Shared {
    std::uint32_t digits[2], cell[2], mask[2]; // by dimension
    int scrambling;
    bool uniform;
};

// The one loop that every ray goes through. No branches and no aliases: it runs on vectors.
#if defined(__x86_64__)
__attribute__((target_clones("avx2", "default")))
#endif
void aim(const RayPackets::Group& __restrict group, const Shared& __restrict shared,
         RayPackets::Packet& __restrict packet) {
    RTCRay16& rays = packet.rays.ray;
    const float uniform = shared.uniform ? 1.0f : 0.0f;
    for (std::size_t lane = 0; lane < packetSize; ++lane) {
        const std::uint32_t x = (reversedBits(scrambledReversed(
                                     shared.digits[0], group.digits[shared.scrambling][0][lane])) &
                                 ~shared.mask[0]) |
                                shared.cell[0];
        const std::uint32_t y = (reversedBits(scrambledReversed(
                                     shared.digits[1], group.digits[shared.scrambling][1][lane])) &
                                 ~shared.mask[1]) |
                                shared.cell[1];
        // As signed numbers, which vectors convert in one step.
        const float u = static_cast<float>(static_cast<std::int32_t>(x >> 8)) * 0x1p-24f;
        const float turn = static_cast<float>(static_cast<std::int32_t>(y >> 8)) * 0x1p-24f;
        const auto [sine, cosine] = ofTurn(turn);
        // cosineDirection or uniformDirection (sobol.h): heights sqrt(1 - u) and 1 - u.
        const float length = std::sqrt(u * (1 + uniform * (1 - u)));
        const float a = length * cosine, b = length * sine, root = std::sqrt(1 - u);
        const float c = root * (1 - uniform + uniform * root);
        packet.local[0][lane] = a;
        packet.local[1][lane] = b;
        packet.local[2][lane] = c;
        rays.dir_x[lane] =
            group.across[0][lane] * a + group.up[0][lane] * b + group.normal[0][lane] * c;
        rays.dir_y[lane] =
            group.across[1][lane] * a + group.up[1][lane] * b + group.normal[1][lane] * c;
        rays.dir_z[lane] =
            group.across[2][lane] * a + group.up[2][lane] * b + group.normal[2][lane] * c;
        const float height =
            group.face[0][lane] * a + group.face[1][lane] * b + group.face[2][lane] * c;
        packet.valid[lane] = group.valid[lane] & (height > 0 ? -1 : 0);
    }
}

} // namespace

void RayPackets::fill(const Group& group, int point, int scrambling, Packet& packet) const {
    const Point& p = points_[static_cast<std::size_t>(point)];
    const int counts[2] = {firstDigits_, secondDigits_};
    Shared shared{
        {p.digits[0], p.digits[1]}, {}, {}, scrambling, settings_.integral == Integral::uniform};
    std::uint32_t place[2];
    for (int dimension = 0; dimension < 2; ++dimension) {
        shared.mask[dimension] = leadingMask(counts[dimension]);
        shared.cell[dimension] = reversedBits(scrambledReversed(
                                     p.digits[dimension], group.leading[scrambling][dimension])) &
                                 shared.mask[dimension];
        place[dimension] = std::rotl(shared.cell[dimension], counts[dimension]);
    }
    packet.cell = static_cast<int>(place[0] << secondDigits_ | place[1]);
    aim(group, shared, packet);
    RTCRay16& rays = packet.rays.ray;
    for (std::size_t lane = 0; lane < packetSize; ++lane) {
        rays.org_x[lane] = group.origin[0][lane];
        rays.org_y[lane] = group.origin[1][lane];
        rays.org_z[lane] = group.origin[2][lane];
        rays.tnear[lane] = group.begin[lane];
        rays.tfar[lane] = static_cast<float>(settings_.radius);
        rays.time[lane] = 0;
        rays.mask[lane] = ~0u;
        rays.flags[lane] = 0;
        packet.rays.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    }
}

} // namespace obscura
