#include "analysis/votes.h"

#include "base/csv.h"
#include "base/files.h"
#include "protocols/reader/cell_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <map>
#include <set>
#include <unordered_map>

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

Tally emptyTally(const ConditionRecord& pair) {
    return {pair.condition,       pair.level,           pair.view, pair.hypothesis,
            pair.image("a").name, pair.image("b").name, {}};
}

Tally emptyTally(const Vote& row) {
    return {row.conditionId, row.level,      row.scene, row.hypothesis,
            row.techniqueA,  row.techniqueB, {}};
}

std::vector<Tally> emptyTallies(const std::vector<Answer>& answers,
                                const std::vector<std::string>& order) {
    std::set<std::uint32_t> known;
    std::vector<Tally> tallies;
    for (const Answer& answer : answers)
        if (known.insert(answer.row.conditionId.number()).second)
            tallies.push_back(emptyTally(answer.row));
    std::ranges::stable_sort(tallies, {}, [&](const Tally& tally) { // those not in it are last
        return std::find(order.begin(), order.end(), tally.condition) - order.begin();
    });
    return tallies;
}

std::string pairOf(const Tally& tally) {
    return fmt::format("{} / {} on {}, {}{}{}", tally.techniqueA, tally.techniqueB, tally.scene,
                       tally.level, tally.hypothesis.empty() ? "" : ", ", tally.hypothesis);
}

[[noreturn]] void fail(const Answer& answer, std::string_view column, const std::string& message) {
    throw Error(answer.place(column), message);
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
    const Vote& row = answer.row;
    const auto pair = std::find_if(
        stimuli.conditions.begin(), stimuli.conditions.end(),
        [&](const ConditionRecord& p) { return p.condition == row.conditionId.text(); });
    assert(pair != stimuli.conditions.end()); // tallyOf() has looked it up
    const bool a = row.sha256A.text() == pair->image("a").image.sha256;
    const bool b = row.sha256B.text() == pair->image("b").image.sha256;
    const char* why = "the image shown is not the one in the stimuli's manifest";
    if (!(row.aFirst ? a : b))
        fail(answer, "sha256_first", why);
    if (!(row.aFirst ? b : a))
        fail(answer, "sha256_second", why);
}

// All by which rows of one condition must be alike, and how to find the tally of the last such one.
using Alike = std::array<Symbol, 8>;
Alike alikeOf(const Vote& row) {
    return {row.conditionId, row.level,      row.scene,   row.hypothesis,
            row.techniqueA,  row.techniqueB, row.sha256A, row.sha256B};
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

// Where the columns of counts stand: published counts have these alone, and a table of this program
// has them by its own names among others.
using Layout = std::array<std::size_t, countColumns.size()>;

Layout layoutOf(const std::vector<std::string>& header, const std::string& file) {
    Layout layout{};
    const bool own = !header.empty() && header.front() == "source";
    if (std::find(header.begin(), header.end(), "participant_id") != header.end())
        throw Error({file, 1, 0, {}}, "expected a table of counted votes, found the rows of "
                                      "participants; give them without --counts");
    for (std::size_t i = 0; i < countColumns.size(); ++i) {
        std::string name(countColumns[i]);
        if (own && name.starts_with("tech_"))
            name.replace(0, 5, "technique_");
        layout[i] = static_cast<std::size_t>(std::find(header.begin(), header.end(), name) -
                                             header.begin());
        if (layout[i] == header.size() || (!own && layout[i] != i) ||
            (!own && header.size() != countColumns.size()))
            throw Error({file, 1, 0, {}},
                        fmt::format("expected the header {} and a line for each condition, or a "
                                    "table written by obscura-analysis",
                                    fmt::join(countColumns, ",")));
    }
    return layout;
}

Tally countsOf(const CsvRecord& record, const Layout& layout, const std::string& file) {
    const auto place = [&](std::size_t i) {
        return Place{file, record.line, static_cast<int>(layout[i]) + 1,
                     std::string(countColumns[i])};
    };
    const auto cell = [&](std::size_t i) { return record.cells[layout[i]]; };
    for (std::size_t i = 0; i < 6; ++i) {
        if (i < 5 && cell(i).empty())
            throw Error(place(i), "expected text, found nothing");
        for (const std::string& fault : {foreignByte(cell(i)), strayName(cell(i))})
            if (!fault.empty())
                throw Error(place(i), fault);
    }
    return {cell(0),
            cell(1),
            cell(2),
            cell(5),
            cell(3),
            cell(4),
            {voteCount(cell(6), place(6)), voteCount(cell(7), place(7))}};
}

void checkCells(const CsvRecord& record, std::size_t columns, const std::string& file) {
    const Place place{file, record.line, 0, {}};
    if (!record.fault.empty())
        throw Error(place, record.fault);
    if (record.cells.size() != columns)
        throw Error(place,
                    fmt::format("expected {} columns, found {}", columns, record.cells.size()));
}

} // namespace

std::vector<Tally> tallyVotes(const std::vector<Answer>& answers, const Manifest* stimuli,
                              const std::vector<std::string>& order) {
    std::vector<Tally> tallies;
    if (stimuli)
        for (const ConditionRecord& condition : stimuli->conditions) {
            if (condition.isPair())
                tallies.push_back(emptyTally(condition));
        }
    else
        tallies = emptyTallies(answers, order);
    std::unordered_map<std::uint32_t, std::pair<Alike, Tally*>> checked; // by condition
    for (const Answer& answer : answers) {
        auto& [alike, tally] = checked[answer.row.conditionId.number()];
        if (!tally || alike != alikeOf(answer.row)) {
            tally = &tallyOf(answer, tallies);
            if (stimuli)
                checkImages(answer, *stimuli);
            alike = alikeOf(answer.row);
        }
        Votes& placed = answer.row.aFirst ? tally->bSecond : tally->bFirst;
        ++(answer.row.choseB ? tally->votes.b : tally->votes.a);
        ++(answer.row.choseB ? placed.b : placed.a);
    }
    groupByLevel(tallies);
    return tallies;
}

std::vector<Tally> readCounts(const std::filesystem::path& path) {
    const std::string file = path.string();
    const std::string text = readFile(path);
    checkIsCsv(text, file);
    std::vector<CsvRecord> records = splitCsv(text);
    std::erase_if(records, isBlank);
    const std::vector<std::string> header =
        records.size() < 2 ? std::vector<std::string>{} : records.front().cells;
    const Layout layout = layoutOf(header, file);
    std::vector<Tally> tallies;
    for (const CsvRecord& record : std::span(records).subspan(1)) {
        checkCells(record, header.size(), file);
        Tally tally = countsOf(record, layout, file);
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
