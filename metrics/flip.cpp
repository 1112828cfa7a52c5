#include "metrics/flip.h"

#include "base/parallel.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace obscura {

namespace {

constexpr double pi = std::numbers::pi;

// Colours are XYZ relative to the white of sRGB, so that greys have three equal components.
const glm::mat3& xyzFromRgb() {
    static const glm::mat3 matrix{
        glm::transpose(glm::dmat3(glm::dvec3(10135552, 8788810, 4435075) / 23359437.0,
                                  glm::dvec3(2613072, 8788810, 887015) / 12288897.0,
                                  glm::dvec3(1425312, 8788810, 70074185) / 80288307.0))};
    return matrix;
}

// CIE L*a*b* with chroma weighted by lightness (Hunt's effect).
glm::vec3 huntLab(const glm::vec3& xyz) {
    constexpr float delta = 6 / 29.0F;
    const auto f = [](float t) {
        return t > delta * delta * delta ? std::pow(t, 1 / 3.0F)
                                         : t / (3 * delta * delta) + 4 / 29.0F;
    };
    const float x = f(xyz.x), y = f(xyz.y), z = f(xyz.z), lightness = 116 * y - 16;
    return {lightness, 0.01F * lightness * 500 * (x - y), 0.01F * lightness * 200 * (y - z)};
}

// The HyAB distance (Abasi, Amani Tehran and Fairchild 2020), compressed.
float distance(const glm::vec3& first, const glm::vec3& second) {
    const glm::vec3 d = first - second;
    return std::pow(std::abs(d.x) + std::hypot(d.y, d.z), 0.7F);
}

// Weights of an odd number of pixels; the middle one belongs to the pixel itself.
using Kernel = std::vector<float>;

template <typename Function>
Kernel kernel(int reach, Function value) {
    Kernel result;
    for (int i = -reach; i <= reach; ++i)
        result.push_back(static_cast<float>(value(static_cast<double>(i))));
    return result;
}

// a sqrt(pi / b) exp(-pi^2 d^2 / b), at d degrees of visual angle.
struct Gaussian {
    double a = 0, b = 0;
};

// A contrast sensitivity filter of unit sum: the sum of each kernel's product with itself
// across and down.
std::vector<Kernel> sensitivity(const std::vector<Gaussian>& terms, double pixelsPerDegree) {
    constexpr double widest = 0.04;
    const int reach =
        static_cast<int>(std::ceil(3 * std::sqrt(widest / (2 * pi * pi)) * pixelsPerDegree));
    std::vector<Kernel> result;
    float total = 0;
    for (const Gaussian& term : terms) {
        result.push_back(kernel(reach, [&](double x) {
            const double degrees = x / pixelsPerDegree;
            return std::sqrt(term.a * std::sqrt(pi / term.b)) *
                   std::exp(-pi * pi * degrees * degrees / term.b);
        }));
        const float sum = std::accumulate(result.back().begin(), result.back().end(), 0.0F);
        total += sum * sum;
    }
    for (Kernel& kernel : result)
        for (float& weight : kernel)
            weight /= std::sqrt(total);
    return result;
}

// Positive weights to sum to 1, negative ones to -1.
Kernel balanced(Kernel kernel) {
    float positive = 0, negative = 0;
    for (const float weight : kernel)
        (weight > 0 ? positive : negative) += std::abs(weight);
    for (float& weight : kernel)
        weight /= weight > 0 ? positive : negative;
    return kernel;
}

struct Observer {
    std::array<std::vector<Kernel>, 3> sensitivities; // in the order of Opponents
    Kernel smooth, slope, curvature; // a Gaussian and its derivatives, for edges and points
};

Observer observer(double pixelsPerDegree) {
    const double deviation = 0.5 * 0.082 * pixelsPerDegree;
    const int reach = static_cast<int>(std::ceil(3 * deviation));
    const auto gaussian = [&](double x) { return std::exp(-x * x / (2 * deviation * deviation)); };
    return {{sensitivity({{1, 0.0047}}, pixelsPerDegree),
             sensitivity({{1, 0.0053}}, pixelsPerDegree),
             sensitivity({{34.1, 0.04}, {13.5, 0.025}}, pixelsPerDegree)},
            balanced(kernel(reach, gaussian)),
            balanced(kernel(reach, [&](double x) { return -x * gaussian(x); })),
            balanced(kernel(reach, [&](double x) {
                return (x * x / (deviation * deviation) - 1) * gaussian(x);
            }))};
}

// The linear opponent colours Y, Cx and Cz of an image, without their scales and offset, which
// filters of unit sum would let pass: y, x - y and y - z. The latter two are empty for greys.
using Opponents = std::array<Image, 3>;

Opponents opponents(const Image8& image) {
    assert(image.channels == 1 || image.channels == 3);
    std::array<float, 256> linear;
    for (std::size_t code = 0; code < linear.size(); ++code)
        linear[code] = linearFromSrgb(static_cast<float>(code) / 255);
    const std::size_t channels = static_cast<std::size_t>(image.channels);
    Opponents result;
    for (std::size_t i = 0; i < channels; ++i)
        result[i] = {image.width, image.height, 1,
                     std::vector<float>(image.pixels.size() / channels)};
    const glm::mat3& toXyz = xyzFromRgb();
    forEachInParallel(image.height, [&](int y) {
        const std::size_t width = static_cast<std::size_t>(image.width),
                          from = static_cast<std::size_t>(y) * width;
        for (std::size_t i = from; i < from + width; ++i) {
            const std::uint8_t* code = &image.pixels[i * channels];
            if (channels == 1) {
                result[0].pixels[i] = linear[code[0]];
                continue;
            }
            const glm::vec3 xyz =
                toXyz * glm::vec3(linear[code[0]], linear[code[1]], linear[code[2]]);
            result[0].pixels[i] = xyz.y;
            result[1].pixels[i] = xyz.x - xyz.y;
            result[2].pixels[i] = xyz.y - xyz.z;
        }
    });
    return result;
}

void addScaled(float* sum, const float* values, float scale, int count) {
    for (int i = 0; i < count; ++i)
        sum[i] += scale * values[i];
}

// Adds row `y` of a plane filtered across and down by kernels of one length.
void addFiltered(std::vector<float>& row, const Image& plane, int y, const Kernel& across,
                 const Kernel& down) {
    assert(across.size() == down.size());
    const int taps = static_cast<int>(across.size()), reach = taps / 2, width = plane.width;
    std::vector<float> padded(static_cast<std::size_t>(width + 2 * reach));
    for (int i = 0; i < taps; ++i) {
        const int from = std::clamp(y + i - reach, 0, plane.height - 1);
        addScaled(padded.data() + reach, plane.pixels.data() + std::ptrdiff_t{from} * width,
                  down[static_cast<std::size_t>(i)], width);
    }
    std::fill_n(padded.begin(), reach, padded[static_cast<std::size_t>(reach)]);
    std::fill_n(padded.end() - reach, reach, padded[static_cast<std::size_t>(reach + width - 1)]);
    for (int i = 0; i < taps; ++i)
        addScaled(row.data(), padded.data() + i, across[static_cast<std::size_t>(i)], width);
}

std::vector<float> filteredRow(const Image& plane, int y, const Kernel& across,
                               const Kernel& down) {
    std::vector<float> row(static_cast<std::size_t>(plane.width));
    addFiltered(row, plane, y, across, down);
    return row;
}

// What the observer sees of a row: colours filtered by sensitivity, kept inside the screen's gamut.
std::vector<glm::vec3> seenColours(const Opponents& image, int y, const Observer& observer) {
    const glm::mat3 &toXyz = xyzFromRgb(), toRgb = glm::inverse(toXyz);
    std::array<std::vector<float>, 3> rows;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].resize(static_cast<std::size_t>(image[0].width));
        if (!image[i].pixels.empty())
            for (const Kernel& kernel : observer.sensitivities[i])
                addFiltered(rows[i], image[i], y, kernel, kernel);
    }
    std::vector<glm::vec3> result(rows[0].size());
    for (std::size_t x = 0; x < result.size(); ++x) {
        const glm::vec3 xyz(rows[0][x] + rows[1][x], rows[0][x], rows[0][x] - rows[2][x]);
        result[x] = huntLab(toXyz * glm::clamp(toRgb * xyz, 0.0F, 1.0F));
    }
    return result;
}

