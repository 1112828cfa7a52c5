#include "base/error.h"
#include "base/random.h"
#include "tests/inference/matrices.h"

#include "inference/bootstrap.h"
#include "inference/link.h"

namespace obscura {
namespace {

// Skewed, so that percentile and BCa limits differ.
const std::vector<double> sample = {.2, .5, .9, 1.1, 1.3, 1.9, 2.4, 3.8, 6.1, 11.7};

std::optional<Eigen::VectorXd> mean(std::span<const int> times) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < times.size(); ++i) {
        sum += times[i] * sample[i];
        count += times[i];
    }
    return Eigen::VectorXd::Constant(1, sum / count);
}

TEST(Bootstrap, LimitsAgreeWithR) {
    // boot::boot(x, function(d, i) mean(d[i]), R = 99999); boot.ci(type = c("perc", "bca"))
    const auto found = bootstrap(10, mean, {.samples = 99999});
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->estimate(0), 2.99, 1e-12);
    EXPECT_NEAR(found->standardErrors(0), 1.0639, 0.01);
    EXPECT_NEAR(found->percentile[0].low, 1.25, 0.03);
    EXPECT_NEAR(found->percentile[0].high, 5.33, 0.05);
    ASSERT_TRUE(found->bca);
    EXPECT_NEAR((*found->bca)[0].low, 1.51, 0.03);
    EXPECT_NEAR((*found->bca)[0].high, 6.17, 0.06);
}

TEST(Bootstrap, DependsOnTheSeedAloneNotOnThreads) {
    const auto one = bootstrap(10, mean, {.samples = 500, .seed = 3, .threads = 1});
    const auto four = bootstrap(10, mean, {.samples = 500, .seed = 3, .threads = 4});
    const auto other = bootstrap(10, mean, {.samples = 500, .seed = 4});
    EXPECT_EQ(one->percentile[0].low, four->percentile[0].low);
    EXPECT_EQ((*one->bca)[0].high, (*four->bca)[0].high);
    EXPECT_NE(one->percentile[0].low, other->percentile[0].low);
}

// 24 people compare four items once each way of the six pairs; answers from given values.
std::vector<Wins> people(int count, std::uint64_t seed) {
    Random random(seed, "people");
    const double values[] = {0, 0.3, 0.9, 1.1};
    std::vector<Wins> result;
    for (int person = 0; person < count; ++person) {
        Wins& wins = result.emplace_back(Wins::Zero(4, 4));
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < i; ++j) {
                const double p =
                    distribution(Link::probit, jodUnit * (values[i] - values[j])).below;
                const bool isFirst = random.uniform() < p;
                wins(isFirst ? i : j, isFirst ? j : i) += 1;
            }
    }
    return result;
}

std::optional<Bootstrap> ofScale(const std::vector<Wins>& observers, int samples) {
    const auto statistic = [&](std::span<const int> times) -> std::optional<Eigen::VectorXd> {
        const auto scale = thurstone(pooled(observers, times));
        if (!scale)
            return std::nullopt;
        return relativeTo(*scale, 0).values;
    };
    return bootstrap(static_cast<int>(observers.size()), statistic, {.samples = samples});
}

TEST(Bootstrap, ErrorsOfAScaleAreThoseOfTheLikelihoodWhenVotesAreIndependent) {
    const auto observers = people(60, 1);
    const auto found = ofScale(observers, 1000);
    ASSERT_TRUE(found);
    const Wins all = pooled(observers, std::vector<int>(60, 1));
    const Scale scale = relativeTo(thurstone(all).value(), 0);
    for (int item = 1; item < 4; ++item) {
        const double error = standardErrors(scale)(item);
        EXPECT_NEAR(found->standardErrors(item), error, 0.3 * error) << item;
        EXPECT_LT(found->percentile[static_cast<std::size_t>(item)].low, scale.values(item));
        EXPECT_GT(found->percentile[static_cast<std::size_t>(item)].high, scale.values(item));
    }
    EXPECT_EQ(found->percentile[0].low, 0) << "the reference does not vary";
    EXPECT_EQ((*found->bca)[0].high, 0);
    EXPECT_EQ(found->failed, 0);
}

TEST(Bootstrap, SeesThatAPersonsVotesDepend) {
    // Each answers the same pair nine times over, always alike: there are 20 votes, not 180.
    std::vector<Wins> observers;
    for (int person = 0; person < 20; ++person)
        observers.push_back(person < 12 ? square({0, 9, 0, 0}) : square({0, 0, 9, 0}));
    const auto found = bootstrap(20,
                                 [&](std::span<const int> times) -> std::optional<Eigen::VectorXd> {
                                     const Wins wins = pooled(observers, times);
                                     return Eigen::VectorXd::Constant(1, wins(0, 1) / wins.sum());
                                 },
                                 {.samples = 4000});
    EXPECT_NEAR(found->standardErrors(0), std::sqrt(0.6 * 0.4 / 20), 0.006);
}

TEST(Bootstrap, SaysWhenTheScaleIsNotThereInManySamples) {
    // One person alone ever preferred item 0; without that person its place is not finite.
    std::vector<Wins> observers(10, square({0, 0, 1, 0}));
    observers[4] = square({0, 1, 0, 0});
    EXPECT_FALSE(ofScale(observers, 500));
    EXPECT_FALSE(ofScale(std::vector<Wins>(10, square({0, 0, 1, 0})), 500));
}

TEST(Bootstrap, OneWhoCannotBeLeftOutLeavesThePercentiles) {
    // The statistic needs observer 0 or nearly nobody else misses it.
    const auto statistic = [](std::span<const int> times) -> std::optional<Eigen::VectorXd> {
        int missing = 0;
        for (const int t : times)
            missing += t == 0 ? 1 : 0;
        if (times[0] == 0 && missing == 1)
            return std::nullopt;
        return Eigen::VectorXd::Constant(1, times[0]);
    };
    const auto found = bootstrap(30, statistic, {.samples = 300});
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->bca);
}

TEST(Bootstrap, RefusesWhatItCannotDrawFrom) {
    EXPECT_THROW(bootstrap(1, mean), Error);
    EXPECT_THROW(bootstrap(10, mean, {.samples = 10}), Error);
    EXPECT_THROW(bootstrap(10, mean, {.confidence = 1}), Error);
    EXPECT_THROW(pooled({}, {}), Error);
}

} // namespace
} // namespace obscura
