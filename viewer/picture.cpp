#include "viewer/picture.h"

#include "gl/target.h"
#include "protocols/reader/manifest.h"

#include <algorithm>
#include <cmath>

namespace obscura {

const std::array<std::string, 7>& showNames() {
    static const std::array<std::string, 7> names{"lit",   "occlusion", "albedo", "normals",
                                                  "depth", "error",     "jod"};
    return names;
}

namespace {

// A recipe's JSON is a canonical text of all that a view and a level are.
std::string textOf(const Wanted& wanted) {
    Recipe recipe;
    recipe.view = wanted.view;
    recipe.level = wanted.level;
    return recipe.json();
}

bool same(const Settings& one, const Settings& other) {
    return &one.technique() == &other.technique() && one.values() == other.values();
}

} // namespace

bool Wanted::operator==(const Wanted& other) const {
    return scene == other.scene && normals == other.normals && textures == other.textures &&
           width == other.width && height == other.height && show == other.show &&
           reference == other.reference && integral == other.integral && display == other.display &&
           difference == other.difference && errorScale == other.errorScale &&
           std::equal(panes.begin(), panes.end(), other.panes.begin(), other.panes.end(), same) &&
           textOf(*this) == textOf(other);
}

Image8 imageOf(const SharedPicture& picture) {
    const std::vector<std::byte> bytes =
        picture.pixels.empty()
            ? gl::readBytes(picture.texture, picture.width, picture.height, gl::Format::rgba8)
            : picture.pixels;
    Image8 image{picture.width, picture.height, 3, {}};
    for (int y = picture.height - 1; y >= 0; --y)
        for (int x = 0; x < picture.width; ++x)
            for (int c = 0; c < 3; ++c)
                image.pixels.push_back(std::to_integer<std::uint8_t>(
                    bytes[static_cast<std::size_t>((y * picture.width + x) * 4 + c)]));
    return image;
}

namespace {

using Colour = std::array<std::uint8_t, 3>;

// Lightness, and towards red and yellow (Ottosson 2020, "A perceptual color space for image
// processing"): equal distances look alike.
struct Oklab {
    double lightness, red, yellow;
};

Oklab mix(const Oklab& a, const Oklab& b, double share) {
    return {std::lerp(a.lightness, b.lightness, share), std::lerp(a.red, b.red, share),
            std::lerp(a.yellow, b.yellow, share)};
}

Colour colourOf(const Oklab& lab) {
    const double l = std::pow(lab.lightness + 0.3963377774 * lab.red + 0.2158037573 * lab.yellow,
                              3),
                 m = std::pow(lab.lightness - 0.1055613458 * lab.red - 0.0638541728 * lab.yellow,
                              3),
                 s = std::pow(lab.lightness - 0.0894841775 * lab.red - 1.2914855480 * lab.yellow,
                              3);
    const Image8 shown = displayed(
        Image{1,
              1,
              3,
              {static_cast<float>(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
               static_cast<float>(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
               static_cast<float>(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)}});
    return {shown.pixels[0], shown.pixels[1], shown.pixels[2]};
}

// Through these colours, which are equally far apart.
std::vector<Colour> through(std::span<const Oklab> stops, int size) {
    std::vector<Colour> colours;
    for (int i = 0; i < size; ++i) {
        const double at =
            static_cast<double>(i) / std::max(size - 1, 1) * static_cast<double>(stops.size() - 1);
        const auto first = std::min(static_cast<std::size_t>(at), stops.size() - 2);
        colours.push_back(
            colourOf(mix(stops[first], stops[first + 1], at - static_cast<double>(first))));
    }
    return colours;
}

} // namespace

std::vector<Colour> errorColours(int size) {
    constexpr std::array<Oklab, 3> stops{
        {{0.50, 0.165, 0.09}, {0.96, 0.0, 0.0}, {0.46, -0.03, -0.17}}};
    return through(stops, size);
}

std::vector<Colour> jodColours(int size) {
    constexpr std::array<Oklab, 4> stops{
        {{0.10, 0.0, 0.0}, {0.38, 0.10, -0.10}, {0.66, 0.14, 0.07}, {0.95, -0.02, 0.12}}};
    return through(stops, size);
}

std::vector<Colour> depthColours(int size) {
    constexpr std::array<Oklab, 4> stops{
        {{0.95, -0.02, 0.08}, {0.72, -0.08, 0.03}, {0.46, -0.05, -0.08}, {0.20, 0.02, -0.09}}};
    return through(stops, size);
}

} // namespace obscura
