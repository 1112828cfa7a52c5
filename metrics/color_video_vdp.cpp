#include "metrics/color_video_vdp.h"

#include "base/parallel.h"
#include "metrics/pyramid.h"
#include "metrics/sensitivity.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

namespace obscura {

namespace {

constexpr int channels = 3; // achromatic, red-green, yellow-violet
using Planes = std::array<Plane, channels>;
using Weights = std::array<float, channels>;

// The numbers that the authors fitted (cvvdp_parameters.json of release 0.5.6, (c) University of
// Cambridge and Meta, MIT licence), of what does not move.
constexpr float maskingExponent = 2.264355182647705F;   // mask_p
constexpr float maskingStrength = -0.7954971194267273F; // mask_c, log10
constexpr Weights maskExponents{1.302622675895691F, 2.8885908126831055F, 3.6807713508605957F};
constexpr std::array<Weights, channels> crossMasking{{
    // xcm_weights, log2: how much what is in the row's channel hides what is in the column's
    {-0.18950104713439941F, -5.962151050567627F, -4.31834602355957F},
    {2.5655593872070312F, 0.34406712651252747F, -2.719646453857422F},
    {3.8118371963500977F, -1.0051705837249756F, -0.5193376541137695F},
}};
constexpr Weights channelGains{1, 1.45F, 1};
constexpr float largestDifference = 2.5642454624176025F;      // d_max, log10
constexpr double sensitivityCorrection = -0.2797423303127289; // decibels
constexpr double exponentOverPixels = 2, exponentOverBands = 4, exponentOverChannels = 4;
constexpr Weights basebandWeights{0.0036334486212581396F, 1.6627724170684814F, 4.11874532699585F};
constexpr double imageFactor = 0.577918291091919; // image_int
constexpr double jodFactor = 0.0439569391310215, jodExponent = 0.9302042722702026;

constexpr double baseFrequency = 0.1, lowestFrequency = 0.2; // cycles per degree
constexpr float leastBackground = 0.01F, largestContrast = 1000;
constexpr int blurReach = 6; // pixels
constexpr double blurDeviation = 3;
// Powers begin at exactly 0 and have a slope there: (x + tiny)^p - tiny^p.
constexpr double tiny = 1e-5;

double power(double x, double exponent) {
    return std::pow(x + tiny, exponent) - std::pow(tiny, exponent);
}
template <typename Values>
auto power(const Values& x, float exponent) {
    const float atZero = std::pow(static_cast<float>(tiny), exponent);
    return ((x + static_cast<float>(tiny)).log() * exponent).exp() - atZero;
}

// 1. and 2.: the light that a display gives (sRGB's curve), in opponent colours of the eye's cones
// (DKL, white D65).
Planes opponents(const Image8& image, const Display& display) {
    constexpr double reflectance = 0.005;
    using Matrix = Eigen::Matrix3d;
    const Matrix xyzFromRgb{{0.4124564, 0.3575761, 0.1804375},
                            {0.2126729, 0.7151522, 0.072175},
                            {0.0193339, 0.119192, 0.9503041}},
        lmsFromXyz{{0.187596268556126, 0.585168649077728, -0.026384263306304},
                   {-0.133397430663221, 0.405505777260049, 0.034502127690364},
                   {0.000244379021663, -0.000542995890619, 0.019406849066323}},
        dklFromLms{{1, 1, 0}, {1, -2.311130179947035, 0}, {-1, -1, 50.977571328718781}};
    const Matrix dklFromRgb = dklFromLms * lmsFromXyz * xyzFromRgb;
    const double black = display.peak / display.contrast,
                 reflected = display.ambient / std::numbers::pi * reflectance;
    // By channel of the display and code: what one adds to each opponent colour.
    std::array<std::array<Weights, 256>, 3> added;
    for (std::size_t rgb = 0; rgb < 3; ++rgb)
        for (std::size_t code = 0; code < 256; ++code) {
            const double v = static_cast<double>(code) / 255,
                         linear = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4),
                         luminance = (display.peak - black) * linear + black + reflected;
            for (std::size_t c = 0; c < channels; ++c)
                added[rgb][code][c] =
                    static_cast<float>(luminance * dklFromRgb(static_cast<Eigen::Index>(c),
                                                              static_cast<Eigen::Index>(rgb)));
        }
    Planes result;
    for (Plane& plane : result)
        plane.resize(image.height, image.width);
    const bool grey = image.channels == 1;
    forEachInParallel(image.height, [&](int y) {
        const std::uint8_t* pixel =
            image.pixels.data() + std::ptrdiff_t{y} * image.width * image.channels;
        for (int x = 0; x < image.width; ++x, pixel += image.channels) {
            const Weights &r = added[0][pixel[0]], &g = added[1][pixel[grey ? 0 : 1]],
                          &b = added[2][pixel[grey ? 0 : 2]];
            for (std::size_t c = 0; c < channels; ++c)
                result[c](y, x) = r[c] + g[c] + b[c];
        }
    });
    return result;
}

// 3.: the Gaussian pyramid, and how high it is on that display.
std::vector<Planes> pyramid(Planes finest, std::size_t levels) {
    std::vector<Planes> result{std::move(finest)};
    while (result.size() <= levels) {
        Planes next;
        for (std::size_t c = 0; c < channels; ++c)
            next[c] = reduced(result.back()[c]);
        result.push_back(std::move(next));
    }
    return result;
}

// Of all bands but the base, the finest first.
std::vector<double> frequencies(double pixelsPerDegree, int width, int height) {
    const auto most = static_cast<int>(std::floor(std::log2(std::min(width, height)))) - 1;
    std::vector<double> result;
    for (double frequency = pixelsPerDegree / 2; static_cast<int>(result.size()) < most;
         frequency = frequency * (result.size() == 1 ? 0.3228 : 0.5)) {
        result.push_back(frequency);
        if (frequency <= lowestFrequency)
            break;
    }
    return result;
}

// 6.: a Gaussian; `row` has blurReach more pixels on both sides.
const std::array<float, 2 * blurReach + 1>& blurKernel() {
    static const auto kernel = [] {
        std::array<double, 2 * blurReach + 1> weights;
        for (std::size_t i = 0; i < weights.size(); ++i)
            weights[i] =
                std::exp(-std::pow((static_cast<double>(i) - blurReach) / blurDeviation, 2) / 2);
        const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
        std::array<float, 2 * blurReach + 1> result;
        std::transform(weights.begin(), weights.end(), result.begin(),
                       [&](double weight) { return static_cast<float>(weight / sum); });
        return result;
    }();
    return kernel;
}

// Beyond the border, the pixel as far inside; the edge pixel is not repeated.
int reflected(int index, int count) {
    return index < 0 ? -index : index < count ? index : 2 * count - 2 - index;
}

void blurRow(const Plane& plane, int y, Row& row) {
    const auto& kernel = blurKernel();
    const int rows = static_cast<int>(plane.rows()), columns = static_cast<int>(plane.cols());
    Row padded(columns + 2 * blurReach);
    auto inside = padded.segment(blurReach, columns);
    inside = kernel[blurReach] * plane.row(y);
    for (int i = 1; i <= blurReach; ++i)
        inside += kernel[static_cast<std::size_t>(blurReach + i)] *
                  (plane.row(reflected(y - i, rows)) + plane.row(reflected(y + i, rows)));
    for (int i = 1; i <= blurReach; ++i) {
        padded[blurReach - i] = padded[blurReach + i];
        padded[blurReach + columns - 1 + i] = padded[blurReach + columns - 1 - i];
    }
    row = kernel[blurReach] * inside;
    for (int i = 1; i <= blurReach; ++i)
        row += kernel[static_cast<std::size_t>(blurReach + i)] *
               (padded.segment(blurReach - i, columns) + padded.segment(blurReach + i, columns));
}

// One level of both images' pyramids and, of all bands but the base, the next.
struct Levels {
    const Planes &test, &reference;
};

// Both images' contrasts in the units of what can just be seen, as masking wants them: how far they
// are apart, and the lesser of their sizes, by which both hide.
struct Contrasts {
    Planes apart, lesser;
};

void resize(Planes& planes, const Plane& like) {
    for (Plane& plane : planes)
        plane.resize(like.rows(), like.cols());
}

// 4. and 5.
Contrasts contrasts(const Levels& fine, const Levels& coarse, const Sensitivity& sensitivity,
                    float factor) {
    Contrasts result;
    const int height = static_cast<int>(fine.test[0].rows()),
              width = static_cast<int>(fine.test[0].cols());
    resize(result.apart, fine.test[0]);
    resize(result.lesser, fine.test[0]);
    forEachInParallel(height, [&](int y) {
        std::array<Row, channels> test, reference;
        std::array<Row, channels> seen; // the sensitivity at each pixel
        for (std::size_t c = 0; c < channels; ++c) {
            expandRow(coarse.test[c], width, y, test[c]);
            expandRow(coarse.reference[c], width, y, reference[c]);
            seen[c].resize(width);
        }
        const Row testBackground = test[0].max(leastBackground),
                  referenceBackground = reference[0].max(leastBackground);
        for (int x = 0; x < width; ++x) {
            const std::array<float, 3> at = sensitivity.at(referenceBackground[x]);
            for (std::size_t c = 0; c < channels; ++c)
                seen[c][x] = at[c];
        }
        for (std::size_t c = 0; c < channels; ++c) {
            const float gain = factor * channelGains[c];
            test[c] = ((fine.test[c].row(y) - test[c]) / testBackground).min(largestContrast) *
                      seen[c] * gain;
            reference[c] = ((fine.reference[c].row(y) - reference[c]) / referenceBackground)
                               .min(largestContrast) *
                           seen[c] * gain;
            result.apart[c].row(y) = (test[c] - reference[c]).abs();
            result.lesser[c].row(y) = test[c].abs().min(reference[c].abs());
        }
    });
    return result;
}

// The differences that are seen, pooled over pixels; the planes stay for a map.
struct Differences {
    Planes planes; // empty unless kept
    std::array<double, channels> pooled{};
};

// 7., over pixels.
double pooled(const std::vector<double>& rowSums, double pixels) {
    return power(std::accumulate(rowSums.begin(), rowSums.end(), 0.0) / pixels,
                 1 / exponentOverPixels);
}
// (x + tiny)^2 - tiny^2, of a row
double rowSum(const Row& row) {
    static_assert(exponentOverPixels == 2);
    return static_cast<double>((row * (row + 2 * static_cast<float>(tiny))).sum());
}

// 6.
Differences maskedDifferences(const Contrasts& contrasts, bool keep) {
    const int height = static_cast<int>(contrasts.apart[0].rows()),
              width = static_cast<int>(contrasts.apart[0].cols());
    const bool blurs = std::min(width, height) > blurReach;
    const float strength = std::pow(10.0F, maskingStrength),
                most = std::pow(10.0F, largestDifference);
    std::array<Weights, channels> hides;
    for (std::size_t from = 0; from < channels; ++from)
        for (std::size_t to = 0; to < channels; ++to)
            hides[from][to] = std::exp2(crossMasking[from][to]);
    Differences result;
    if (keep)
        resize(result.planes, contrasts.apart[0]);
    std::array<std::vector<double>, channels> sums;
    sums.fill(std::vector<double>(static_cast<std::size_t>(height)));
    forEachInParallel(height, [&](int y) {
        std::array<Row, channels> masks;
        for (std::size_t c = 0; c < channels; ++c) {
            if (blurs)
                blurRow(contrasts.lesser[c], y, masks[c]);
            else
                masks[c] = contrasts.lesser[c].row(y);
            masks[c] = power(masks[c] * strength, maskExponents[c]);
        }
        for (std::size_t c = 0; c < channels; ++c) {
            Row difference =
                power(contrasts.apart[c].row(y), maskingExponent) /
                (1 + hides[0][c] * masks[0] + hides[1][c] * masks[1] + hides[2][c] * masks[2]);
            difference = most * difference / (most + difference);
            sums[c][static_cast<std::size_t>(y)] = rowSum(difference);
            if (keep)
                result.planes[c].row(y) = difference;
        }
    });
    for (std::size_t c = 0; c < channels; ++c)
        result.pooled[c] = pooled(sums[c], static_cast<double>(width) * height);
    return result;
}

// The base band's, which nothing masks: each image relative to its own mean.
Differences baseDifferences(const Levels& base, bool keep, float correction) {
    const auto meanOf = [](const Plane& plane) {
        return std::max(static_cast<float>(plane.cast<double>().mean()), leastBackground);
    };
    const float test = meanOf(base.test[0]), reference = meanOf(base.reference[0]);
    const Weights seen = Sensitivity(baseFrequency).at(reference);
    Differences result;
    for (std::size_t c = 0; c < channels; ++c) {
        const Plane difference = ((base.test[c] / test).min(largestContrast) -
                                  (base.reference[c] / reference).min(largestContrast))
                                     .abs() *
                                 (seen[c] * correction);
        std::vector<double> sums;
        for (Eigen::Index y = 0; y < difference.rows(); ++y)
            sums.push_back(rowSum(difference.row(y)));
        result.pooled[c] = pooled(sums, static_cast<double>(difference.size()));
        if (keep)
            result.planes[c] = difference;
    }
    return result;
}

// 8.
double jodOf(double difference) {
    constexpr double straight = 0.1; // below, a line from 10
    const auto loss = [](double q) { return jodFactor * std::pow(q, jodExponent); };
    return 10 -
           (difference <= straight ? loss(straight) / straight * difference : loss(difference));
}

double weightOf(std::size_t channel, bool base) {
    return base ? static_cast<double>(basebandWeights[channel]) : 1;
}

// 7., over bands and channels.
double pooled(const std::vector<PredictedDifference::Band>& bands) {
    double channelSum = 0;
    for (std::size_t c = 0; c < channels; ++c) {
        double bandSum = 0;
        for (const PredictedDifference::Band& band : bands)
            bandSum +=
                power(band.pooled[c] * weightOf(c, &band == &bands.back()), exponentOverBands);
        channelSum += power(power(bandSum, 1 / exponentOverBands), exponentOverChannels);
    }
    return imageFactor * power(channelSum, 1 / exponentOverChannels);
}

// 9., of one band: its channels as one.
Plane joined(const Planes& planes, bool base) {
    Plane sum = Plane::Zero(planes[0].rows(), planes[0].cols());
    for (std::size_t c = 0; c < channels; ++c)
        sum += (planes[c] * static_cast<float>(weightOf(c, base))).square().square();
    return sum.sqrt().sqrt();
}

// The bands' maps, finest first, as one.
Image mapOf(const std::vector<Plane>& bands) {
    Plane sum = bands.back();
    for (std::size_t b = bands.size() - 1; b-- > 0;) {
        Plane finer = bands[b];
        Row row;
        const int height = static_cast<int>(finer.rows()), width = static_cast<int>(finer.cols());
        for (int y = 0; y < height; ++y) {
            expandRow(sum, width, y, row);
            finer.row(y) += row;
        }
        sum = std::move(finer);
    }
    Image map{static_cast<int>(sum.cols()), static_cast<int>(sum.rows()), 1, {}};
    map.pixels.reserve(static_cast<std::size_t>(sum.size()));
    for (Eigen::Index y = 0; y < sum.rows(); ++y)
        for (Eigen::Index x = 0; x < sum.cols(); ++x)
            map.pixels.push_back(static_cast<float>(std::clamp(
                1 - jodOf(imageFactor * static_cast<double>(sum(y, x))) / 10, 0.0, 1.0)));
    return map;
}

} // namespace

