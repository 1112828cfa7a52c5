#include "renderer/builtin/plants.h"

#include "renderer/builtin/noise.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace obscura::builtin {

namespace {

glm::vec3 anyDirection(Random& random) {
    const float y = between(random, -1, 1), turn = between(random, 0, glm::two_pi<double>());
    const float out = std::sqrt(1 - y * y);
    return {out * std::cos(turn), y, out * std::sin(turn)};
}

// A unit vector across `along`, as near to `out` as can be.
glm::vec3 across(glm::vec3 out, glm::vec3 along) {
    const glm::vec3 axis = glm::normalize(along);
    const glm::vec3 rest = out - glm::dot(out, axis) * axis;
    if (glm::length(rest) > 1e-3F)
        return glm::normalize(rest);
    return across(glm::vec3(axis.y, axis.z, axis.x), along);
}

} // namespace

void addCard(Shape& shape, const Card& card, int acrossCells, int up) {
    const glm::vec3 out = across(card.out, card.along);
    const glm::vec3 side = glm::normalize(glm::cross(card.along, out));
    const float length = glm::length(card.along);
    shape.add(patch(
        [&](glm::vec2 uv) {
            const float s = 2 * uv.x - 1, t = uv.y;
            const float dish = 0.25F * card.width * s * s;
            return card.foot + t * card.along + 0.5F * card.width * s * side +
                   (dish - card.bend * length * t * t) * out;
        },
        acrossCells, up, {1, 1}));
}

namespace {

struct Branch {
    glm::vec3 foot, direction;
    float length, radius;
};

class Growth {
  public:
    Growth(Tree& tree, Random& random, float leaf) : tree_(tree), random_(random), leaf_(leaf) {}

    void grow(const Branch& branch, std::span<const int> children) {
        const std::vector<glm::vec4> path = bent(branch);
        tree_.wood.add(tube(path, branch.radius > 0.05F ? 12 : (branch.radius > 0.012F ? 6 : 3)));
        if (children.empty()) {
            addLeaves(path);
            return;
        }
        const int count = children.front();
        const float start = between(random_, 0, 6.28);
        for (int i = 0; i < count; ++i) {
            const float t = glm::mix(0.42F, 1.0F, part(i, count - 1));
            const glm::vec3 foot = at(path, t);
            const glm::vec3 axis = glm::normalize(at(path, t) - at(path, t - 0.2F));
            const float turn = start + 2.4F * part(i, 1) + between(random_, -0.4, 0.4);
            const glm::vec3 u = across({0.3F, 1, 0.2F}, axis), v = glm::cross(axis, u);
            const float open = between(random_, 0.55, 0.95) * (1.15F - 0.45F * t);
            const glm::vec3 direction =
                std::cos(open) * axis + std::sin(open) * (std::cos(turn) * u + std::sin(turn) * v);
            grow({foot, direction, branch.length * between(random_, 0.5, 0.68) * (1.15F - 0.3F * t),
                  branch.radius * (0.62F - 0.25F * t)},
                 children.subspan(1));
        }
    }

  private:
    // Upwards again, and a little crooked.
    std::vector<glm::vec4> bent(const Branch& branch) {
        std::vector<glm::vec4> path;
        glm::vec3 p = branch.foot, direction = glm::normalize(branch.direction);
        const int steps = branch.radius > 0.02F ? 5 : 3;
        for (int i = 0; i <= steps; ++i) {
            path.emplace_back(p, branch.radius * (1 - 0.55F * part(i, steps)));
            direction =
                glm::normalize(direction + 0.16F * anyDirection(random_) + glm::vec3(0, 0.07F, 0));
            p += direction * branch.length / part(steps, 1);
        }
        return path;
    }

    static glm::vec3 at(std::span<const glm::vec4> path, float t) {
        const float place =
            std::clamp(t, 0.0F, 0.999F) * part(static_cast<int>(path.size()) - 1, 1);
        const auto i = static_cast<std::size_t>(place);
        return glm::mix(glm::vec3(path[i]), glm::vec3(path[i + 1]), place - std::floor(place));
    }

    void addLeaves(std::span<const glm::vec4> path) {
        const int count = 11;
        for (int i = 0; i < count; ++i) {
            const float t = glm::mix(0.1F, 1.0F, part(i, count - 1));
            const glm::vec3 axis = glm::normalize(at(path, t) - at(path, t - 0.2F));
            const glm::vec3 away =
                glm::normalize(axis * 0.8F + anyDirection(random_) + glm::vec3(0, -0.15F, 0));
            const float size = leaf_ * between(random_, 0.8, 1.2);
            addCard(tree_.leaves,
                    {at(path, t), size * away, glm::vec3(0, 1, 0) + 0.6F * anyDirection(random_),
                     0.8F * size, between(random_, 0.05, 0.3)});
        }
    }

