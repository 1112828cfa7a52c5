#include "base/random.h"
#include "metrics/flip.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace obscura {
namespace {

constexpr double pi = std::numbers::pi;

template <typename Function>
Image8 image(int width, int height, int channels, Function code) {
    Image8 result{width, height, channels, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c)
                result.pixels.push_back(static_cast<std::uint8_t>(code(x, y, c)));
    return result;
}

Image8 grey(int size, int code) {
    return image(size, size, 1, [&](int, int, int) { return code; });
}

// Blocks of 3 x 3 pixels whose channels are all or nothing.
Image8 blocks(int width, int height, std::uint64_t seed) {
    Random random(seed, "flip");
    std::vector<int> codes(1000);
    for (int& code : codes)
        code = random.uniform() < 0.5 ? 0 : 255;
    return image(width, height, 3, [&](int x, int y, int c) {
        return codes[static_cast<std::size_t>((y / 3 * 12 + x / 3) * 3 + c)];
    });
}

// The authors' program adds the errors of the 256 x 256 pixels in single precision, which raises
// black and white from 0.967380 to 0.967933; our mean is without that error.
double meanInSinglePrecision(const Image& map) {
    float sum = 0;
    for (const float value : map.pixels)
        sum += value;
    return static_cast<double>(sum) / static_cast<double>(map.pixels.size());
}

double linear(double code) {
    const double c = code / 255;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double rootOrLine(double t) { return t > 216.0 / 24389 ? std::cbrt(t) : t * 841 / 108 + 4.0 / 29; }

// In Hunt-adjusted L*a*b* the furthest colours, green and blue, are 203.3017 apart.
double redistributed(double distance) {
    const double largest = std::pow(203.3016546, 0.7), compressed = std::pow(distance, 0.7);
    return compressed < 0.4 * largest ? compressed / (0.4 * largest) * 0.95
                                      : 0.95 + (compressed / largest - 0.4) / 0.6 * 0.05;
}

struct Anchor {
    int first, second;
    double release; // printed by the authors' release 1.6 for 256 x 256 pixels
};

TEST(Flip, ConstantGreys) {
    for (const Anchor& anchor :
         {Anchor{0, 255, 0.967933}, Anchor{255, 0, 0.967933}, Anchor{128, 129, 0.029881},
          Anchor{128, 153, 0.281206}, Anchor{255, 230, 0.261731}, Anchor{77, 77, 0}}) {
        const FlipError error = flipError(grey(256, anchor.first), grey(256, anchor.second));
        EXPECT_NEAR(meanInSinglePrecision(error.map), anchor.release, 1e-4)
            << anchor.first << " " << anchor.second;
        const double lightness =
            116 * (rootOrLine(linear(anchor.first)) - rootOrLine(linear(anchor.second)));
        EXPECT_NEAR(error.mean, redistributed(std::abs(lightness)), 2e-4);
    }
}

TEST(Flip, GreenAndBlueAreFurthestApart) {
    const auto primary = [](int channel) {
        return image(8, 8, 3, [&](int, int, int c) { return c == channel ? 255 : 0; });
    };
    EXPECT_NEAR(flipError(primary(1), primary(2)).mean, 1, 1e-5);
}

// Of the authors' release, with noise of their own.
TEST(Flip, NoiseIsSeenLessFromAfar) {
    Random random(1, "flip noise");
    const Image8 flat = grey(128, 180), noisy = image(128, 128, 1, [&](int, int, int) {
                                            return std::lround(180 + 5 * random.normal());
                                        });
    EXPECT_NEAR(flipError(flat, noisy).mean, 0.037, 0.0037);
    EXPECT_NEAR(flipError(flat, noisy, {}, 24).mean, 0.094, 0.0094);
}

TEST(Flip, AnEdgeMovedByAPixelIsSeenNearItOnly) {
    const auto edge = [](int at) {
        return image(64, 16, 1, [&](int x, int, int) { return x < at ? 60 : 200; });
    };
    const Image map = flipError(edge(32), edge(33)).map;
    for (int y = 0; y < map.height; ++y) {
        EXPECT_GT(map.at(32, y, 0), 0.4F); // the pixel that changed
        for (int x = 0; x < map.width; ++x)
            if (std::abs(x - 32) > 10) { // the reach of the widest filter
                EXPECT_EQ(map.at(x, y, 0), 0);
            }
    }
}

TEST(Flip, IsSymmetric) {
    const Image8 first = blocks(30, 20, 1), second = blocks(30, 20, 2);
    EXPECT_EQ(flipError(first, second).map.pixels, flipError(second, first).map.pixels);
}

TEST(Flip, OneChannelIsThreeEqualOnes) {
    const auto wave = [](int channels, int phase) {
        return image(40, 30, channels,
                     [&](int x, int y, int) { return 128 + 100 * std::sin(x * 0.3 + y + phase); });
    };
    const Image one = flipError(wave(1, 0), wave(1, 1)).map,
                three = flipError(wave(3, 0), wave(3, 1)).map;
    EXPECT_LT(compare(one, three).largest, 1e-4);
}

TEST(Flip, MeanOfShownPixels) {
    const Image8 black = image(60, 8, 1, [](int, int, int) { return 0; }),
                 half = image(60, 8, 1, [](int x, int, int) { return x < 30 ? 0 : 255; });
    std::vector<bool> left(black.pixels.size());
    for (std::size_t i = 0; i < left.size(); ++i)
        left[i] = i % 60 < 20;
    EXPECT_EQ(flipError(black, half, left).mean, 0);
    EXPECT_GT(flipError(black, half).mean, 0.4);
    EXPECT_TRUE(std::isnan(flipError(black, half, std::vector<bool>(left.size())).mean));
}

// The paper's definition, pixel by pixel: filters in two dimensions, none of them separated,
// colours in the scales of YCxCz and L*a*b*.
class Definition {
  public:
    Definition(const Image8& image, double pixelsPerDegree)
        : width_(image.width), height_(image.height), pixelsPerDegree_(pixelsPerDegree) {
        for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
            const glm::dvec3 t = xyzFromRgb_ *
                                 glm::dvec3(linear(image.pixels[i]), linear(image.pixels[i + 1]),
                                            linear(image.pixels[i + 2])) /
                                 white_;
            opponents_.emplace_back(116 * t.y - 16, 500 * (t.x - t.y), 200 * (t.y - t.z));
        }
    }

    glm::dvec3 colour(int x, int y) const {
        const auto gaussian = [](double a, double b, double square) {
            return a * std::sqrt(pi / b) * std::exp(-pi * pi * square / b);
        };
        glm::dvec3 sum(0), total(0);
        const int reach =
            static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * pixelsPerDegree_));
        forNeighbours(x, y, reach, [&](int i, int j, const glm::dvec3& opponent) {
            const double square = (i * i + j * j) / (pixelsPerDegree_ * pixelsPerDegree_);
            const glm::dvec3 weight(gaussian(1, 0.0047, square), gaussian(1, 0.0053, square),
                                    gaussian(34.1, 0.04, square) + gaussian(13.5, 0.025, square));
            sum += weight * opponent, total += weight;
        });
        const glm::dvec3 seen = sum / total;
        const double luminance = (seen.x + 16) / 116;
        const glm::dvec3 xyz(luminance + seen.y / 500, luminance, luminance - seen.z / 200);
        const glm::dvec3 rgb = glm::clamp(glm::inverse(xyzFromRgb_) * (xyz * white_), 0.0, 1.0);
        const glm::dvec3 t = xyzFromRgb_ * rgb / white_;
        const double lightness = 116 * rootOrLine(t.y) - 16;
        return {lightness, lightness / 100 * 500 * (rootOrLine(t.x) - rootOrLine(t.y)),
                lightness / 100 * 200 * (rootOrLine(t.y) - rootOrLine(t.z))};
    }

    // Edges: the first derivative of a Gaussian; points: the second.
    double feature(int x, int y, bool point) const {
        const double deviation = 0.5 * 0.082 * pixelsPerDegree_, square = deviation * deviation;
        double across[2] = {}, down[2] = {}, total[2] = {}; // of negative and positive weights
        forNeighbours(x, y, static_cast<int>(std::ceil(3 * deviation)),
                      [&](int i, int j, const glm::dvec3& opponent) {
                          const double gaussian = std::exp(-(i * i + j * j) / (2 * square));
                          const auto add = [&](double* sums, int along, double value) {
                              const double weight =
                                  (point ? along * along / square - 1 : -along) * gaussian;
                              sums[weight > 0] += weight * value;
                          };
                          const double value = (opponent.x + 16) / 116;
                          add(across, i, value), add(down, j, value), add(total, i, 1);
                      });
        return std::hypot(across[1] / total[1] - across[0] / total[0],
                          down[1] / total[1] - down[0] / total[0]);
    }

  private:
    template <typename Visit>
    void forNeighbours(int x, int y, int reach, Visit visit) const {
        for (int j = -reach; j <= reach; ++j)
            for (int i = -reach; i <= reach; ++i)
                visit(
                    i, j,
                    opponents_[static_cast<std::size_t>(std::clamp(y + j, 0, height_ - 1) * width_ +
                                                        std::clamp(x + i, 0, width_ - 1))]);
    }

    glm::dmat3 xyzFromRgb_ = glm::transpose(glm::dmat3(0.412386564, 0.357591465, 0.180450516, //
                                                       0.212636821, 0.715182984, 0.0721801964,
                                                       0.0193306202, 0.119197164, 0.950372587));
    glm::dvec3 white_{0.950428545, 1, 1.088900371};
    int width_, height_;
    double pixelsPerDegree_;
    std::vector<glm::dvec3> opponents_;
};

TEST(Flip, EqualsTheDefinitionPixelByPixel) {
    const Image8 first = blocks(24, 18, 3), second = blocks(24, 18, 4);
    for (const double pixelsPerDegree : {67.02, 30.0}) {
        const Definition a(first, pixelsPerDegree), b(second, pixelsPerDegree);
        const Image map = flipError(first, second, {}, pixelsPerDegree).map;
        for (int y = 0; y < map.height; ++y)
            for (int x = 0; x < map.width; ++x) {
                const glm::dvec3 d = a.colour(x, y) - b.colour(x, y);
                const double colour = redistributed(std::abs(d.x) + std::hypot(d.y, d.z));
                const double feature =
                    std::max(std::abs(a.feature(x, y, false) - b.feature(x, y, false)),
                             std::abs(a.feature(x, y, true) - b.feature(x, y, true)));
                EXPECT_NEAR(map.at(x, y, 0),
                            std::pow(colour, 1 - std::sqrt(feature / std::sqrt(2))), 5e-4)
                    << x << " " << y;
            }
    }
}

} // namespace
} // namespace obscura
