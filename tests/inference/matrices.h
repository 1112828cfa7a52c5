#pragma once

#include "inference/scales.h"
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace obscura {

// A square matrix from its rows.
inline Eigen::MatrixXd square(const std::vector<double>& rows) {
    const auto size = static_cast<Eigen::Index>(std::lround(std::sqrt(rows.size())));
    return Eigen::Map<const Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(rows.data(), size,
                                                                            size);
}

inline void expectNear(const Eigen::VectorXd& found, const std::vector<double>& expected,
                       double tolerance) {
    ASSERT_EQ(found.size(), static_cast<Eigen::Index>(expected.size()));
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(found(static_cast<Eigen::Index>(i)), expected[i], tolerance) << i;
}

inline Eigen::VectorXd standardErrors(const Scale& scale) {
    return scale.covariance.diagonal().cwiseMax(0).cwiseSqrt();
}

inline std::vector<std::vector<int>> sets(std::vector<std::vector<int>> list) { return list; }

} // namespace obscura
