#include "base/error.h"
#include "base/random.h"
#include "tests/inference/matrices.h"

#include "inference/link.h"
#include "inference/observers.h"

namespace obscura {
namespace {

// Three observers who saw the six orders of three items twice; the second leans to the first.
std::vector<Choice> small() {
    const int firsts[] = {0, 1, 0, 2, 1, 2}, seconds[] = {1, 0, 2, 0, 2, 1};
    const int answers[] = {0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1,
                           0, 1, 1, 1, 1, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 0};
    std::vector<Choice> choices;
    for (int i = 0; i < 36; ++i)
        choices.push_back({i / 12, firsts[i % 6], seconds[i % 6], answers[i] == 1});
    return choices;
}

TEST(Observers, AreThePosteriorsMode) {
    // R 4.2.2, optim(BFGS, reltol 1e-16, ndeps 1e-5) and optimHess of the formula in observers.h
    const auto model = observerModel(3, 3, small(), {.logPrecisionSd = 0.5, .logitLapseSd = 1.5});
    ASSERT_TRUE(model);
    expectNear(model->scale.values, {-0.8074218, 0.3484358, 0.4589859}, 2e-5);
    EXPECT_NEAR(difference(model->scale, 0, 1).standardError, 0.632387, 2e-4);
    EXPECT_NEAR(model->logPosterior, -19.0779660855, 1e-8);
    const double bias[] = {0.2565386, 1.1188473, -0.2166870};
    const double precision[] = {1.6702785, 0.8647392, 0.7115358};
    const double lapse[] = {0.02405626, 0.02479486, 0.03259673};
    const double biasError[] = {0.5153394, 0.5017917, 0.4743833};
    const double logPrecisionError[] = {0.4614084, 0.4434565, 0.4404046};
    const double logitLapseError[] = {1.3727885, 1.3903140, 1.5838914};
    for (std::size_t o = 0; o < 3; ++o) {
        const ObserverTraits& found = model->observers[o];
        EXPECT_NEAR(found.bias.value, bias[o], 2e-5);
        EXPECT_NEAR(found.bias.standardError, biasError[o], 2e-4);
        EXPECT_NEAR(found.precision.value, precision[o], 2e-5);
        EXPECT_NEAR(found.precision.standardError / found.precision.value, logPrecisionError[o],
                    2e-4);
        EXPECT_NEAR(found.lapse.value, lapse[o], 2e-6);
        EXPECT_NEAR(found.lapse.standardError, lapse[o] * (1 - lapse[o]) * logitLapseError[o],
                    1e-5);
    }
}

struct Simulated {
    double bias, lapse, precision;
};

// Everybody sees all ordered pairs of six items, `rounds` times.
std::vector<Choice> simulate(const std::vector<Simulated>& people, int rounds) {
    Random random(7, "observers");
    std::vector<Choice> choices;
    for (int o = 0; o < static_cast<int>(people.size()); ++o)
        for (int trial = 0; trial < rounds * 36; ++trial) {
            const int first = trial % 6, second = trial / 6 % 6;
            if (first == second)
                continue;
            const Simulated& person = people[static_cast<std::size_t>(o)];
            const double x = person.precision * 0.6 * (first - second) + person.bias;
            const double p =
                random.uniform() < person.lapse ? 0.5 : distribution(Link::logit, x).below;
            choices.push_back({o, first, second, random.uniform() < p});
        }
    return choices;
}

TEST(Observers, BiasLapsesAndPrecisionAreFound) {
    std::vector<Simulated> people(20, {0, 0.01, 1});
    people[3] = {1.5, 0.01, 1};
    people[8] = {0, 0.9, 1};
    people[12] = {0, 0.01, 0.3};
    people[16] = {-1, 0.01, 2};
    const auto model = observerModel(6, 20, simulate(people, 6));
    ASSERT_TRUE(model);
    EXPECT_NEAR(model->observers[3].bias.value, 1.5, 0.6);
    EXPECT_NEAR(model->observers[16].bias.value, -1, 0.6);
    EXPECT_GT(model->observers[8].lapse.value, 0.4);
    const ObserverTraits& dull = model->observers[12]; // lapses explain some of it
    EXPECT_LT(dull.precision.value * (1 - dull.lapse.value), 0.55);
    EXPECT_LT(dull.precision.value, 0.9);
    EXPECT_GT(model->observers[16].precision.value, 1.4);
    for (const std::size_t honest : {0, 1, 2, 5, 19}) {
        EXPECT_LT(std::abs(model->observers[honest].bias.value), 0.6) << honest;
        EXPECT_LT(model->observers[honest].lapse.value, 0.15) << honest;
    }
    for (int i = 0; i < 6; ++i)
        EXPECT_NEAR(model->scale.values(i), 0.6 * (i - 2.5), 0.25) << i;
}

TEST(Observers, WhoGuessesWeighsLittle) {
    std::vector<Simulated> people(10, {0, 0.01, 1});
    const auto without = observerModel(6, 10, simulate(people, 3));
    people.resize(14, {0, 1, 1});
    const auto choices = simulate(people, 3);
    const auto with = observerModel(6, 14, choices);
    Wins wins = Wins::Zero(6, 6);
    for (const Choice& c : choices)
        wins(c.choseFirst ? c.first : c.second, c.choseFirst ? c.second : c.first) += 1;
    const auto range = [](const Eigen::VectorXd& v) { return v.maxCoeff() - v.minCoeff(); };
    const double honest = range(without->scale.values);
    EXPECT_LT(range(bradleyTerry(wins)->values), 0.8 * honest) << "guesses shrink the plain scale";
    EXPECT_NEAR(range(with->scale.values), honest, 0.1 * honest);
}

TEST(Observers, WithoutAnswersKeepTheirPriors) {
    const auto model = observerModel(3, 4, small());
    ASSERT_TRUE(model);
    const ObserverTraits& silent = model->observers[3];
    EXPECT_NEAR(silent.bias.value, 0, 1e-9);
    EXPECT_NEAR(silent.bias.standardError, 0.7, 1e-9);
    EXPECT_NEAR(silent.precision.value, 1, 1e-9);
    EXPECT_NEAR(silent.lapse.value, 1 / (1 + std::exp(3.5)), 1e-9);
    EXPECT_TRUE(model->scale.values.isApprox(observerModel(3, 3, small())->scale.values, 1e-8));
}

TEST(Observers, UnanimousAnswersStayFinite) {
    std::vector<Choice> choices;
    for (int o = 0; o < 5; ++o)
        for (int i = 0; i < 8; ++i)
            choices.push_back({o, i % 2, 1 - i % 2, i % 2 == 0});
    const auto model = observerModel(2, 5, choices);
    ASSERT_TRUE(model);
    EXPECT_GT(model->scale.values(0), 0.5);
    EXPECT_LT(model->scale.values(0), 10);
    EXPECT_FALSE(observerModel(3, 5, choices)) << "item 2 was never shown";
}

TEST(Observers, ManyPeopleAreFitted) {
    const std::vector<Simulated> people(1000, {0.2, 0.05, 1});
    const auto model = observerModel(6, 1000, simulate(people, 1));
    ASSERT_TRUE(model);
    for (int i = 0; i < 6; ++i)
        EXPECT_NEAR(model->scale.values(i), 0.6 * (i - 2.5), 0.15) << i;
}

TEST(Observers, RefuseChoicesOfOthers) {
    EXPECT_THROW(observerModel(2, 1, std::vector<Choice>{{1, 0, 1, true}}), Error);
    EXPECT_THROW(observerModel(2, 1, std::vector<Choice>{{0, 1, 1, true}}), Error);
    EXPECT_THROW(observerModel(2, 1, std::vector<Choice>{{0, 0, 2, true}}), Error);
    EXPECT_THROW(observerModel(1, 1, {}), Error);
    EXPECT_THROW(observerModel(2, 1, small(), {.biasSd = 0}), Error);
}

} // namespace
} // namespace obscura
