#include "inference/link.h"
#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

// R 4.2.2: pnorm(x, log.p = TRUE), pnorm(x, lower = FALSE, log.p = TRUE), and the same of plogis.
TEST(Link, LogTailsEqualR) {
    struct Row {
        double x, normalBelow, normalAbove, logisticBelow, logisticAbove;
    };
    const Row rows[] = {
        {-40, -804.6084420137538, 0, -40, -4.2483542552915889e-18},
        {-8, -35.013437159914552, -6.2209605742717868e-16, -8.000335406372896,
         -0.00033540637289576885},
        {-0.7, -1.4189677615315315, -0.27702394227713117, -1.1031860488854579,
         -0.40318604888545789},
        {0, -0.69314718055994529, -0.69314718055994529, -0.69314718055994529, -0.69314718055994529},
        {3, -0.0013508099647481938, -6.6077262215103492, -0.048587351573742062,
         -3.0485873515737421},
        {25, -3.0566967063825616e-138, -316.63940800802027, -1.3887943864867583e-11,
         -25.000000000013888},
    };
    const auto expectRelative = [](double found, double expected) {
        EXPECT_NEAR(found, expected, 1e-12 * std::abs(expected)) << expected;
    };
    for (const Row& row : rows) {
        const LogTails normal = logTails(Link::probit, row.x);
        const LogTails logistic = logTails(Link::logit, row.x);
        expectRelative(normal.below, row.normalBelow);
        expectRelative(normal.above, row.normalAbove);
        expectRelative(logistic.below, row.logisticBelow);
        expectRelative(logistic.above, row.logisticAbove);
    }
}

// Every derivative against the central difference of the one before it.
TEST(Link, DerivativesAreThoseOfTheFunctions) {
    const double h = 1e-5;
    for (const Link link : {Link::logit, Link::probit})
        for (const double x : {-6.0, -1.3, 0.0, 0.2, 4.0}) {
            const Distribution at = distribution(link, x);
            const Distribution low = distribution(link, x - h), high = distribution(link, x + h);
            EXPECT_NEAR(at.below + at.above, 1, 1e-15);
            EXPECT_NEAR(at.density, (high.below - low.below) / (2 * h), 1e-10);
            EXPECT_NEAR(at.slope, (high.density - low.density) / (2 * h), 1e-10);
            EXPECT_NEAR(at.curvature, (high.slope - low.slope) / (2 * h), 1e-10);
            const Evidence e = evidence(link, x, 2, 7), below = evidence(link, x - h, 2, 7),
                           above = evidence(link, x + h, 2, 7);
            EXPECT_NEAR(e.slope, (above.value - below.value) / (2 * h), 1e-7);
            EXPECT_NEAR(e.curvature, (above.slope - below.slope) / (2 * h), 1e-7);
            EXPECT_NEAR(e.informationSlope, (above.information - below.information) / (2 * h),
                        1e-7);
            const double p = at.below;
            EXPECT_NEAR(e.information, 7 * at.density * at.density / (p * (1 - p)), 1e-7);
        }
}

TEST(Link, TailsStayFinite) {
    for (const Link link : {Link::logit, Link::probit})
        for (const double x : {-1e6, -300.0, -38.5, -20.0, 20.0, 38.5, 300.0, 1e6}) {
            const Evidence e = evidence(link, x, 3, 8);
            EXPECT_TRUE(std::isfinite(e.value) && std::isfinite(e.slope) &&
                        std::isfinite(e.curvature) && std::isfinite(e.information) &&
                        std::isfinite(e.informationSlope))
                << x;
        }
}

TEST(Link, QuantileInvertsTheDistribution) {
    for (const Link link : {Link::logit, Link::probit})
        for (const double p : {1e-300, 0.01, 0.5, 0.75})
            EXPECT_NEAR(std::exp(logTails(link, quantile(link, p)).below), p, 1e-12 * p);
}

} // namespace
} // namespace obscura
