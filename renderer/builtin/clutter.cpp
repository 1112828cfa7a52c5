#include "renderer/builtin/clutter.h"

#include "renderer/builtin/noise.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace obscura::builtin {

namespace {

glm::vec3 clothColour(Random& random) {
    constexpr std::array<glm::vec3, 12> colours{
        glm::vec3(0.45F, 0.16F, 0.14F), {0.16F, 0.25F, 0.38F}, {0.22F, 0.33F, 0.26F},
        {0.78F, 0.70F, 0.55F},          {0.68F, 0.47F, 0.20F}, {0.30F, 0.22F, 0.19F},
        {0.55F, 0.58F, 0.56F},          {0.86F, 0.83F, 0.76F}, {0.20F, 0.20F, 0.22F},
        {0.62F, 0.33F, 0.22F},          {0.35F, 0.46F, 0.52F}, {0.50F, 0.42F, 0.32F}};
    const glm::vec3 colour = colours[random.below(colours.size())];
    return colour * between(random, 0.85, 1.12);
}

// Upright, its spine at z = 0, its lower left corner at the origin. `size`: thickness, height,
// depth.
Shape book(glm::vec3 size, glm::vec3 colour) {
    const float board = 0.0028F;
    Shape cover;
    for (const float x : {board / 2, size.x - board / 2})
        cover.add(box({board, size.y, size.z - 0.001F}, 0), at({x, size.y / 2, -size.z / 2}));
    cover.add(patch(
        [&](glm::vec2 uv) {
            const float across = 2 * uv.x - 1;
            return glm::vec3(size.x * uv.x, size.y * uv.y,
                             -0.001F - 0.12F * size.x * across * across);
        },
        4, 1, {size.x, size.y}));
    Shape shape = tinted(cover, colour);
    shape.add(tinted(box({size.x - 1.6F * board, size.y - 0.008F, size.z - 0.008F}, 0),
                     {0.88F, 0.84F, 0.74F}),
              at({size.x / 2, size.y / 2, -0.002F - size.z / 2}));
    return shape;
}

glm::vec3 bookSize(Random& random, float height, float depth) {
    const float format = between(random, 0.62, 1.0);
    const float thick = between(random, 0.014, 0.044), deep = between(random, 0.88, 1.0);
    return {thick, height * format, depth * (0.3F + 0.7F * format) * deep};
}

} // namespace

Shape bookRow(float length, float height, float depth, Random& random) {
    Shape shape;
    float x = 0;
    while (true) {
        const glm::vec3 size = bookSize(random, height, depth);
        const glm::vec3 colour = clothColour(random);
        const float back = between(random, 0, 0.012);
        const float lean = size.y * 0.21F + size.x;
        if (x + size.x + lean > length) {
            shape.add(book(size, colour), rolled(at({x + 0.2F * size.y, 0, -back}), 11.6F));
            return shape;
        }
        shape.add(book(size, colour), at({x, 0, -back}));
        x += size.x + between(random, 0.0004, 0.0018);
    }
}

Shape bookStack(int count, Random& random) {
    Shape shape;
    float y = 0;
    for (int i = 0; i < count; ++i) {
        glm::vec3 size = bookSize(random, 0.27F, 0.2F);
        size.y = std::max(size.y, 0.2F - 0.01F * part(i, 1));
        Shape lying;
        lying.add(book(size, clothColour(random)), rolled(at({size.y / 2, 0, size.z / 2}), 90));
        const float aside = between(random, -0.01, 0.01), turn = between(random, -9, 9);
        shape.add(lying, at({aside, y, 0}, turn));
        y += size.x + 0.0005F;
    }
    return shape;
}

