#include "inference/person_rows.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numeric>

namespace obscura {

namespace {

using Eigen::Index;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// What makes rows equal: design and offset, side by side. Adding 0 makes -0 equal 0.
RowMajor keysOf(const BinomialData& data) {
    RowMajor keys = RowMajor::Zero(data.design.rows(), data.design.cols() + 1);
    keys.leftCols(data.design.cols()) = data.design.array() + 0.0;
    if (data.offset.size() > 0)
        keys.rightCols(1) = data.offset.array() + 0.0;
    return keys;
}

std::uint64_t hash(const RowMajor& keys, Index row) {
    std::uint64_t result = 0xcbf29ce484222325u;
    for (Index j = 0; j < keys.cols(); ++j) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &keys(row, j), sizeof bits);
        result = (result ^ bits) * 0x9e3779b97f4a7c15u;
        result ^= result >> 29;
    }
    return result;
}

// Sorts each person's rows by their hash, so that equal ones are neighbours. Two kinds of rows with
// the same hash may alternate; then they are only grouped less.
void sortWithinPersons(PersonOrder& order, const RowMajor& keys) {
    std::vector<std::uint64_t> hashes(order.rows.size());
    for (std::size_t i = 0; i < hashes.size(); ++i)
        hashes[i] = hash(keys, static_cast<Index>(i));
    for (std::size_t i = 0; i + 1 < order.first.size(); ++i)
        std::stable_sort(order.rows.begin() + order.first[i],
                         order.rows.begin() + order.first[i + 1], [&](Index a, Index b) {
                             return hashes[static_cast<std::size_t>(a)] <
                                    hashes[static_cast<std::size_t>(b)];
                         });
}

void keep(BinomialData& data, const std::vector<Index>& rows) {
    const BinomialData all = data;
    data.design = all.design(rows, Eigen::all);
    if (all.offset.size() > 0)
        data.offset = all.offset(rows);
}

} // namespace

PersonOrder orderByPerson(std::span<const int> person, Index rows) {
    if (static_cast<Index>(person.size()) != rows)
        throw Error(
            fmt::format("expected a person for each of {} rows, found {}", rows, person.size()));
    if (!person.empty() && *std::min_element(person.begin(), person.end()) < 0)
        throw Error("people are numbered from 0");
    const int persons = person.empty() ? 0 : *std::max_element(person.begin(), person.end()) + 1;
    PersonOrder order{.rows = std::vector<Index>(person.size()),
                      .first = std::vector<Index>(static_cast<std::size_t>(persons) + 1, 0)};
    for (const int i : person)
        ++order.first[static_cast<std::size_t>(i) + 1];
    std::partial_sum(order.first.begin(), order.first.end(), order.first.begin());
    std::vector<Index> next = order.first;
    for (std::size_t row = 0; row < person.size(); ++row)
        order.rows[static_cast<std::size_t>(next[static_cast<std::size_t>(person[row])]++)] =
            static_cast<Index>(row);
    return order;
}

PersonRows groupByPerson(const BinomialData& data, std::span<const int> person) {
    PersonOrder order = orderByPerson(person, data.design.rows());
    const RowMajor keys = keysOf(data);
    sortWithinPersons(order, keys);
    PersonRows result{.data = data, .first = {0}};
    std::vector<Index> kept;
    std::vector<double> successes, trials;
    for (std::size_t i = 0; i + 1 < order.first.size(); ++i) {
        for (Index j = order.first[i]; j < order.first[i + 1]; ++j) {
            const Index row = order.rows[static_cast<std::size_t>(j)];
            if (data.trials[row] <= 0)
                continue;
            const bool opens = static_cast<Index>(kept.size()) == result.first.back();
            if (opens || keys.row(kept.back()) != keys.row(row)) {
                kept.push_back(row);
                successes.push_back(0);
                trials.push_back(0);
            }
            successes.back() += data.successes[row];
            trials.back() += data.trials[row];
        }
        result.first.push_back(static_cast<Index>(kept.size()));
    }
    keep(result.data, kept);
    const auto size = static_cast<Index>(kept.size());
    result.data.successes = Eigen::VectorXd::Map(successes.data(), size);
    result.data.trials = Eigen::VectorXd::Map(trials.data(), size);
    return result;
}

} // namespace obscura
