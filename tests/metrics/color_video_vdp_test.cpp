#include "base/csv.h"
#include "base/files.h"
#include "base/random.h"
#include "metrics/color_video_vdp.h"
#include "metrics/pyramid.h"
#include "metrics/sensitivity.h"
#include "metrics/sensitivity_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace obscura {
namespace {

namespace fs = std::filesystem;

const fs::path golden = fs::path(OBSCURA_SOURCE) / "../shared/golden/jod";

Display display(const std::string& name) { return displayOf(std::vector<std::string>{name}); }

// Soft blobs of colour: something in every band and channel.
Image8 blobs(int width, int height, std::uint64_t seed) {
    Random random(seed, "blobs");
    std::array<double, 12> phase;
    for (double& each : phase)
        each = 2 * std::numbers::pi * random.uniform();
    Image8 image{width, height, 3, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (std::size_t c = 0; c < 3; ++c) {
                double sum = 0;
                for (std::size_t k = 0; k < 4; ++k)
                    sum += std::sin(phase[3 * k + c] + (x + 2 * y) * 0.02 * std::pow(3, k)) / 4;
                image.pixels.push_back(static_cast<std::uint8_t>(128 + 100 * sum));
            }
    return image;
}

Image8 plain(int width, int height, std::uint8_t code) {
    return {width, height, 1,
            std::vector<std::uint8_t>(static_cast<std::size_t>(width * height), code)};
}

Image8 brighter(Image8 image, int by) {
    for (std::uint8_t& code : image.pixels)
        code = static_cast<std::uint8_t>(std::clamp(code + by, 0, 255));
    return image;
}

class Authors : public testing::Test {
  protected:
    void SetUp() override {
        if (!fs::exists(golden / "jod.csv"))
            GTEST_SKIP() << golden << " is not there: nothing was compared with ColorVideoVDP";
    }
    PredictedDifference of(const std::string& test, const std::string& reference,
                           const std::string& on) {
        return predictedDifference(picture(test), picture(reference), display(on));
    }

  private:
    const Image8& picture(const std::string& name) {
        const auto known = pictures_.find(name);
        return known != pictures_.end()
                   ? known->second
                   : pictures_.emplace(name, readImage8(golden / "pairs" / name, 3)).first->second;
    }
    std::map<std::string, Image8> pictures_;
};

TEST_F(Authors, PredictTheSameOfEveryPair) {
    const std::vector<CsvRecord> rows = splitCsv(readFile(golden / "jod.csv"));
    ASSERT_EQ(rows.size(), 121u);
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const std::vector<std::string>& cells = rows[i].cells;
        EXPECT_NEAR(display(cells[0]).pixelsPerDegree(), std::stod(cells[1]), 1e-6);
        EXPECT_NEAR(of(cells[2], cells[3], cells[0]).jod, std::stod(cells[4]), 2e-5)
            << cells[0] << " " << cells[2] << " " << cells[3];
    }
}

TEST_F(Authors, PoolTheSameDifferencesOfEveryBand) {
    const std::vector<CsvRecord> rows = splitCsv(readFile(golden / "bands.csv"));
    ASSERT_EQ(rows.size(), 379u);
    std::map<std::string, PredictedDifference> known;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const std::vector<std::string>& cells = rows[i].cells;
        const std::string key = cells[0] + cells[1] + cells[2];
        if (!known.contains(key))
            known[key] = of(cells[1], cells[2], cells[0]);
        const PredictedDifference::Band& band = known[key].bands.at(std::stoul(cells[4]));
        EXPECT_NEAR(band.cyclesPerDegree / std::stod(cells[5]), 1, 1e-5) << key;
        EXPECT_NEAR(band.pooled.at(std::stoul(cells[3])) / std::stod(cells[6]), 1, 1e-4)
            << key << " band " << cells[4] << " channel " << cells[3];
    }
}

// A slope of colours with squares, and on top of it fine stripes, other ones in every channel.
Image8 stripes(int width, int height, int strength) {
    Image8 image{width, height, 3, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) {
                const int square = (x / (3 + 2 * c) + y / (5 - c)) % 2,
                          stripe = (x * (c + 2) + y * 3) % 7;
                image.pixels.push_back(static_cast<std::uint8_t>(60 + x * 80 / width +
                                                                 y * 40 / height * c + 20 * square +
                                                                 strength * (c + 1) * stripe / 2));
            }
    return image;
}

