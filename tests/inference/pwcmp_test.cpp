#include "base/error.h"
#include "base/random.h"
#include "tests/inference/matrices.h"

#include "inference/link.h"
#include "inference/pwcmp.h"

namespace obscura {
namespace {

using Values = std::vector<double>;

// Votes of 18 people on seven tone-mapping operators and the scales that pwcmp's pw_scale found
// under Octave 7.3, prior none and gaussian (shared golden/human; pwcmp, MIT licence, R. Mantiuk
// 2016, the study is doi 10.1111/cgf.12235).
struct Scene {
    const char* name;
    Values wins, none, gaussian;
};
void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }

const Scene scenes[] = {
    {"all",
     {0,  45, 16, 17, 43, 26, 19, 11, 0,  3,  5,  15, 8,  11, 37, 35, 0,
      43, 40, 48, 35, 44, 43, 12, 0,  47, 38, 40, 19, 54, 10, 6,  0,  24,
      17, 34, 55, 15, 20, 41, 0,  21, 46, 44, 17, 28, 47, 34, 0},
     {-0.108586, -1.390440, 1.044923, 0.607468, -0.562347, 0.039092, 0.369892},
     {-0.121468, -1.369227, 1.038912, 0.614730, -0.566880, 0.036072, 0.367850}},
    {"corridor",
     {0, 13, 7, 3, 10, 7, 1, 1, 0, 2, 1, 3,  3, 0, 8,  7, 0, 3,  11, 10, 7, 10, 6,  5, 0,
      8, 7,  5, 2, 11, 1, 1, 0, 6, 0, 7, 10, 4, 3, 10, 0, 1, 15, 8,  9,  9, 10, 11, 0},
     {0.015884, -1.590088, 0.551746, 0.822194, -0.978961, -0.290532, 1.469754},
     {0.014104, -1.515968, 0.535037, 0.791690, -0.946179, -0.281168, 1.402481}},
    {"exhibition",
     {0,  10, 0,  3, 10, 6, 1, 1, 0, 0, 1, 1,  0, 1, 10, 6, 0, 13, 9,  11, 10, 9, 10, 0, 0,
      11, 9,  10, 5, 13, 0, 1, 0, 5, 5, 7, 13, 1, 5, 7,  0, 4, 9,  11, 0,  4,  8, 6,  0},
     {-0.492947, -2.452168, 3.114946, 0.573610, -0.726007, -0.077188, 0.059752},
     {-0.411579, -2.334028, 2.721045, 0.579476, -0.632326, -0.030490, 0.107907}},
    {"rivoli",
     {0,  9, 6, 8, 9,  6, 8, 1, 0, 0, 2, 4, 2, 3, 7,  9, 0, 10, 9,  9, 6, 5,  12, 2, 0,
      12, 6, 7, 3, 11, 1, 1, 0, 2, 3, 5, 8, 2, 6, 10, 0, 4, 4,  10, 2, 7, 10, 5,  0},
     {0.602635, -1.406312, 1.224490, 0.224624, -0.907097, 0.159167, 0.102492},
     {0.587883, -1.352841, 1.162759, 0.222536, -0.882215, 0.156905, 0.104971}},
    {"students",
     {0, 7,  1,  1, 10, 4, 6, 2, 0, 0, 0,  5,  0, 4, 5,  3, 0, 10, 4, 12, 7, 8,  9, 4, 0,
      9, 10, 12, 3, 8,  0, 0, 0, 2, 3, 10, 12, 3, 6, 11, 0, 9, 9,  8, 1,  1, 10, 6, 0},
     {-0.384988, -1.595550, 1.787475, 1.262037, -1.314600, 0.509600, -0.263974},
     {-0.354425, -1.422932, 1.581335, 1.148362, -1.187346, 0.474711, -0.239706}},
    {"window",
     {0, 6, 2, 2, 4,  3, 3, 6, 0, 1, 1, 2,  3, 3, 7, 10, 0, 7, 7, 6, 5, 12, 6, 1, 0,
      7, 6, 6, 6, 11, 8, 3, 0, 9, 6, 5, 12, 5, 0, 3, 0,  3, 9, 7, 5, 7, 9,  6, 0},
     {-0.667827, -1.009606, 0.556555, 0.578820, 0.290255, -0.208421, 0.460227},
     {-0.661582, -0.997376, 0.549747, 0.570095, 0.287667, -0.203727, 0.455174}},
};

class Pwcmp : public testing::TestWithParam<Scene> {};

TEST_P(Pwcmp, FindsTheScalesOfItsModel) {
    const Wins wins = square(GetParam().wins);
    const auto none = pwcmpScale(wins), gaussian = pwcmpScaleWithPrior(wins);
    ASSERT_TRUE(none && gaussian);
    // The optimum is nearer to pwcmp's than the 0.002 and 0.005 that golden/ allows.
    expectNear(*none, GetParam().none, 1e-5);
    expectNear(*gaussian, GetParam().gaussian, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Pwcmp, testing::ValuesIn(scenes),
                         [](const auto& scene) { return std::string(scene.param.name); });

TEST(PwcmpPrior, KeepsUnanimousItemsFinite) {
    const Wins wins = square({0, 0, 0, 9, 0, 4, 9, 5, 0}); // item 0 never won
    EXPECT_FALSE(pwcmpScale(wins));
    const auto scale = pwcmpScaleWithPrior(wins);
    ASSERT_TRUE(scale);
    EXPECT_LT((*scale)(0), -1);
    EXPECT_GT((*scale)(0), -5);
}

TEST(PwcmpPrior, DoesNotPlaceGroupsThatNeverMet) {
    Wins wins = Wins::Zero(4, 4);
    wins(0, 1) = wins(1, 0) = wins(2, 3) = wins(3, 2) = 5;
    EXPECT_FALSE(pwcmpScaleWithPrior(wins));
    EXPECT_FALSE(pwcmpScale(wins));
}

// 12 people compare all pairs of five items in two scenes; the last one answers upside down.
std::vector<std::vector<Wins>> withAnOutlier() {
    Random random(11, "outlier");
    std::vector<std::vector<Wins>> result(2);
    for (auto& scene : result)
        for (int person = 0; person < 12; ++person) {
            Wins& wins = scene.emplace_back(Wins::Zero(5, 5));
            const double sign = person == 11 ? -1 : 1;
            for (int i = 0; i < 5; ++i)
                for (int j = 0; j < i; ++j)
                    for (int repeat = 0; repeat < 2; ++repeat) {
                        const double p = distribution(Link::probit, sign * 0.6 * (i - j)).below;
                        const bool isFirst = random.uniform() < p;
                        wins(isFirst ? i : j, isFirst ? j : i) += 1;
                    }
        }
    return result;
}

TEST(Outlyingness, FindsWhoAnswersUpsideDown) {
    const auto found = outlyingness(withAnOutlier());
    ASSERT_TRUE(found);
    EXPECT_GT(found->back().distance, 3);
    for (std::size_t person = 0; person < 11; ++person)
        EXPECT_LT((*found)[person].distance, 1.5) << person;
}

TEST(Outlyingness, OfLikelihoodsByHand) {
    // Equal votes of the others put both items at 0: every answer has probability 1/2.
    const std::vector<Wins> even(4, square({0, 2, 2, 0}));
    const auto found = outlyingness(std::vector<std::vector<Wins>>{even});
    ASSERT_TRUE(found);
    for (const Outlyingness& one : *found) {
        EXPECT_NEAR(one.logLikelihood, std::log(6.0 / 16), 1e-9);
        EXPECT_EQ(one.distance, 0);
    }
}

TEST(Outlyingness, RefusesScenesOfOtherPeople) {
    const std::vector<Wins> four(4, square({0, 2, 2, 0})), three(3, square({0, 2, 2, 0}));
    EXPECT_THROW(outlyingness(std::vector<std::vector<Wins>>{four, three}), Error);
    EXPECT_FALSE(outlyingness({}));
}

} // namespace
} // namespace obscura