Shape openBook() {
    Shape pages;
    for (const float side : {-1.0F, 1.0F}) {
        Shape half = patch(
            [](glm::vec2 uv) { // from the fold outwards
                const float x = 0.15F * uv.x;
                const float y = 0.006F + 0.018F *
                                             std::sin(glm::pi<float>() * std::sqrt(uv.x + 0.01F)) *
                                             (1 - 0.6F * uv.x);
                return glm::vec3(x, y, 0.11F - 0.22F * uv.y);
            },
            10, 1, {0.15F, 0.22F});
        const std::array<glm::vec3, 4> foot{glm::vec3(0, 0.004F, 0.11F),
                                            {0.15F, 0.004F, 0.11F},
                                            {0.15F, 0.004F, -0.11F},
                                            {0, 0.004F, -0.11F}};
        for (std::size_t i = 0; i < 3; ++i) // the edges of the pages
            half.add(patch(
                [&](glm::vec2 uv) {
                    glm::vec3 p = glm::mix(foot[i], foot[i + 1], uv.x);
                    const float u = p.x / 0.15F;
                    const float top =
                        0.006F +
                        0.018F * (1 - 0.6F * u) * std::sin(glm::pi<float>() * std::sqrt(u + 0.01F));
                    p.y = glm::mix(p.y, top, uv.y);
                    return p;
                },
                10, 1, {0.15F, 0.02F}));
        glm::mat4 mirror(1);
        mirror[0][0] = side;
        pages.add(half, mirror);
    }
    Shape shape = tinted(pages, {0.90F, 0.87F, 0.79F});
    shape.add(tinted(box({0.315F, 0.004F, 0.23F}, 0), {0.35F, 0.14F, 0.13F}), at({0, 0.0025F, 0}));
    return shape;
}

Shape bowl(float radius, float height) {
    const float thick = 0.006F, foot = 0.4F * radius;
    Outline outline{{0, 0.004F}, {foot - 0.008F, 0.004F}, {foot - 0.006F, 0}, {foot, 0}};
    for (int i = 0; i <= 10; ++i) {
        const float t = part(i, 10);
        outline.push_back({glm::mix(foot, radius, std::sin(1.45F * t) / std::sin(1.45F)),
                           0.012F + (height - 0.012F) * t * t});
    }
    addArc(outline, {radius - thick / 2, height}, thick / 2, 20, 160, 4);
    for (int i = 10; i >= 0; --i) {
        const float t = part(i, 10);
        outline.push_back(
            {glm::mix(foot - 0.01F, radius - thick, std::sin(1.45F * t) / std::sin(1.45F)),
             0.02F + (height - 0.022F) * t * t});
    }
    outline.push_back({0, 0.02F});
    return lathe(outline, 28);
}

Shape fruit(float bowlRadius, Random& random) {
    Shape shape;
    const auto piece = [&](glm::vec3 place, float radius) {
        Outline outline;
        for (int i = 0; i <= 12; ++i) { // an apple: hollow at both ends
            const float angle = glm::pi<float>() * (part(i, 12) - 0.5F);
            const float dent = 0.22F * std::pow(std::abs(std::sin(angle)), 8.0F);
            outline.push_back(radius * glm::vec2(i % 12 == 0 ? 0 : std::cos(angle),
                                                 std::sin(angle) * (1 - dent) * 0.95F));
        }
        const bool green = random.below(3) == 0;
        const glm::vec3 colour = green ? glm::vec3(0.55F, 0.62F, 0.22F)
                                       : glm::vec3(0.72F, between(random, 0.18, 0.34), 0.14F);
        Shape apple = tinted(lathe(outline, 18), colour);
        apple.add(
            tinted(rod({0, 0.7F * radius, 0, 0.0018F}, {0.006F, 1.1F * radius, 0, 0.0022F}, 5),
                   {0.25F, 0.17F, 0.10F}));
        const float turn = between(random, 0, 360), tilt = between(random, -30, 30);
        shape.add(apple, pitched(at(place, turn), tilt));
    };
    const float size = 0.30F * bowlRadius, ring = 0.46F * bowlRadius;
    for (int i = 0; i < 5; ++i) {
        const float angle = glm::two_pi<float>() * part(i, 5);
        piece({ring * std::sin(angle), 0.03F + size, ring * std::cos(angle)},
              size * between(random, 0.88, 0.95));
    }
    piece({0, 0.035F + 1.9F * size, 0}, size);
    return shape;
}