// As the authors' program (release 0.5.6 on PyTorch 1.13, single precision) gives it, for those who
// have no golden folder. Of the second, rows and columns are of unlike parity.
TEST(ColorVideoVdp, GivesTheAuthorsNumbers) {
    const auto jod = [](int width, int height, const char* on) {
        return predictedDifference(stripes(width, height, 4), stripes(width, height, 0),
                                   display(on))
            .jod;
    };
    EXPECT_NEAR(jod(160, 90, "standard_fhd"), 9.359391, 1e-5);
    EXPECT_NEAR(jod(121, 96, "standard_fhd"), 9.407818, 1e-5);
    EXPECT_NEAR(jod(160, 90, "standard_4k"), 9.579566, 1e-5);
    EXPECT_NEAR(jod(121, 96, "standard_4k"), 9.657998, 1e-5);
}

TEST(ColorVideoVdp, EqualPicturesGiveTenAndAnEmptyMap) {
    for (const auto& [width, height] : {std::pair{1, 1}, {2, 3}, {5, 4}, {33, 18}, {160, 90}}) {
        const Image8 image = blobs(width, height, 1);
        const PredictedDifference same =
            predictedDifference(image, image, displays().front(), true);
        EXPECT_EQ(same.jod, 10) << width << " x " << height;
        EXPECT_EQ(same.map.width, width);
        EXPECT_EQ(same.map.height, height);
        EXPECT_THAT(same.map.pixels, testing::Each(0.0F));
    }
}

TEST(ColorVideoVdp, MoreDifferenceIsLessJod) {
    const Image8 image = blobs(160, 90, 1);
    double last = 10;
    for (const int by : {1, 2, 5, 10, 20}) {
        const double jod = predictedDifference(brighter(image, by), image, displays().front()).jod;
        EXPECT_LT(jod, last) << by;
        last = jod;
    }
}

TEST(ColorVideoVdp, HardlyMattersWhichIsTheReference) {
    const Image8 one = blobs(160, 90, 1), other = brighter(one, 12);
    EXPECT_NEAR(predictedDifference(one, other, displays().front()).jod,
                predictedDifference(other, one, displays().front()).jod, 0.05);
}

TEST(ColorVideoVdp, GreyIsThreeEqualChannels) {
    Image8 grey{40, 30, 1, {}}, colour{40, 30, 3, {}};
    for (int i = 0; i < 40 * 30; ++i) {
        grey.pixels.push_back(static_cast<std::uint8_t>(i * 7));
        colour.pixels.insert(colour.pixels.end(), 3, grey.pixels.back());
    }
    const Image8 other = brighter(grey, 30);
    EXPECT_EQ(predictedDifference(grey, other, displays().front()).jod,
              predictedDifference(colour, other, displays().front()).jod);
}

// Each image is seen relative to its own mean (the eye adapts), so that of plain greys nothing is
// left in any band. Who compares pictures of unlike brightness must know it.
TEST(ColorVideoVdp, DoesNotSeeThatAllOfAPictureIsBrighter) {
    const PredictedDifference result =
        predictedDifference(plain(64, 64, 120), plain(64, 64, 180), displays().front());
    EXPECT_NEAR(result.jod, 10, 1e-6);
    EXPECT_EQ(result.bands.size(), 6u); // log2(64) - 1, and the base
    EXPECT_EQ(result.bands.back().cyclesPerDegree, 0.1);
}

// Where the change is, there the map is brightest, and nowhere else near it.
TEST(ColorVideoVdp, MapShowsWhere) {
    const Image8 reference = blobs(160, 90, 1);
    Image8 test = reference;
    for (int y = 20; y < 40; ++y)
        for (int x = 100; x < 120; ++x)
            for (int c = 0; c < 3; ++c)
                test.pixels[static_cast<std::size_t>((y * 160 + x) * 3 + c)] ^= 0x20;
    const Image map = predictedDifference(test, reference, displays().front(), true).map;
    const auto largest = std::max_element(map.pixels.begin(), map.pixels.end());
    const auto at = static_cast<int>(largest - map.pixels.begin());
    EXPECT_NEAR(at % 160, 110, 14);
    EXPECT_NEAR(at / 160.0, 30, 14);
    EXPECT_GT(*largest, 0.05F);
    EXPECT_LE(*largest, 1.0F);
    EXPECT_LT(map.at(20, 80, 0), *largest / 20);
}

