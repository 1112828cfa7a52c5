#pragma once

#include "inference/glm.h"

#include <span>
#include <vector>

namespace obscura {

// The rows of a regression by person: those of person i are first[i] ... first[i + 1] - 1, and
// equal rows (design and offset) of a person are one row with more trials. The likelihood is the
// same but for binomial coefficients.
struct PersonRows {
    BinomialData data;
    std::vector<Eigen::Index> first; // persons + 1
    int persons() const { return static_cast<int>(first.size()) - 1; }
};

// `person` numbers each row's person from 0; a number may have no row. Error when there is not one
// for each row or one is negative.
PersonRows groupByPerson(const BinomialData& data, std::span<const int> person);

// The numbers of the rows, those of person 0 first, in the order given; and where each person's
// begin. Errors as above.
struct PersonOrder {
    std::vector<Eigen::Index> rows, first;
};
PersonOrder orderByPerson(std::span<const int> person, Eigen::Index rows);

} // namespace obscura
