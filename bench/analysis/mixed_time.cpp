// obscura-mixed-time FILE POINTS: the time that fitMixed takes for the rows of make_mixed.R, as
// mixed.R prints glmer's: CPU seconds, seconds, sd between people, effect of the position, of the
// fifth condition.

#include "base/csv.h"
#include "base/error.h"

#include "inference/mixed.h"
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <ctime>

namespace obscura {

namespace {

constexpr int conditions = 7;

struct Rows {
    BinomialData data;
    std::vector<int> person; // from 0
};

double numberIn(const CsvRecord& record, std::size_t cell) {
    double number = 0;
    if (cell >= record.cells.size() || !readCell(record.cells[cell], number))
        throw Error(fmt::format("expected a number in line {}, cell {}", record.line, cell + 1));
    return number;
}

Rows readRows(const std::filesystem::path& path) {
    std::vector<std::array<double, 4>> cells; // person, condition, position, chosen
    CsvReader reader(path);
    CsvRecord record;
    reader.next(record); // the header
    while (reader.next(record))
        cells.push_back(
            {numberIn(record, 0), numberIn(record, 1), numberIn(record, 2), numberIn(record, 3)});
    const auto count = static_cast<Eigen::Index>(cells.size());
    Rows rows;
    rows.data.design.setZero(count, conditions + 1);
    rows.data.successes.resize(count);
    rows.data.trials.setOnes(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const auto& [person, condition, position, chosen] = cells[static_cast<std::size_t>(i)];
        rows.person.push_back(static_cast<int>(person) - 1);
        rows.data.design(i, static_cast<Eigen::Index>(condition) - 1) = 1;
        rows.data.design(i, conditions) = position;
        rows.data.successes[i] = chosen;
    }
    return rows;
}

int timeMixed(int argc, char** argv) {
    int points = 0;
    if (argc != 3 || !readCell(argv[2], points))
        throw Error("expected a file and the number of points, such as mixed.csv 15");
    const Rows rows = readRows(argv[1]);
    const std::clock_t cpu = std::clock();
    const auto start = std::chrono::steady_clock::now();
    const MixedFit fit = fitMixed(rows.data, rows.person, {.points = points});
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    fmt::print("{:.3f} {:.3f} {:.6f} {:.6f} {:.6f}\n",
               static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC, wall.count(), fit.sd,
               fit.coefficients[conditions], fit.coefficients[4]);
    return 0;
}

} // namespace

} // namespace obscura

int main(int argc, char** argv) {
    return obscura::runProgram("obscura-mixed-time", obscura::timeMixed, argc, argv);
}