// Strength of the edges (`derivative` slope) or points (curvature) in a row.
std::vector<float> features(const Opponents& image, int y, const Kernel& smooth,
                            const Kernel& derivative) {
    std::vector<float> row = filteredRow(image[0], y, derivative, smooth);
    const std::vector<float> down = filteredRow(image[0], y, smooth, derivative);
    for (std::size_t x = 0; x < row.size(); ++x)
        row[x] = std::sqrt(row[x] * row[x] + down[x] * down[x]);
    return row;
}

// What the observer sees of a row of one image.
struct SeenRow {
    std::vector<glm::vec3> colours;
    std::vector<float> edges, points;
};

SeenRow seenRow(const Opponents& image, int y, const Observer& observer) {
    return {seenColours(image, y, observer), features(image, y, observer.smooth, observer.slope),
            features(image, y, observer.smooth, observer.curvature)};
}

// A distance of colours as a share of the largest distance that there is, from green to blue. The
// lower 40 % of these shares are stretched over 95 % of the result's range.
float redistributed(float colourDistance) {
    static const float largest = distance(huntLab(xyzFromRgb()[1]), huntLab(xyzFromRgb()[2]));
    const float share = colourDistance / largest;
    return share < 0.4F ? share * (0.95F / 0.4F) : 0.95F + (share - 0.4F) * (0.05F / 0.6F);
}

double meanOfShown(const Image& map, const std::vector<bool>& shown) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < map.pixels.size(); ++i)
        if (shown.empty() || shown[i]) {
            sum += static_cast<double>(map.pixels[i]);
            ++count;
        }
    return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

} // namespace

FlipError flipError(const Image8& first, const Image8& second, const std::vector<bool>& shown,
                    double pixelsPerDegree) {
    assert(first.width == second.width && first.height == second.height && pixelsPerDegree > 0);
    const Observer eye = observer(pixelsPerDegree);
    const Opponents a = opponents(first), b = opponents(second);
    FlipError error{{first.width, first.height, 1, std::vector<float>(a[0].pixels.size())}, 0};
    forEachInParallel(first.height, [&](int y) {
        const SeenRow rowA = seenRow(a, y, eye), rowB = seenRow(b, y, eye);
        for (int x = 0; x < first.width; ++x) {
            const auto i = static_cast<std::size_t>(x);
            const float colour = redistributed(distance(rowA.colours[i], rowB.colours[i]));
            const float feature = std::max(std::abs(rowA.edges[i] - rowB.edges[i]),
                                           std::abs(rowA.points[i] - rowB.points[i]));
            error.map.at(x, y, 0) =
                std::pow(colour, 1 - std::sqrt(feature / std::numbers::sqrt2_v<float>));
        }
    });
    error.mean = meanOfShown(error.map, shown);
    return error;
}

} // namespace obscura
