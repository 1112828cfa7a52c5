#include "base/error.h"

#include "inference/multiplicity.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

using testing::DoubleNear;
using testing::Pointwise;

const std::vector<double> exact = {
    1, 0.242984954035, 0.0288167196559, 0.61771931703, 0.0288167196559,
    1, 0.405032246141}; // the thesis' conditions

// R 4.2.2, p.adjust(p, "holm") and "BH".
TEST(Multiplicity, OfTheThesisIsThatOfR) {
    EXPECT_THAT(holm(exact), Pointwise(DoubleNear(1e-11),
                                       {1.0, 1.0, 0.201717037591, 1.0, 0.201717037591, 1.0, 1.0}));
    EXPECT_THAT(benjaminiHochberg(exact),
                Pointwise(DoubleNear(1e-11), {1.0, 0.566964892748, 0.100858518796, 0.864807043842,
                                              0.100858518796, 1.0, 0.708806430746}));
}

TEST(Multiplicity, OfTiesAndExtremesIsThatOfR) {
    const std::vector<double> p = {.04, .001, .04, 1, 0, .2, .03, .001};
    EXPECT_THAT(holm(p), Pointwise(DoubleNear(1e-14), {.16, .007, .16, 1.0, 0.0, .4, .15, .007}));
    EXPECT_THAT(benjaminiHochberg(p),
                Pointwise(DoubleNear(1e-14),
                          {0.0533333333333333, 0.00266666666666667, 0.0533333333333333, 1.0, 0.0,
                           0.228571428571429, 0.0533333333333333, 0.00266666666666667}));
}

TEST(Multiplicity, OfOneOrNoneChangesNothing) {
    const std::vector<double> one = {1e-300}, none;
    EXPECT_EQ(holm(one), one);
    EXPECT_EQ(benjaminiHochberg(one), one);
    EXPECT_TRUE(holm(none).empty());
    EXPECT_TRUE(benjaminiHochberg(none).empty());
}

TEST(Multiplicity, RefusesWhatIsNoP) {
    for (const double wrong : {-0.1, 1.1, std::nan("")}) {
        EXPECT_THROW(holm(std::vector{0.5, wrong}), Error);
        EXPECT_THROW(benjaminiHochberg(std::vector{0.5, wrong}), Error);
    }
}

} // namespace
} // namespace obscura