PredictedDifference predictedDifference(const Image8& test, const Image8& reference,
                                        const Display& display, bool withMap) {
    assert(test.width == reference.width && test.height == reference.height);
    assert(test.channels == 1 || test.channels == 3);
    assert(reference.channels == 1 || reference.channels == 3);
    const std::vector<double> cycles =
        frequencies(display.pixelsPerDegree(), test.width, test.height);
    const std::vector<Planes> tests = pyramid(opponents(test, display), cycles.size()),
                              references = pyramid(opponents(reference, display), cycles.size());
    const auto correction = static_cast<float>(std::pow(10, sensitivityCorrection / 20));
    PredictedDifference result;
    std::vector<Plane> maps;
    const auto add = [&](double frequency, const Differences& differences, bool base) {
        result.bands.push_back({frequency, differences.pooled});
        if (withMap)
            maps.push_back(joined(differences.planes, base));
    };
    for (std::size_t b = 0; b < cycles.size(); ++b)
        add(cycles[b],
            maskedDifferences(contrasts({tests[b], references[b]},
                                        {tests[b + 1], references[b + 1]}, Sensitivity(cycles[b]),
                                        b == 0 ? correction : 2 * correction),
                              withMap),
            false);
    add(baseFrequency, baseDifferences({tests.back(), references.back()}, withMap, correction),
        true);
    result.jod = jodOf(pooled(result.bands));
    if (withMap)
        result.map = mapOf(maps);
    return result;
}

} // namespace obscura
