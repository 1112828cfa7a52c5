#include "renderer/builtin/masonry.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace obscura::builtin {

namespace {

glm::vec2 onArch(const ArchedWall& wall, float t) { // t: 0 left ... 1 right
    const float angle = glm::pi<float>() * t;
    return {-wall.radius * std::cos(angle), wall.springing + wall.radius * std::sin(angle)};
}

Shape archedFace(const ArchedWall& wall) {
    const float z = wall.thickness / 2;
    Shape shape = patch(
        [&](glm::vec2 uv) {
            const glm::vec2 edge = onArch(wall, uv.x);
            return glm::vec3(edge.x, glm::mix(edge.y, wall.top, uv.y), z);
        },
        24, 2, {1, 1});
    for (const float side : {-1.0F, 1.0F}) {
        const float left = side < 0 ? -wall.bay / 2 : wall.radius;
        const float width = wall.bay / 2 - wall.radius;
        shape.add(patch(
            [&](glm::vec2 uv) {
                return glm::vec3(left + width * uv.x, glm::mix(wall.foot, wall.top, uv.y), z);
            },
            1, 1, {1, 1}));
    }
    return shape;
}

} // namespace

Shape archedWall(const ArchedWall& wall) {
    const float half = wall.thickness / 2;
    Shape shape = archedFace(wall);
    shape.add(archedFace(wall), at({0, 0, 0}, 180));
    shape.add(patch(
        [&](glm::vec2 uv) { return glm::vec3(onArch(wall, uv.x), glm::mix(-half, half, uv.y)); },
        24, 1, {1, 1}));
    if (wall.foot < wall.springing) {
        const Shape jamb = patch(
            [&](glm::vec2 uv) {
                return glm::vec3(-wall.radius, glm::mix(wall.foot, wall.springing, uv.x),
                                 glm::mix(-half, half, uv.y));
            },
            1, 1, {1, 1});
        shape.add(jamb);
        shape.add(jamb, at({0, 0, 0}, 180));
    }
    projectUv(shape);
    return shape;
}

namespace {

// All coordinates at which something begins or ends, in order.
std::vector<float> cutsOf(float low, float high, std::span<const Hole> holes, int axis) {
    std::vector<float> cuts{low, high};
    for (const Hole& hole : holes)
        cuts.insert(cuts.end(), {hole.low[axis], hole.high[axis]});
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    return cuts;
}

// The parallelogram over two edges; faces along a x b.
void addFlat(Shape& shape, glm::vec3 corner, glm::vec3 a, glm::vec3 b) {
    shape.add(patch([=](glm::vec2 uv) { return corner + uv.x * a + uv.y * b; }, 1, 1, {1, 1}));
}

} // namespace

Shape piercedWall(glm::vec3 size, std::span<const Hole> holes) {
    const std::vector<float> xs = cutsOf(-size.x / 2, size.x / 2, holes, 0);
    const std::vector<float> ys = cutsOf(0, size.y, holes, 1);
    const auto isSolid = [&](std::size_t i, std::size_t j) { // cell (i, j) of the grid of cuts
        if (i >= xs.size() - 1 || j >= ys.size() - 1)        // also below 0, which wraps round
            return false;
        const glm::vec2 middle(xs[i] + xs[i + 1], ys[j] + ys[j + 1]);
        return std::none_of(holes.begin(), holes.end(), [&](const Hole& hole) {
            return glm::all(glm::greaterThan(middle / 2.0F, hole.low)) &&
                   glm::all(glm::lessThan(middle / 2.0F, hole.high));
        });
    };
    Shape shape;
    const glm::vec3 back(0, 0, -size.z);
    for (std::size_t j = 0; j + 1 < ys.size(); ++j)
        for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
            if (!isSolid(i, j))
                continue;
            const glm::vec3 x(xs[i + 1] - xs[i], 0, 0), y(0, ys[j + 1] - ys[j], 0);
            const glm::vec3 corner(xs[i], ys[j], size.z / 2);
            addFlat(shape, corner, x, y);
            addFlat(shape, corner + back, y, x);
            if (!isSolid(i - 1, j))
                addFlat(shape, corner, y, back);
            if (!isSolid(i + 1, j))
                addFlat(shape, corner + x, back, y);
            if (!isSolid(i, j - 1))
                addFlat(shape, corner, back, x);
            if (!isSolid(i, j + 1))
                addFlat(shape, corner + y, x, back);
        }
    projectUv(shape);
    return shape;
}

