#include "renderer/frame/panorama.h"

#include "base/parallel.h"
#include "renderer/frame/vec3.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace obscura {

namespace {

using std::numbers::pi;

// Real spherical harmonics, orders 0 to 2, in the order of shaders/light.frag.
std::array<double, 9> basis(const glm::dvec3& d) {
    return {0.282095,
            0.488603 * d.y,
            0.488603 * d.z,
            0.488603 * d.x,
            1.092548 * d.x * d.y,
            1.092548 * d.y * d.z,
            0.315392 * (3 * d.z * d.z - 1),
            1.092548 * d.x * d.z,
            0.546274 * (d.x * d.x - d.y * d.y)};
}

} // namespace

glm::dvec3 panoramaDirection(double u, double v) {
    const double longitude = (u - 0.5) * 2 * pi, colatitude = v * pi;
    return {std::sin(colatitude) * std::sin(longitude), std::cos(colatitude),
            -std::sin(colatitude) * std::cos(longitude)};
}

Image skyPanorama(const Sky& sky) {
    Image image{256, 128, 3, std::vector<float>(256 * 128 * 3)};
    for (int y = 0; y < image.height; ++y) {
        const double elevation = 90 - 180 * (y + 0.5) / image.height; // degrees
        // Haze: the horizon's colour fades upwards within some thirty degrees, into the ground
        // within a few.
        const double up = 1 - std::exp(-std::max(elevation, 0.0) / 20);
        const double down = std::clamp(-elevation / 4, 0.0, 1.0);
        const glm::dvec3 colour = glm::mix(glm::mix(vec(sky.horizon), vec(sky.zenith), up),
                                           vec(sky.ground), down * down * (3 - 2 * down));
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c)
                image.at(x, y, c) = static_cast<float>(colour[c]);
    }
    return image;
}

Irradiance irradianceOf(const Image& panorama) {
    std::array<glm::dvec3, 9> sums{};
    for (int y = 0; y < panorama.height; ++y) {
        const double v = (y + 0.5) / panorama.height;
        const double area = 2 * pi * pi * std::sin(v * pi) /
                            (static_cast<double>(panorama.width) * panorama.height);
        for (int x = 0; x < panorama.width; ++x) {
            const auto value = basis(panoramaDirection((x + 0.5) / panorama.width, v));
            const glm::dvec3 radiance(panorama.at(x, y, 0), panorama.at(x, y, 1),
                                      panorama.at(x, y, 2));
            for (std::size_t i = 0; i < 9; ++i)
                sums[i] += radiance * (value[i] * area);
        }
    }
    // Ramamoorthi and Hanrahan 2001, equation 9: the cosine lobe's own coefficients.
    const double lobe[3] = {pi, 2 * pi / 3, pi / 4};
    Irradiance result;
    for (std::size_t i = 0; i < 9; ++i)
        for (int c = 0; c < 3; ++c)
            result[i][static_cast<std::size_t>(c)] =
                static_cast<float>(sums[i][c] * lobe[i == 0  ? 0
                                                     : i < 4 ? 1
                                                             : 2]);
    return result;
}

