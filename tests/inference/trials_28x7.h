#pragma once

#include "inference/glm.h"

#include <string_view>
#include <vector>

namespace obscura {

// The made-up study of 28 people and the seven conditions of the thesis (shared
// golden/trials_2afc_28x7.csv): of each person, by condition, which member was shown second and
// whether the second-named technique (B) was chosen.
struct Participant {
    std::string_view second, choseB;
};
inline constexpr Participant participants28[] = {
    {"BABABAB", "0110100"}, {"BABABAB", "0011101"}, {"BABABAB", "1011111"}, {"BABABAB", "1110011"},
    {"BABABAB", "0110101"}, {"BABABAB", "0001100"}, {"BABABAB", "1010101"}, {"ABABABA", "1010010"},
    {"ABABABA", "0101111"}, {"ABABABA", "0101110"}, {"ABABABA", "1111111"}, {"ABABABA", "1111101"},
    {"ABABABA", "1011100"}, {"ABABABA", "1001100"}, {"BABABAB", "0100100"}, {"BABABAB", "0000100"},
    {"BABABAB", "1111001"}, {"BABABAB", "1111100"}, {"BABABAB", "1110101"}, {"BABABAB", "0110100"},
    {"BABABAB", "1010111"}, {"ABABABA", "0001100"}, {"ABABABA", "1011100"}, {"ABABABA", "1110111"},
    {"ABABABA", "1010110"}, {"ABABABA", "1110010"}, {"ABABABA", "0110011"}, {"ABABABA", "1101111"},
};

struct Study {
    BinomialData data;
    std::vector<int> person;
};

// Rows of the conditions given (1 to 7), person by person; columns: one for each condition, then
// the position (+1/2 where B came second).
inline Study trials28x7(const std::vector<int>& conditions) {
    const auto columns = static_cast<Eigen::Index>(conditions.size());
    const auto rows = static_cast<Eigen::Index>(std::size(participants28)) * columns;
    Study study{.data = {.design = Eigen::MatrixXd::Zero(rows, columns + 1),
                         .successes = Eigen::VectorXd(rows),
                         .trials = Eigen::VectorXd::Ones(rows)},
                .person = {}};
    Eigen::Index row = 0;
    for (int person = 0; const Participant& participant : participants28) {
        for (Eigen::Index column = 0; column < columns; ++column, ++row) {
            const auto at =
                static_cast<std::size_t>(conditions[static_cast<std::size_t>(column)] - 1);
            study.data.design(row, column) = 1;
            study.data.design(row, columns) = participant.second[at] == 'B' ? 0.5 : -0.5;
            study.data.successes[row] = participant.choseB[at] - '0';
            study.person.push_back(person);
        }
        ++person;
    }
    return study;
}

// The same with one intercept in place of the conditions.
inline Study withoutConditions(Study study) {
    const Eigen::Index last = study.data.design.cols() - 1;
    study.data.design.col(0).setOnes();
    study.data.design.col(1) = study.data.design.col(last).eval();
    study.data.design.conservativeResize(Eigen::NoChange, 2);
    return study;
}

} // namespace obscura
