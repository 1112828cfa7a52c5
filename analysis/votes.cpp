#include "analysis/votes.h"

#include "base/csv.h"
#include "base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <map>

namespace obscura {

namespace {

// Conditions of one level follow each other; the levels keep their order of first appearance.
void groupByLevel(std::vector<Tally>& tallies) {
    std::map<std::string, int> rank;
    for (const Tally& tally : tallies)
        rank.try_emplace(tally.level, static_cast<int>(rank.size()));
    std::stable_sort(tallies.begin(), tallies.end(), [&](const Tally& x, const Tally& y) {
        return rank.at(x.level) < rank.at(y.level);
    });
}

Tally emptyTally(const PairRecord& pair) {
    return {pair.condition, pair.level, pair.view, pair.hypothesis, pair.a.name, pair.b.name, {}};
}

Tally emptyTally(const Response& row) {
    return {row.conditionId, row.level,      row.scene, row.hypothesis,
            row.techniqueA,  row.techniqueB, {}};
}

std::vector<Tally> emptyTallies(const std::vector<Answer>& answers) {
    std::map<std::string, Tally> byId;
    for (const Answer& answer : answers)
        byId.try_emplace(answer.row.conditionId, emptyTally(answer.row));
    std::vector<Tally> tallies;
    for (const auto& [id, tally] : byId)
        tallies.push_back(tally);
    return tallies;
}

std::string pairOf(const Tally& tally) {
    return fmt::format("{} / {} on {}, {}{}{}", tally.techniqueA, tally.techniqueB, tally.scene,
                       tally.level, tally.hypothesis.empty() ? "" : ", ", tally.hypothesis);
}

[[noreturn]] void fail(const Answer& answer, std::string_view column, const std::string& message) {
    throw Error({answer.place.file, answer.place.line, 0, std::string(column)}, message);
}

Tally& tallyOf(const Answer& answer, std::vector<Tally>& tallies) {
    const std::string& id = answer.row.conditionId;
    const auto tally = std::find_if(tallies.begin(), tallies.end(),
                                    [&](const Tally& t) { return t.condition == id; });
    if (tally == tallies.end()) {
        std::vector<std::string> ids;
        for (const Tally& known : tallies)
            ids.push_back(known.condition);
        fail(answer, "condition_id",
             fmt::format("the stimuli have no condition \"{}\"{}", id, suggestion(id, ids)));
    }
    if (const Tally found = emptyTally(answer.row); pairOf(found) != pairOf(*tally))
        fail(answer, "condition_id",
             fmt::format("expected condition \"{}\" to compare {}, found {}", id, pairOf(*tally),
                         pairOf(found)));
    return *tally;
}

// What participants saw must be what the report shows.
void checkImages(const Answer& answer, const Manifest& stimuli) {
    const Response& row = answer.row;
    const auto pair =
        std::find_if(stimuli.pairs.begin(), stimuli.pairs.end(),
                     [&](const PairRecord& p) { return p.condition == row.conditionId; });
    assert(pair != stimuli.pairs.end()); // tallyOf() has looked it up
    const bool aFirst = row.firstIs == "a";
    if (row.sha256First != (aFirst ? pair->a : pair->b).image.sha256)
        fail(answer, "sha256_first", "the image shown is not the one in the stimuli's manifest");
    if (row.sha256Second != (aFirst ? pair->b : pair->a).image.sha256)
        fail(answer, "sha256_second", "the image shown is not the one in the stimuli's manifest");
}

constexpr std::array<std::string_view, 8> countColumns = {
    "condition_id", "level", "scene", "tech_a", "tech_b", "hypothesis", "votes_a", "votes_b"};

constexpr std::int64_t mostVotes = 1'000'000'000'000; // sums of a file stay far within 64 bits

std::int64_t voteCount(const std::string& cell, const Place& place) {
    std::int64_t count = 0;
    if (!readCell(cell, count) || count < 0 || count > mostVotes)
        throw Error(place, fmt::format("expected a whole number from 0 to {}, found \"{}\"",
                                       mostVotes, cell));
    return count;
}

Tally countsOf(const CsvRecord& record, const std::string& file) {
    const auto place = [&](int column) {
        return Place{file, record.line, column, std::string(countColumns.at(column - 1))};
    };
    const auto& cells = record.cells;
    for (int column = 1; column <= 5; ++column)
        if (cells[column - 1].empty())
            throw Error(place(column), "expected text, found nothing");
    return {cells[0],
            cells[1],
            cells[2],
            cells[5],
            cells[3],
            cells[4],
            {voteCount(cells[6], place(7)), voteCount(cells[7], place(8))}};
}

void checkCells(const CsvRecord& record, const std::string& file) {
    const Place place{file, record.line, 0, {}};
    if (!record.fault.empty())
        throw Error(place, record.fault);
    if (record.cells.size() != countColumns.size())
        throw Error(place, fmt::format("expected {} columns, found {}", countColumns.size(),
                                       record.cells.size()));
}

} // namespace

std::vector<Tally> tallyVotes(const std::vector<Answer>& answers, const Manifest* stimuli) {
    std::vector<Tally> tallies;
    if (stimuli)
        for (const PairRecord& pair : stimuli->pairs)
            tallies.push_back(emptyTally(pair));
    else
        tallies = emptyTallies(answers);
    for (const Answer& answer : answers) {
        Votes& votes = tallyOf(answer, tallies).votes;
        if (stimuli)
            checkImages(answer, *stimuli);
        ++(answer.row.choseB ? votes.b : votes.a);
    }
    groupByLevel(tallies);
    return tallies;
}

std::vector<Tally> readCounts(const std::filesystem::path& path) {
    const std::string file = path.string();
    const std::string text = readFile(path);
    checkIsCsv(text, file);
    const std::vector<CsvRecord> records = splitCsv(text);
    if (records.size() < 2 || !std::ranges::equal(records.front().cells, countColumns))
        throw Error({file, 1, 0, {}}, fmt::format("expected the header {} and a line for each "
                                                  "condition",
                                                  fmt::join(countColumns, ",")));
    std::vector<Tally> tallies;
    for (const CsvRecord& record : std::span(records).subspan(1)) {
        checkCells(record, file);
        Tally tally = countsOf(record, file);
        for (const Tally& earlier : tallies)
            if (earlier.condition == tally.condition)
                throw Error({file, record.line, 1, std::string(countColumns[0])},
                            fmt::format("condition \"{}\" stands here twice", tally.condition));
        tallies.push_back(std::move(tally));
    }
    groupByLevel(tallies);
    return tallies;
}

} // namespace obscura
