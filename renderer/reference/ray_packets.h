#pragma once

#include "renderer/frame/surfaces.h"
#include "renderer/reference/ray_scene.h"
#include "renderer/reference/trace_settings.h"

#include <array>
#include <span>

namespace obscura {

// The rays of a reference, as packets of sixteen: one ray from each of sixteen neighbouring pixels,
// all into the same part of their hemispheres, so that they run through the same boxes.
//
// Each pixel has two independently scrambled Sobol nets of n = 2^k points. Each net has exactly one
// point in each of n cells, 2^a x 2^b, of the unit square; pairs of rays from one cell tell how far
// the estimate can be off (reference.cpp). Pixels of a group share the leading digits of their
// scramblings, which decide who is in which cell; the digits within a cell are each pixel's own.
constexpr int packetSize = 16;

class RayPackets {
  public:
    RayPackets(const RayScene& scene, const Surfaces& surfaces, const TraceSettings& settings);

    template <typename T>
    struct alignas(64) Lanes : std::array<T, packetSize> {}; // aligned as Embree wants it

    // Sixteen pixels that show surfaces; the last group may have fewer.
    struct Group {
        int size = 0;
        Lanes<std::size_t> pixel; // index into the surfaces
        Lanes<float> origin[3], begin;
        // World space: columns of the basis around the normal; in that basis, the face normal.
        Lanes<float> across[3], up[3], normal[3], face[3];
        Lanes<std::uint32_t> digits[2][2]; // seeds by scrambling and dimension
        std::uint32_t leading[2][2];
        Lanes<int> valid; // -1 for the lanes in use
    };
    int groups() const { return static_cast<int>((pixels_.size() + packetSize - 1) / packetSize); }
    Group group(int index) const;

    int cells() const { return static_cast<int>(points_.size()); } // n
    int rays() const { return 2 * cells(); }                       // per pixel

    // One packet's rays, and what they were made from.
    struct Packet {
        RTCRayHit16 rays;
        Lanes<float> local[3]; // direction in the basis
        Lanes<int> valid;      // -1: to trace; 0: below the face, or not in use
        int cell;
    };
    // Makes the packet of one point, 0 ... cells() - 1. The points' order makes neighbours of
    // successive packets.
    void fill(const Group& group, int point, int scrambling, Packet& packet) const;

  private:
    struct Point {
        std::uint32_t digits[2]; // both dimensions' binary digits, the first one last
    };
    // Where a pixel's rays start, in world space; unit vectors.
    struct Start {
        glm::vec3 point, normal, face;
        float offset; // along the face normal, metres
    };
    Start startOf(std::size_t pixel) const;

    const RayScene& scene_;
    const Surfaces& surfaces_;
    TraceSettings settings_;
    std::vector<Point> points_;
    std::vector<std::uint32_t> pixels_;      // those that show surfaces, tile by tile
    int firstDigits_ = 0, secondDigits_ = 0; // a, b
};

} // namespace obscura