Shape voussoirs(const ArchedWall& wall, int count, float width) {
    Shape ring;
    for (int i = 0; i < count; ++i) {
        const bool key = 2 * i + 1 == count;
        const float inner = wall.radius - (key ? 0.04F : 0.02F);
        const float outer = wall.radius + width * (key ? 1.12F : 1.0F);
        const float middle = (inner + outer) / 2;
        const float joint = 0.008F, angle = glm::pi<float>() / part(count, 1);
        Shape stone =
            box({middle * angle - joint, outer - inner, wall.thickness + (key ? 0.10F : 0.05F)},
                0.012F);
        const float turn = (part(i, 1) + 0.5F) * angle - glm::half_pi<float>();
        deform(stone, [=](glm::vec3 p) {
            const float a = turn + p.x / middle, r = middle + p.y;
            return glm::vec3(r * std::sin(a), r * std::cos(a), p.z);
        });
        for (Vertex& vertex : stone.vertices)
            vertex.uv += part(i, 1) * 0.37F; // each from another part of the quarry
        ring.add(stone, at({0, wall.springing, 0}));
    }
    return ring;
}

namespace {

// The quarter of a groined vault towards +z: a piece of the barrel that runs along z.
Shape vaultQuarter(glm::vec2 half, float rise) {
    return patch(
        [=](glm::vec2 uv) {
            const float across = std::sin(glm::pi<float>() * (uv.x - 0.5F)) * uv.y;
            return glm::vec3(half.x * across, rise * std::sqrt(std::max(0.0F, 1 - across * across)),
                             half.y * uv.y);
        },
        12, 6, {2 * half.x, half.y});
}

} // namespace

Shape groinVault(glm::vec2 half, float rise) {
    Shape shape;
    for (int i = 0; i < 4; ++i)
        shape.add(vaultQuarter(i % 2 == 0 ? half : glm::vec2(half.y, half.x), rise),
                  at({0, 0, 0}, 90 * part(i, 1)));
    projectUv(shape);
    return shape;
}

Shape rib(float half, float rise, float width) {
    std::vector<glm::vec3> path;
    for (int i = 0; i <= 16; ++i) {
        const float angle = glm::pi<float>() * part(i, 16);
        path.push_back({0, rise * std::sin(angle), half * std::cos(angle)});
    }
    const float w = width / 2, d = 0.12F;
    Outline outline{{0.05F, w}, {-0.6F * d, w}, {-0.6F * d, 0.8F * w}};
    addArc(outline, {-0.6F * d, 0.6F * w}, 0.2F * w, 90, 180, 3);
    outline.insert(outline.end(), {{-d, 0.4F * w}, {-d, -0.4F * w}});
    addArc(outline, {-0.6F * d, -0.6F * w}, 0.2F * w, 180, 270, 3);
    outline.insert(outline.end(), {{-0.6F * d, -0.8F * w}, {-0.6F * d, -w}, {0.05F, -w}});
    return arch(outline, path, {0, 0, 0});
}

Shape innerMoulding(const Outline& outline, glm::vec2 half) {
    const std::array<glm::vec2, 4> plan{half, glm::vec2(-half.x, half.y), -half,
                                        glm::vec2(half.x, -half.y)};
    return moulding(outline, plan);
}

Shape cornice(glm::vec2 half, float depth, float height) {
    const float d = depth, h = height;
    Outline outline{{0, 0}, {0.12F * d, 0}, {0.12F * d, 0.10F * h}};
    addArc(outline, {0.12F * d + 0.22F * h, 0.10F * h}, 0.22F * h, 180, 90, 5); // cavetto
    outline.insert(outline.end(), {{0.80F * d, 0.34F * h}, {0.80F * d, 0.60F * h}});
    addArc(outline, {0.80F * d, 0.60F * h + 0.12F * h}, 0.12F * h, -90, 0, 4); // ovolo
    outline.insert(outline.end(), {{d, 0.78F * h}, {d, h}, {-0.3F, h}});
    return innerMoulding(outline, half);
}

Shape dentils(glm::vec2 half, glm::vec3 size, float spacing) {
    Shape shape;
    const Shape block = box(size, 0.06F * size.x);
    for (int side = 0; side < 4; ++side) {
        const bool onX = side % 2 == 0; // the side runs along x
        const float length = 2 * (onX ? half.x : half.y) - 2 * size.z;
        const int count = static_cast<int>(length / spacing);
        const glm::mat4 place = at({0, 0, 0}, 90 * part(side, 1));
        for (int i = 0; i < count; ++i) {
            const float x = (part(i, 1) + 0.5F - part(count, 2)) * length / part(count, 1);
            const float z = (onX ? half.y : half.x) - size.z / 2;
            shape.add(block, place * at({x, -size.y / 2, -z}));
        }
    }
    return shape;
}

} // namespace obscura::builtin