Shape mug() {
    Outline outline{{0, 0.003F}, {0.034F, 0.003F}, {0.036F, 0}, {0.039F, 0.004F}, {0.041F, 0.092F}};
    addArc(outline, {0.0395F, 0.093F}, 0.0015F, 0, 180, 4);
    outline.insert(outline.end(), {{0.036F, 0.008F}, {0, 0.008F}});
    Shape shape = lathe(outline, 28);
    std::vector<glm::vec4> path;
    for (int i = 0; i <= 12; ++i) {
        const float angle = glm::radians(glm::mix(-88.0F, 88.0F, part(i, 12)));
        path.emplace_back(0.038F + 0.027F * std::cos(angle), 0.048F + 0.03F * std::sin(angle), 0,
                          0.0048F);
    }
    shape.add(tube(path, 8));
    return shape;
}

Shape plate(float radius) {
    Shape shape = lathe({{0, 0.002F},
                         {0.55F * radius, 0.002F},
                         {0.57F * radius, 0},
                         {0.60F * radius, 0.002F},
                         {0.97F * radius, 0.017F},
                         {radius, 0.0185F},
                         {0.97F * radius, 0.0205F},
                         {0.62F * radius, 0.008F},
                         {0.5F * radius, 0.006F},
                         {0, 0.006F}},
                        40);
    projectUv(shape); // a lathe's texture shrinks to a star in the middle
    return shape;
}

Shape vase(float height) {
    Outline outline{{0, 0}, {0.16F, 0}, {0.18F, 0.01F}};
    for (int i = 1; i <= 18; ++i) {
        const float t = part(i, 18);
        outline.push_back(
            {0.18F + 0.16F * std::sin(glm::pi<float>() * std::pow(t, 0.8F)) * (1 - 0.3F * t) -
                 0.08F * ramp(0.55F, 1, t),
             0.01F + 0.95F * t});
    }
    outline.insert(outline.end(), {{0.12F, 0.99F},
                                   {0.115F, 1.0F},
                                   {0.1F, 0.99F},
                                   {0.085F, 0.94F},
                                   {0.15F, 0.6F},
                                   {0.12F, 0.1F},
                                   {0, 0.08F}});
    for (glm::vec2& point : outline)
        point *= height;
    return lathe(outline, 32);
}

Shape twigs(int count, float length, Random& random) {
    Shape shape;
    for (int i = 0; i < count; ++i) {
        const float turn =
            glm::two_pi<float>() * (0.618F * part(i, 1)) + between(random, -0.3, 0.3);
        const float lean = between(random, 0.12, 0.42),
                    reach = length * between(random, 0.75, 1.05);
        const glm::vec3 out(std::sin(turn), 0, std::cos(turn));
        std::vector<glm::vec4> path;
        for (int k = 0; k <= 6; ++k) {
            const float t = part(k, 6);
            const glm::vec3 crook =
                0.014F * glm::vec3{between(random, -1, 1), 0, between(random, -1, 1)};
            path.emplace_back(reach * (out * lean * t * (0.5F + 0.5F * t) + glm::vec3(0, t, 0)) +
                                  (t > 0 ? crook : glm::vec3(0)) - glm::vec3(0, 0.12F * (1 - t), 0),
                              0.0032F * (1 - 0.6F * t));
        }
        shape.add(tinted(tube(path, 5), {0.30F, 0.21F, 0.14F}));
        for (int k = 2; k <= 6; ++k) // buds
            for (int side = 0; side < 2; ++side) {
                const glm::vec3 p(path[static_cast<std::size_t>(k)]);
                const glm::vec3 away{between(random, -1, 1), 0.7F, between(random, -1, 1)};
                const glm::vec3 tip = p + 0.03F * glm::normalize(away);
                shape.add(tinted(tube(std::array{glm::vec4(p, 0.0012F),
                                                 glm::vec4(glm::mix(p, tip, 0.55F), 0.0075F),
                                                 glm::vec4(tip, 0.001F)},
                                      6),
                                 {0.86F, 0.82F, 0.76F}));
            }
    }
    return shape;
}