    Tree& tree_;
    Random& random_;
    float leaf_;
};

} // namespace

Tree tree(float height, Random& random) {
    Tree result;
    Growth growth(result, random, 0.22F);
    constexpr std::array<int, 3> children{8, 6, 4};
    growth.grow({{0, -0.05F, 0}, {0.06F, 1, 0.02F}, 0.5F * height, 0.034F * height}, children);
    // The roots run out into the ground.
    for (int i = 0; i < 5; ++i) {
        const float turn = glm::two_pi<float>() * part(i, 5) + 0.4F;
        const glm::vec3 out(std::sin(turn), 0, std::cos(turn));
        const float r = 0.034F * height;
        result.wood.add(
            tube(std::array{glm::vec4(0.2F * r * out + glm::vec3(0, 2.2F * r, 0), 0.6F * r),
                            glm::vec4(0.8F * r * out + glm::vec3(0, 0.8F * r, 0), 0.55F * r),
                            glm::vec4(1.9F * r * out + glm::vec3(0, 0.05F * r, 0), 0.4F * r),
                            glm::vec4(3.2F * r * out + glm::vec3(0, -0.4F * r, 0), 0.2F * r)},
                 8));
    }
    return result;
}

Tree shrub(float radius, float height, float leaf, Random& random) {
    Tree result;
    Growth growth(result, random, leaf);
    constexpr std::array<int, 2> children{5, 4};
    const int stems = 5;
    for (int i = 0; i < stems; ++i) {
        const float turn = glm::two_pi<float>() * part(i, stems) + between(random, -0.3, 0.3);
        const glm::vec3 out(std::sin(turn), 0, std::cos(turn));
        const float lean = radius / height * between(random, 0.5, 0.9);
        growth.grow({0.04F * out - glm::vec3(0, 0.03F, 0), glm::vec3(0, 1, 0) + lean * out,
                     0.62F * height, 0.012F},
                    children);
    }
    return result;
}

namespace {

// Twigs that stand out from a surface.
void addTwig(Shape& leaves, glm::vec3 p, glm::vec3 normal, Random& random) {
    const glm::vec3 along =
        glm::normalize(normal + 0.9F * anyDirection(random) + glm::vec3(0, 0.3F, 0));
    const float size = between(random, 0.09, 0.15);
    addCard(leaves,
            {p - 0.07F * normal, size * along, normal + 0.8F * anyDirection(random), 0.75F * size,
             between(random, -0.1, 0.3)},
            1, 1);
}

} // namespace

Hedge hedge(glm::vec3 size, int leavesPerSquareMetre, Random& random) {
    Hedge result;
    const glm::vec3 half = size / 2.0F;
    Shape core = rounded(size - 0.12F, 0.06F, 12);
    const Noise noise("builtin/hedge");
    const auto bulge = [&](glm::vec3 p) { return 0.035F * noise.value(2.5F * p); };
    deform(core, [&](glm::vec3 p) { return p + p / half * bulge(p); });
    result.core.add(tinted(core, glm::vec3(0.5F)), at({0, half.y, 0}));
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0F, 1.0F}) {
            if (axis > 0 && side < 0)
                continue;
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            const int count = static_cast<int>(size[u] * size[v] * part(leavesPerSquareMetre, 1));
            for (int i = 0; i < count; ++i) {
                glm::vec3 p, normal(0);
                p[u] = half[u] * between(random, -1, 1);
                p[v] = half[v] * between(random, -1, 1);
                p[axis] = side * half[axis];
                normal[axis] = side;
                p += normal * (bulge(p) - 0.02F);
                addTwig(result.leaves, p + glm::vec3(0, half.y, 0), normal, random);
            }
        }
    return result;
}

Hedge topiary(float radius, Random& random) {
    Hedge result;
    Outline outline{{0, -0.86F * radius}};
    addArc(outline, {0, 0}, 0.86F * radius, -75, 75, 9);
    outline.emplace_back(0, 0.86F * radius);
    result.core = tinted(lathe(outline, 20), glm::vec3(0.5F));
    const int count = static_cast<int>(4 * glm::pi<float>() * radius * radius * 420);
    for (int i = 0; i < count; ++i) {
        const glm::vec3 normal = anyDirection(random);
        addTwig(result.leaves, radius * normal, normal, random);
    }
    return result;
}