namespace {

// Wider panoramas are not needed for what is reflected: 0.35 degrees a pixel.
constexpr int widestSharp = 1024;
// As wide is the panorama that the roughest surfaces reflect.
constexpr int narrowest = 32;
constexpr int lobeSamples = 128;

// Half the size. Each pixel is the mean of four, by the area that they have on the sphere.
Image halved(const Image& from) {
    Image to{std::max(from.width / 2, 1), std::max(from.height / 2, 1), 3, {}};
    const auto area = [&](int y) { return std::sin((y + 0.5) * pi / from.height); };
    for (int y = 0; y < to.height; ++y) {
        const int y0 = std::min(2 * y, from.height - 1), y1 = std::min(2 * y + 1, from.height - 1);
        const auto share = static_cast<float>(area(y1) / (area(y0) + area(y1)));
        for (int x = 0; x < to.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const int x0 = std::min(2 * x, from.width - 1),
                          x1 = std::min(2 * x + 1, from.width - 1);
                to.pixels.push_back(0.5f *
                                    ((1 - share) * (from.at(x0, y0, c) + from.at(x1, y0, c)) +
                                     share * (from.at(x0, y1, c) + from.at(x1, y1, c))));
            }
    }
    return to;
}

// One direction of a lobe around +z.
struct LobeSample {
    glm::dvec3 direction;
    double weight;   // cosine, for the mean
    std::size_t mip; // of the source: where a pixel is about as large as the sample's solid angle
};

double radicalInverse(unsigned bits) {
    bits = (bits << 16) | (bits >> 16);
    bits = ((bits & 0x55555555u) << 1) | ((bits & 0xAAAAAAAAu) >> 1);
    bits = ((bits & 0x33333333u) << 2) | ((bits & 0xCCCCCCCCu) >> 2);
    bits = ((bits & 0x0F0F0F0Fu) << 4) | ((bits & 0xF0F0F0F0u) >> 4);
    bits = ((bits & 0x00FF00FFu) << 8) | ((bits & 0xFF00FF00u) >> 8);
    return bits * 0x1p-32;
}

// Half vectors in proportion to GGX, seen along the normal (Karis 2013); what each sample stands
// for is read from smaller sources, so that few samples make no spots (Krivanek and Colbert 2008).
std::vector<LobeSample> lobe(double roughness, double sourcePixels, std::size_t mips) {
    const double a2 = std::pow(roughness, 4);
    std::vector<LobeSample> result;
    for (unsigned i = 0; i < lobeSamples; ++i) {
        const double x = (i + 0.5) / lobeSamples, turn = 2 * pi * radicalInverse(i);
        const double cosine2 = (1 - x) / (1 + (a2 - 1) * x);
        const double sine = std::sqrt(1 - cosine2), cosine = std::sqrt(cosine2);
        const double up = 2 * cosine2 - 1; // of the direction reflected there
        if (up <= 0)
            continue;
        const double spread = cosine2 * (a2 - 1) + 1,
                     density = a2 / (pi * spread * spread) / 4; // of directions
        const double pixels = sourcePixels / (4 * pi * density * lobeSamples);
        const double mip =
            std::clamp(0.5 * std::log2(std::max(pixels, 1.0)), 0.0, static_cast<double>(mips - 1));
        result.push_back(
            {{2 * cosine * sine * std::cos(turn), 2 * cosine * sine * std::sin(turn), up},
             up,
             static_cast<std::size_t>(mip)});
    }
    return result;
}

// The same row of a source for all pixels of a row: filtered downwards once, then read along it.
struct RowSample {
    const Image* source;
    int above, below;
    float fall, across; // share of the row below; columns from the pixel to the sample, of 1
    float weight;
};

std::vector<RowSample> along(const std::vector<LobeSample>& samples,
                             const std::vector<Image>& sources, double v) {
    const glm::dvec3 normal = panoramaDirection(0.5, v), east(1, 0, 0),
                     north = glm::cross(normal, east);
    std::vector<RowSample> result;
    for (const LobeSample& sample : samples) {
        const glm::dvec3 d =
            east * sample.direction.x + north * sample.direction.y + normal * sample.direction.z;
        const Image& source = sources[sample.mip];
        const double row =
            std::clamp(std::acos(std::clamp(d.y, -1.0, 1.0)) / pi * source.height - 0.5, 0.0,
                       source.height - 1.0);
        const int above = static_cast<int>(row);
        result.push_back({&source, above, std::min(above + 1, source.height - 1),
                          static_cast<float>(row - above),
                          static_cast<float>(std::atan2(d.x, -d.z) / (2 * pi)),
                          static_cast<float>(sample.weight)});
    }
    return result;
}

glm::vec3 read(const RowSample& sample, float u) {
    const Image& source = *sample.source;
    const float column = (u + sample.across) * static_cast<float>(source.width) - 0.5f,
                left = std::floor(column), share = column - left;
    const auto wrapped = [&](int x) { return (x % source.width + source.width) % source.width; };
    const int x0 = wrapped(static_cast<int>(left)), x1 = wrapped(static_cast<int>(left) + 1);
    glm::vec3 sum;
    for (int c = 0; c < 3; ++c)
        sum[c] = (1 - sample.fall) * ((1 - share) * source.at(x0, sample.above, c) +
                                      share * source.at(x1, sample.above, c)) +
                 sample.fall * ((1 - share) * source.at(x0, sample.below, c) +
                                share * source.at(x1, sample.below, c));
    return sum;
}

Image reflected(const std::vector<Image>& sources, int width, int height, double roughness) {
    const Image& source = sources.front();
    const std::vector<LobeSample> samples =
        lobe(roughness, static_cast<double>(source.width) * source.height, sources.size());
    Image to{width, height, 3, std::vector<float>(static_cast<std::size_t>(width * height * 3))};
    forEachInParallel(static_cast<std::size_t>(height), [&](std::size_t row) {
        const int y = static_cast<int>(row);
        const std::vector<RowSample> here = along(samples, sources, (y + 0.5) / height);
        for (int x = 0; x < width; ++x) {
            glm::vec3 sum(0);
            float weights = 0;
            for (const RowSample& sample : here) {
                sum += sample.weight *
                       read(sample, (static_cast<float>(x) + 0.5f) / static_cast<float>(width));
                weights += sample.weight;
            }
            for (int c = 0; c < 3; ++c)
                to.at(x, y, c) = sum[c] / weights;
        }
    });
    return to;
}

constexpr int tableSize = 32, tableSamples = 256;

// Scale and offset (Karis 2013), with lights by GGX's density of half vectors.
glm::dvec2 reflectance(double roughness, double cosine) {
    const double a2 = std::pow(roughness, 4);
    const auto lambda = [&](double c) { return std::sqrt(a2 + (1 - a2) * c * c); };
    const glm::dvec3 eye(std::sqrt(1 - cosine * cosine), 0, cosine);
    glm::dvec2 sum(0);
    for (unsigned i = 0; i < tableSamples; ++i) {
        const double x = (i + 0.5) / tableSamples, turn = 2 * pi * radicalInverse(i);
        const double up = std::sqrt((1 - x) / (1 + (a2 - 1) * x)), out = std::sqrt(1 - up * up);
        const double toHalf = eye.x * out * std::cos(turn) + eye.z * up,
                     light = 2 * toHalf * up - cosine;
        if (light <= 0 || toHalf <= 0)
            continue;
        const double masking =
                         2 * light * cosine / (light * lambda(cosine) + cosine * lambda(light)),
                     share = masking * toHalf / (up * cosine), fresnel = std::pow(1 - toHalf, 5);
        sum += glm::dvec2(1 - fresnel, fresnel) * share;
    }
    return sum / static_cast<double>(tableSamples);
}

Image makeReflectanceTable() {
    Image table{tableSize, tableSize, 3, std::vector<float>(tableSize * tableSize * 3)};
    forEachInParallel(tableSize, [&](int y) {
        for (int x = 0; x < tableSize; ++x) {
            const glm::dvec2 both = reflectance(std::max(y / (tableSize - 1.0), 0.01),
                                                std::max(x / (tableSize - 1.0), 1e-3));
            table.at(x, y, 0) = static_cast<float>(both.x);
            table.at(x, y, 1) = static_cast<float>(both.y);
        }
    });
    return table;
}

} // namespace

const Image& reflectanceTable() {
    static const Image table = makeReflectanceTable();
    return table;
}

Reflections reflectionsOf(const Image& panorama) {
    Reflections result;
    result.levels.push_back(panorama);
    while (result.levels.back().width > widestSharp)
        result.levels.push_back(halved(result.levels.back()));
    result.sharp = static_cast<int>(result.levels.size()) - 1;
    std::vector<Image> sources{result.levels.back()};
    while (sources.back().width > 2 && sources.back().height > 2)
        sources.push_back(halved(sources.back()));
    std::size_t rough = 1; // so many levels beyond the sharp one
    while (sources.front().width >> rough > narrowest)
        ++rough;
    rough = std::min(rough, sources.size() - 1);
    for (std::size_t k = 1; k <= rough; ++k)
        result.levels.push_back(reflected(sources, sources[k].width, sources[k].height,
                                          static_cast<double>(k) / static_cast<double>(rough)));
    return result;
}

} // namespace obscura