Shape candlestick(float height) {
    const glm::vec3 brass(0.66F, 0.51F, 0.26F);
    Outline foot{{0, 0},           {0.048F, 0},      {0.05F, 0.004F},
                 {0.045F, 0.010F}, {0.014F, 0.018F}, {0.007F, 0.03F}};
    foot.insert(foot.end(), {{0.006F, 0.55F * height},
                             {0.013F, 0.58F * height},
                             {0.022F, 0.6F * height},
                             {0.022F, 0.61F * height},
                             {0.0125F, 0.61F * height},
                             {0, 0.61F * height}});
    Shape shape = tinted(lathe(foot, 24), brass);
    Outline wax{{0, 0.6F * height},
                {0.0105F, 0.6F * height},
                {0.01F, 0.985F * height},
                {0.008F, height},
                {0, 0.995F * height}};
    shape.add(tinted(lathe(wax, 16), {0.90F, 0.87F, 0.80F}));
    shape.add(tinted(rod({0, 0.99F * height, 0, 0.0009F}, {0.002F, height + 0.009F, 0, 0.0007F}, 5),
                     {0.12F, 0.11F, 0.10F}));
    return shape;
}

Shape basket(float radius, float height) {
    const auto wall = [=](float t) { return radius * (0.80F + 0.20F * std::sqrt(t)); };
    Outline outline{{0, 0}, {wall(0), 0}};
    const int courses = 11;
    for (int i = 0; i < courses; ++i) // each a round strand
        addArc(outline,
               {wall(part(i, courses)), height * (part(i, courses) + part(1, 2 * courses))},
               0.46F * height / part(courses, 1), -80, 80, 3);
    addArc(outline, {radius - 0.004F, height}, 0.011F, 0, 180, 6);
    outline.insert(
        outline.end(),
        {{0.95F * radius - 0.012F, 0.7F * height}, {wall(0) - 0.012F, 0.012F}, {0, 0.012F}});
    Shape shape = lathe(outline, 26);
    for (const float side : {-1.0F, 1.0F}) {
        std::vector<glm::vec4> path;
        for (int i = 0; i <= 12; ++i) {
            const float angle = glm::pi<float>() * part(i, 12);
            path.emplace_back(-0.07F * std::cos(angle), height + 0.075F * std::sin(angle) - 0.01F,
                              side * radius, 0.009F);
        }
        shape.add(tube(path, 8));
    }
    return shape;
}

Shape pillow(glm::vec2 size, float thickness) {
    const Noise noise("builtin/pillow");
    Shape shape;
    for (const float side : {1.0F, -1.0F}) {
        const auto surface = [&](glm::vec2 uv) {
            const float a = side * (2 * uv.x - 1), b = 2 * uv.y - 1;
            const float pull = 0.10F; // the seams are drawn in between the corners
            const float x = a * (1 - pull * a * a * (1 - b * b)),
                        y = b * (1 - pull * b * b * (1 - a * a));
            const float rim = (1 - a * a) * (1 - b * b);
            const float crease =
                0.05F * noise.value(glm::vec3(3 * a, 3 * b, 5 + side)) * std::min(1.0F, 4 * rim);
            return glm::vec3(size.x * x / 2, size.y * (y + 1) / 2,
                             side * thickness / 2 * (std::pow(rim, 0.45F) + crease));
        };
        shape.add(patch(surface, 14, 14, size));
    }
    return shape;
}

