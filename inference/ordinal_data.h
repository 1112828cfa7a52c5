#pragma once

#include <Eigen/Core>

#include <vector>

namespace obscura {

// Ratings in ordered categories by a cumulative link: P(category <= k) = F(threshold k - design x
// coefficients), F the link's distribution (McCullagh, J. R. Stat. Soc. B 42 (1980) 109). So a
// positive coefficient means higher categories.
struct OrdinalData {
    Eigen::MatrixXd design;    // rows x coefficients, without an intercept; may have no column
    std::vector<int> category; // 0, 1, ... each used at least once
};

} // namespace obscura