TEST(ColorVideoVdp, SeenFromFartherAwayFineDifferencesVanish) {
    const Image8 reference = plain(160, 96, 128);
    Image8 test = reference;
    for (std::size_t i = 0; i < test.pixels.size(); ++i)
        test.pixels[i] = (i + i / 160) % 2 ? 134 : 122;
    const auto from = [&](const char* distance) {
        return predictedDifference(test, reference, displayOf(std::vector<std::string>{distance}))
            .jod;
    };
    EXPECT_LT(from("distanceCm=30"), from("distanceCm=60"));
    EXPECT_LT(from("distanceCm=60"), from("distanceCm=120"));
}

// Burt and Adelson: constants stay, sizes are halved upwards.
TEST(Pyramid, KeepsAConstantWhereRowsAndColumnsAreOfLikeParity) {
    for (const auto& [rows, columns] : {std::pair{8, 6}, {7, 5}, {2, 2}, {3, 9}}) {
        const Plane coarse = reduced(Plane::Constant(rows, columns, 3));
        EXPECT_EQ(coarse.rows(), (rows + 1) / 2);
        EXPECT_EQ(coarse.cols(), (columns + 1) / 2);
        EXPECT_LT((coarse - 3).abs().maxCoeff(), 1e-6F) << rows << " x " << columns;
        Row row;
        for (int y = 0; y < rows; ++y) {
            expandRow(coarse, columns, y, row);
            EXPECT_EQ(row.size(), columns);
            EXPECT_LT((row - 3).abs().maxCoeff(), 1e-5F);
        }
    }
}

// The authors' right border: by hand, of rows and columns of unlike parity.
TEST(Pyramid, RightBorderFollowsTheParityOfRows) {
    Plane odd(1, 4), even(2, 3);
    odd << 1, 2, 3, 4;
    even << 1, 2, 3, 1, 2, 3;
    // One row, four columns: the last has taps on 1 ... 4, and .25 * 4 + .05 * 3 on top.
    EXPECT_NEAR(reduced(odd)(0, 1), .05 * 1 + .25 * 2 + .4 * 3 + .25 * 4 + .25 * 4 + .05 * 3, 1e-6);
    // Two rows, three columns: on 1 ... 3, and .05 * 3 on top.
    EXPECT_NEAR(reduced(even)(0, 1), .05 * 1 + .25 * 2 + .4 * 3 + .05 * 3, 1e-6);
}

TEST(Sensitivity, IsTheTableAtItsNodesAndAPowerLawBetween) {
    const auto at = [](std::size_t channel, std::size_t row, std::size_t column) {
        return static_cast<double>(
            sensitivityTable[(channel * sensitivityNodes + row) * sensitivityNodes + column]);
    };
    const auto node = [](double low, double high, double i) {
        return low * std::pow(high / low, i / 31);
    };
    for (const std::size_t column : {0u, 7u, 31u}) {
        const Sensitivity sensitivity(node(0.1, 64, static_cast<double>(column)));
        for (const std::size_t row : {0u, 12u, 30u})
            for (std::size_t c = 0; c < 3; ++c) {
                const double here = node(0.005, 10000, static_cast<double>(row)),
                             between = node(0.005, 10000, static_cast<double>(row) + 0.5);
                EXPECT_NEAR(std::log10(sensitivity.at(static_cast<float>(here))[c]),
                            at(c, row, column), 5e-4);
                EXPECT_NEAR(std::log10(sensitivity.at(static_cast<float>(between))[c]),
                            (at(c, row, column) + at(c, row + 1, column)) / 2, 2e-5);
            }
    }
}

TEST(Sensitivity, BeyondTheTableIsAsAtItsEnds) {
    EXPECT_EQ(Sensitivity(0.01).at(10), Sensitivity(0.1).at(10));
    EXPECT_EQ(Sensitivity(200).at(10), Sensitivity(64).at(10));
    EXPECT_EQ(Sensitivity(4).at(1e-9F), Sensitivity(4).at(0.005F));
    EXPECT_EQ(Sensitivity(4).at(1e9F), Sensitivity(4).at(10000));
}

} // namespace
} // namespace obscura
