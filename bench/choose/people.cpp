#include "bench/choose/people.h"

#include "base/csv.h"
#include "base/error.h"
#include "base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace obscura {

namespace {

namespace fs = std::filesystem;

const std::vector<std::string> columns = {"scene",         "level",      "technique", "name",
                                          "milliseconds",  "jod_people", "low",       "high",
                                          "jod_predicted", "rmse"};

double numberIn(const CsvRecord& record, std::size_t column, const std::string& file,
                double unknown) {
    const std::string& cell = record.cells[column];
    double number = unknown;
    if (!cell.empty() && !readCell(cell, number))
        throw Error({file, record.line, 0, columns[column]},
                    fmt::format("expected a number, or nothing, found \"{}\"", cell));
    return number;
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                 endless = std::numeric_limits<double>::infinity();

// What is known of one scene and level, in words, and the JOD that suffice there.
PeopleLimit limitIn(const std::string& where, std::vector<PeopleRung> rungs, double margin) {
    std::erase_if(rungs, [](const PeopleRung& rung) {
        return rung.technique == "ray_traced" || std::isnan(rung.milliseconds + rung.predicted);
    });
    std::stable_sort(rungs.begin(), rungs.end(), [](const PeopleRung& a, const PeopleRung& b) {
        return a.milliseconds < b.milliseconds;
    });
    const auto found = std::find_if(rungs.begin(), rungs.end(),
                                    [&](const PeopleRung& rung) { return rung.high >= -margin; });
    if (found == rungs.end())
        throw Error(fmt::format("expected with --people a technique that people do not see as "
                                "worse than the ray-traced image by more than {:g} JOD in {}, "
                                "found none; allow more by --margin",
                                margin, where));
    const double jod = found->predicted;
    std::string words = fmt::format(
        "  {}: {} ({:.3g} ms) is the cheapest that people do not place more than {:g} JOD below "
        "the ray-traced image: {:+.2f}, 95 % interval {:+.2f} to {:+.2f}; predicted are {:.2f}\n",
        where, found->name, found->milliseconds, margin, found->people, found->low, found->high,
        jod);
    if (!(found->low >= -margin))
        words += fmt::format(
            "    They may place it {:.2f} below, though: more people would tell.\n", -found->low);
    return {jod, words};
}

} // namespace

std::vector<PeopleRung> readPeople(const fs::path& folder) {
    const std::string file = (folder / "ladder.csv").string();
    const std::string text = readFile(folder / "ladder.csv");
    checkIsCsv(text, file);
    CsvReader reader{std::string_view(text)};
    CsvRecord record;
    std::vector<PeopleRung> rungs;
    if (!reader.next(record))
        throw Error({file, 0, 0, {}}, "expected a table from obscura-analysis, found nothing");
    checkHeader(record, columns, file);
    while (reader.next(record)) {
        if (isBlank(record))
            continue;
        if (const std::string fault = faultOf(record, columns.size()); !fault.empty())
            throw Error({file, record.line, 0, {}}, fault);
        const auto number = [&](std::size_t column, double unknown = nan) {
            return numberIn(record, column, file, unknown);
        };
        rungs.push_back({record.cells[0], record.cells[1], record.cells[2], record.cells[3],
                         number(4), number(5), number(6, -endless), number(7, endless), number(8)});
    }
    if (rungs.empty())
        throw Error({file, 0, 0, {}}, "expected rungs of a ladder study, found none");
    return rungs;
}

PeopleLimit limitOf(const std::vector<PeopleRung>& rungs, double margin) {
    std::map<std::string, std::vector<PeopleRung>> byPlace;
    for (const PeopleRung& rung : rungs)
        byPlace[rung.scene + ", " + rung.level].push_back(rung);
    PeopleLimit limit;
    for (auto& [where, some] : byPlace) {
        PeopleLimit here = limitIn(where, std::move(some), margin);
        limit.jod = std::max(limit.jod, here.jod);
        limit.words += here.words;
    }
    return limit;
}

} // namespace obscura
