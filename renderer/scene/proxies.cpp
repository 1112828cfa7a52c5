#include "renderer/scene/proxies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace obscura {

namespace {

// A part of a triangle, small against the spheres. A sphere that contains its corners contains all
// of it.
struct Piece {
    glm::vec3 corners[3];
    glm::vec3 normal;
    float area;

    // What clusters are split by: where a piece is and which way it faces.
    float coordinate(int axis) const {
        return axis < 3 ? (corners[0][axis] + corners[1][axis] + corners[2][axis]) / 3
                        : normal[axis - 3];
    }
};

void addPieces(std::vector<Piece>& pieces, const glm::vec3& a, const glm::vec3& b,
               const glm::vec3& c, float longest) {
    const float ab = glm::distance(a, b), bc = glm::distance(b, c), ca = glm::distance(c, a);
    if (ab < bc && ca <= bc)
        return addPieces(pieces, b, c, a, longest);
    if (ab < ca)
        return addPieces(pieces, c, a, b, longest);
    if (longest < ab) {
        const glm::vec3 middle = (a + b) * 0.5f;
        addPieces(pieces, a, middle, c, longest);
        addPieces(pieces, middle, b, c, longest);
        return;
    }
    const glm::vec3 across = glm::cross(b - a, c - a);
    if (const float twice = glm::length(across); twice > 0)
        pieces.push_back({{a, b, c}, across / twice, twice / 2});
}

std::vector<Piece> piecesOf(const Scene& scene, int count) {
    const auto corner = [&](std::size_t i) { return scene.vertices[scene.indices[i]].position; };
    double area = 0;
    for (std::size_t i = 0; i + 2 < scene.indices.size(); i += 3)
        area += glm::length(glm::cross(corner(i + 1) - corner(i), corner(i + 2) - corner(i))) / 2.0;
    std::vector<Piece> pieces;
    if (area > 0) // else there is nothing to see
        for (std::size_t i = 0; i + 2 < scene.indices.size(); i += 3)
            addPieces(pieces, corner(i), corner(i + 1), corner(i + 2),
                      static_cast<float>(std::sqrt(area / count) / 2));
    return pieces;
}

constexpr double airPenalty = 10;

struct Sphere {
    glm::vec3 centre{0};
    float radius = 0;
    // The volume by which it bulges out of the surface that it stands for: its disc's area x the
    // mean height of its top above the planes of its pieces. None for the ball itself; its radius
    // above a flat patch. A centre in the air, as in the corner of a room, would occlude the very
    // surface that the sphere stands for, so that it costs much more, and gets split first.
    double bulge = 0;
    bool round = false; // the mean height is less than a tenth of the radius: it is the body itself
};

// Nearly the smallest sphere around every `stride`th piece: from the middle of their box, a few
// ever smaller steps towards the farthest point (Badoiu and Clarkson 2003), the best of which
// counts. Its centre lies on a flat patch, and inside a body.
Sphere sphereAround(std::span<const Piece> pieces, std::size_t stride) {
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (std::size_t i = 0; i < pieces.size(); i += stride)
        for (const glm::vec3& corner : pieces[i].corners) {
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
    Sphere sphere;
    glm::vec3 centre = (low + high) * 0.5f;
    float smallest = std::numeric_limits<float>::max();
    for (int step = 0; step < 8; ++step) {
        float farthest = -1; // squared
        glm::vec3 target(0);
        for (std::size_t i = 0; i < pieces.size(); i += stride)
            for (const glm::vec3& corner : pieces[i].corners) {
                const glm::vec3 away = corner - centre;
                if (const float squared = glm::dot(away, away); squared > farthest) {
                    farthest = squared;
                    target = corner;
                }
            }
        if (farthest < smallest) {
            smallest = farthest;
            sphere.centre = centre;
        }
        centre += (target - centre) / static_cast<float>(8 + step);
    }
    sphere.radius = std::sqrt(smallest);
    double heights = 0, areas = 0;
    for (std::size_t i = 0; i < pieces.size(); i += stride) {
        const double height =
            sphere.radius + glm::dot(pieces[i].normal, sphere.centre - pieces[i].corners[0]);
        const double air = std::max(height - sphere.radius, 0.0); // of the centre above the plane
        heights += pieces[i].area * (std::max(height, 0.0) + airPenalty * air);
        areas += pieces[i].area;
    }
    const double mean = areas > 0 ? heights / areas : 0; // 0: too small for numbers
    sphere.bulge = std::numbers::pi * sphere.radius * sphere.radius * mean;
    sphere.round = mean <= 0.1 * sphere.radius;
    return sphere;
}

struct Cluster {
    std::span<Piece> pieces;
    Sphere sphere;
    bool final = false; // no split makes it better
};

// The two halves of the best split in the middle of any coordinate's range, judged by a few hundred
// pieces. All choices clear ties by a margin, so that rounding does not change them with scale.
constexpr float margin = 1e-3f;

std::size_t split(std::span<Piece> pieces) {
    const std::size_t stride = std::max<std::size_t>(pieces.size() / 256, 1);
    double best = std::numeric_limits<double>::max();
    int axis = -1;
    float threshold = 0;
    std::vector<Piece> few, sides[2];
    for (std::size_t i = 0; i < pieces.size(); i += stride)
        few.push_back(pieces[i]);
    for (int a = 0; a < 6; ++a) {
        const auto [low, high] =
            std::minmax_element(few.begin(), few.end(), [&](const Piece& p, const Piece& q) {
                return p.coordinate(a) < q.coordinate(a);
            });
        const float from = low->coordinate(a), to = high->coordinate(a);
        const float middle = from + (to - from) * (0.5f + margin);
        for (std::vector<Piece>& side : sides)
            side.clear();
        for (const Piece& piece : few)
            sides[piece.coordinate(a) < middle].push_back(piece);
        if (sides[0].empty() || sides[1].empty())
            continue;
        const double bulge = sphereAround(sides[0], 1).bulge + sphereAround(sides[1], 1).bulge;
        if (bulge < best * (1 - margin)) {
            best = bulge;
            axis = a;
            threshold = middle;
        }
    }
    if (axis < 0)
        return 0;
    const auto second =
        std::stable_partition(pieces.begin(), pieces.end(), [&](const Piece& piece) {
            return piece.coordinate(axis) < threshold;
        });
    return static_cast<std::size_t>(second - pieces.begin());
}

// Spheres are made larger by the margin in the end.
bool contains(const Sphere& sphere, std::span<const Piece> pieces) {
    const float squared = sphere.radius * sphere.radius * (1 + margin) * (1 + margin);
    for (const Piece& piece : pieces)
        for (const glm::vec3& corner : piece.corners)
            if (const glm::vec3 away = corner - sphere.centre; glm::dot(away, away) > squared)
                return false;
    return true;
}

// Leaves out spheres whose pieces a larger one contains as well.
std::vector<glm::vec4> withoutSpare(const std::vector<Cluster>& clusters) {
    std::vector<glm::vec4> spheres;
    for (const Cluster& cluster : clusters)
        if (std::none_of(clusters.begin(), clusters.end(), [&](const Cluster& other) {
                return other.sphere.radius > cluster.sphere.radius * (1 + margin) &&
                       contains(other.sphere, cluster.pieces);
            }))
            spheres.emplace_back(cluster.sphere.centre, cluster.sphere.radius * (1 + margin));
    return spheres;
}

} // namespace

// From one sphere around everything, the one that bulges out most is split, until there are enough.
std::vector<glm::vec4> proxySpheres(const Scene& scene, int count) {
    std::vector<Piece> pieces = piecesOf(scene, count);
    std::vector<Cluster> clusters;
    if (!pieces.empty())
        clusters.push_back({pieces, sphereAround(pieces, 1)});
    while (!clusters.empty() && static_cast<int>(clusters.size()) < count) {
        Cluster* worst = nullptr;
        for (Cluster& cluster : clusters)
            if (!cluster.final &&
                (!worst || cluster.sphere.bulge > worst->sphere.bulge * (1 + margin)))
                worst = &cluster;
        if (!worst)
            break;
        const std::size_t first = worst->sphere.round ? 0 : split(worst->pieces);
        if (first == 0) {
            worst->final = true;
            continue;
        }
        const std::span<Piece> rest = worst->pieces.subspan(first);
        worst->pieces = worst->pieces.first(first);
        worst->sphere = sphereAround(worst->pieces, 1);
        clusters.push_back({rest, sphereAround(rest, 1)});
    }
    return withoutSpare(clusters);
}

} // namespace obscura