Shape climber(glm::vec2 low, glm::vec2 high, int leavesPerSquareMetre,
              const std::function<float(glm::vec2)>& grows, Random& random) {
    Shape shape;
    const glm::vec2 size = high - low;
    const int count = static_cast<int>(size.x * size.y * part(leavesPerSquareMetre, 1));
    for (int i = 0; i < count; ++i) {
        const glm::vec2 p = low + size * glm::vec2{between(random, 0, 1), between(random, 0, 1)};
        const float thick = grows(p);
        if (thick <= 0)
            continue;
        const float leaf = between(random, 0.05, 0.095);
        const float tilt = between(random, 0.1, 0.9), turn = between(random, -0.8, 0.8);
        const glm::vec3 along(std::sin(turn), -std::cos(turn), tilt); // hangs down and outwards
        addCard(shape,
                {glm::vec3(p, between(random, 0.008, 0.02 + 0.12 * thick)),
                 leaf * glm::normalize(along), glm::vec3(between(random, -0.4, 0.4), 0.4F, 1), leaf,
                 0.15F},
                2, 1);
    }
    return shape;
}

Shape tuft(int stalks, float height, float spread, Random& random) {
    Shape shape;
    for (int i = 0; i < stalks; ++i) {
        const float turn = 2.4F * part(i, 1) + between(random, -0.3, 0.3);
        const float out = std::sqrt(part(i, stalks));
        const glm::vec3 away(std::sin(turn), 0, std::cos(turn));
        const float size = height * between(random, 0.75, 1.1);
        const glm::vec3 along = size * glm::normalize(glm::vec3(0, 1, 0) + spread * out * away);
        addCard(shape,
                {0.05F * out * away - glm::vec3(0, 0.01F, 0), along,
                 glm::vec3(0, 0.2F, 0) + (i % 2 == 0 ? away : anyDirection(random)), 0.28F * size,
                 -0.1F * spread},
                1, 3);
    }
    return shape;
}

namespace {

struct Blade {
    glm::vec3 foot, lean; // lean: of its tip, in heights
    float height, width;
    glm::vec3 colour; // linear
};

// Two triangles and a tip, or one triangle for the short ones between; its upper side is the front.
void addBlade(Shape& shape, const Blade& blade, bool bent) {
    const glm::vec3 lean = blade.lean, foot = blade.foot;
    const glm::vec3 side = 0.5F * blade.width * glm::normalize(glm::vec3(-lean.z, 0, lean.x));
    const glm::vec3 middle = foot + blade.height * (glm::vec3(0, 0.6F, 0) + 0.4F * lean);
    const glm::vec3 tip =
        foot + blade.height * (glm::vec3(0, 1 - 0.35F * glm::length(lean), 0) + lean);
    const auto first = static_cast<std::uint32_t>(shape.vertices.size());
    const auto put = [&](glm::vec3 p, glm::vec3 up, float light) {
        const glm::vec3 normal = glm::normalize(glm::cross(side, up));
        shape.vertices.push_back(
            {p, normal, {}, {p.x, p.z}, {}, glm::vec4(light * blade.colour, 1)});
    };
    put(foot - side, middle - foot, 0.65F);
    put(foot + side, middle - foot, 0.65F);
    if (bent) {
        put(middle - 0.8F * side, tip - foot, 0.85F);
        put(middle + 0.8F * side, tip - foot, 0.85F);
        shape.addTriangle(first, first + 1, first + 3);
        shape.addTriangle(first, first + 3, first + 2);
    }
    put(tip, tip - (bent ? middle : foot), 1.15F);
    const std::uint32_t last = first + (bent ? 4 : 2);
    shape.addTriangle(last - 2, last - 1, last);
}

} // namespace

Shape lawn(glm::vec2 low, glm::vec2 high, int bladesPerSquareMetre,
           const std::function<float(glm::vec2)>& grows, Random& random) {
    Shape shape;
    const glm::vec2 size = high - low;
    const int count = static_cast<int>(size.x * size.y * part(bladesPerSquareMetre, 1));
    for (int i = 0; i < count; ++i) {
        const glm::vec2 p = low + size * glm::vec2{between(random, 0, 1), between(random, 0, 1)};
        const float height = grows(p) * between(random, 0.6, 1.25);
        const float turn = between(random, 0, glm::two_pi<double>()),
                    lean = between(random, 0.1, 0.6);
        const glm::vec3 colour = glm::mix(glm::vec3(0.13F, 0.24F, 0.04F),
                                          glm::vec3(0.34F, 0.42F, 0.12F), between(random, 0, 1));
        const float width = between(random, 0.004, 0.008);
        const bool bent = i % 4 == 0;
        if (height > 0.005F)
            addBlade(shape,
                     {{p.x, -0.004F, p.y},
                      lean * glm::vec3(std::sin(turn), 0, std::cos(turn)),
                      (bent ? 1.0F : 0.9F) * height,
                      width,
                      colour},
                     bent);
    }
    return shape;
}

} // namespace obscura::builtin