Shape throwOver(float across, float width, float leftDrop, float rightDrop) {
    const float round = 0.05F, off = 0.008F;
    const float flat = across / 2 - round, quarter = (round + off) * glm::half_pi<float>();
    const auto profile = [=](float s) { // metres along the cloth from the middle
        const float side = s < 0 ? -1.0F : 1.0F, d = std::abs(s);
        if (d < flat)
            return glm::vec2(s, off);
        const float angle = std::min(1.0F, (d - flat) / quarter) * glm::half_pi<float>();
        const float hang = std::max(0.0F, d - flat - quarter);
        return glm::vec2(side * (flat + (round + off) * std::sin(angle) + 0.03F * hang),
                         (round + off) * std::cos(angle) - round - hang);
    };
    const Noise noise("builtin/throw");
    const auto surface = [&](glm::vec2 uv) {
        const float total = flat + quarter;
        const float s = glm::mix(-total - leftDrop, total + rightDrop, uv.x);
        const glm::vec2 p = profile(s);
        const float hang = std::max(0.0F, std::abs(s) - total);
        const float fold =
            0.5F + 0.5F * std::sin(30 * uv.y + 2 * noise.value(glm::vec3(2 * s, 6 * uv.y, 0)));
        const float out = (s < 0 ? -1.0F : 1.0F) * 0.035F * fold * std::min(1.0F, 5 * hang);
        return glm::vec3(p.x + out, p.y + 0.006F * fold * (hang > 0 ? 0.0F : 1.0F),
                         width * (0.5F - uv.y) * (1 + 0.05F * hang));
    };
    return patch(surface, 48, 32, {leftDrop + rightDrop + across, width});
}

Rug rug(glm::vec2 size) {
    Rug result;
    result.pile = rounded({size.x, 0.016F, size.y}, 0.005F, 18, 1);
    const Noise noise("builtin/rug");
    deform(result.pile, [&](glm::vec3 p) { // lies not quite flat
        const float wave = noise.value(glm::vec3(2.2F * p.x, 3, 2.2F * p.z));
        return p + glm::vec3(0, p.y > 0 ? 0.004F * (wave + 1) : 0.0F, 0);
    });
    for (Vertex& vertex : result.pile.vertices)
        vertex.uv = {vertex.position.x / size.x + 0.5F, vertex.position.z / size.y + 0.5F};
    Random random(0, "builtin/fringe");
    const int knots = static_cast<int>(size.y / 0.022F);
    for (const float side : {-1.0F, 1.0F})
        for (int i = 0; i < knots; ++i) {
            const float z = size.y * (part(2 * i + 1, 2 * knots) - 0.5F);
            const float end = z + between(random, -0.016, 0.016),
                        reach = between(random, 0.05, 0.07);
            const float x = side * (size.x / 2 - 0.004F);
            result.fringe.add(
                tube(std::array{glm::vec4(x, 0.002F, z, 0.003F),
                                glm::vec4(x + side * 0.4F * reach, -0.003F, (z + end) / 2, 0.004F),
                                glm::vec4(x + side * reach, -0.005F, end, 0.0025F)},
                     5));
        }
    return result;
}

Picture picture(glm::vec2 size) {
    const float bar = 0.035F;
    Picture result;
    const Outline profile{{-bar, 0},         {-bar, 0.010F},    {-bar + 0.006F, 0.014F},
                          {-0.010F, 0.022F}, {-0.004F, 0.020F}, {0, 0.014F},
                          {0, -0.012F}};
    const glm::mat4 upright = pitched(glm::mat4(1), 90);
    Outline turned = profile;
    std::reverse(turned.begin(), turned.end());
    result.frame.add(pillar(turned, size + 2 * bar), upright);
    result.canvas =
        patch([=](glm::vec2 uv) { return glm::vec3(size * (uv - 0.5F), 0.001F); }, 1, 1, {1, 1});
    for (Vertex& vertex : result.canvas.vertices)
        vertex.uv.y = 1 - vertex.uv.y;
    return result;
}

} // namespace obscura::builtin
