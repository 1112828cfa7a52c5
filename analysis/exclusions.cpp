#include "analysis/exclusions.h"

#include "base/csv.h"
#include "base/files.h"

#include "inference/counts.h"
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <tuple>

namespace obscura {

namespace {

// A person, and one of his sessions; the session "" stands for all.
using Who = std::pair<std::uint64_t, std::uint32_t>;
Who personIn(const Vote& row) { return {row.person(), Symbol().number()}; }
Who sessionIn(const Vote& row) { return {row.person(), row.sessionId.number()}; }

using Reasons = std::map<Who, std::string>;

bool isMain(const Vote& row) {
    static const Symbol main("main");
    return row.trialKind == main;
}

Reasons failedCatches(const std::vector<Answer>& rows, const Declared& declared) {
    static const Symbol catches("catch");
    std::map<Who, Votes> answers; // b: right
    for (const Answer& answer : rows) {
        const auto correct = declared.correct.find(answer.row.conditionId);
        if (answer.row.trialKind == catches && correct != declared.correct.end()) {
            Votes& votes = answers[sessionIn(answer.row)];
            ++((correct->second == "b") == answer.row.choseB ? votes.b : votes.a);
        }
    }
    Reasons reasons;
    for (const auto& [session, votes] : answers)
        if (static_cast<double>(votes.b) <
            declared.exclusions.catches * static_cast<double>(votes.total()))
            reasons[session] =
                fmt::format("{} of {} catch trials right, fewer than {:.0f} %", votes.b,
                            votes.total(), 100 * declared.exclusions.catches);
    return reasons;
}

Reasons onePosition(const std::vector<Answer>& rows, double most) {
    std::map<Who, Votes> answers; // b: the second
    for (const Answer& answer : rows)
        if (isMain(answer.row)) {
            Votes& votes = answers[personIn(answer.row)];
            ++(answer.row.choseSecond() ? votes.b : votes.a);
        }
    Reasons reasons;
    for (const auto& [person, votes] : answers)
        if (const auto one = std::max(votes.a, votes.b);
            static_cast<double>(one) > most * static_cast<double>(votes.total()))
            reasons[person] =
                fmt::format("chose the {} picture in {} of {} trials, more than "
                            "{:.0f} %",
                            votes.b > votes.a ? "second" : "first", one, votes.total(), 100 * most);
    return reasons;
}

Reasons incomplete(const std::vector<Answer>& rows) {
    std::map<Who, int> trials;
    int longest = 0;
    for (const Answer& answer : rows)
        if (isMain(answer.row))
            longest = std::max(longest, ++trials[sessionIn(answer.row)]);
    Reasons reasons;
    for (const auto& [session, number] : trials)
        if (number < longest)
            reasons[session] = fmt::format("the session has {} of {} trials", number, longest);
    return reasons;
}

// Sessions by what the ledger calls them; of each, its own last line counts.
Reasons voided(const std::vector<Answer>& rows, std::span<const SlotRecord> slots) {
    std::map<std::pair<std::string, std::string>, const SlotRecord*> last;
    for (const SlotRecord& record : slots)
        last[{record.session.participant, fmt::format("{}", record.session.number)}] = &record;
    const auto returned = [&](const auto& entry) {
        return entry.second->state == SlotState::returned;
    };
    Reasons reasons;
    if (std::none_of(last.begin(), last.end(), returned))
        return reasons;
    for (const Answer& answer : rows)
        if (const auto found = last.find({answer.row.participantId, answer.row.sessionId});
            found != last.end() && returned(*found))
            reasons[sessionIn(answer.row)] =
                fmt::format("slot {} was given back: the session ended early, or was voided",
                            found->second->slot);
    return reasons;
}

// Moves the rows for which `reason` is not ""; `reasons` gets one entry for each `who` in turn.
void move(std::vector<Answer>& rows, Excluded& excluded,
          const std::function<const std::string*(const Answer&)>& reason, bool bySession) {
    std::map<std::tuple<std::uint64_t, std::uint32_t, std::string>, std::size_t> known;
    std::vector<Answer> kept;
    for (Answer& answer : rows) {
        const std::string* why = reason(answer);
        if (!why) {
            kept.push_back(answer);
            continue;
        }
        const auto who = bySession ? sessionIn(answer.row) : Who{};
        const auto [entry, isNew] =
            known.try_emplace({who.first, who.second, *why}, excluded.reasons.size());
        if (isNew)
            excluded.reasons.push_back({bySession ? answer.row.participantId.text() : "",
                                        bySession ? answer.row.sessionId.text() : "", *why, 0});
        excluded.reasons[entry->second].trials += isMain(answer.row);
        excluded.rows.push_back(answer);
    }
    rows = std::move(kept);
}

void moveWhole(std::vector<Answer>& rows, Excluded& excluded, const Reasons& reasons) {
    if (reasons.empty())
        return;
    move(
        rows, excluded,
        [&](const Answer& answer) -> const std::string* {
            for (const Who& who : {personIn(answer.row), sessionIn(answer.row)})
                if (const auto found = reasons.find(who); found != reasons.end())
                    return &found->second;
            return nullptr;
        },
        true);
}

void moveTrials(std::vector<Answer>& rows, Excluded& excluded, const std::string& why,
                const std::function<bool(const Vote&)>& applies) {
    const auto concerned = [&](const Answer& answer) {
        return isMain(answer.row) && applies(answer.row);
    };
    if (std::any_of(rows.begin(), rows.end(), concerned))
        move(
            rows, excluded,
            [&](const Answer& answer) { return concerned(answer) ? &why : nullptr; }, false);
}

constexpr std::array<std::string_view, 4> ruleColumns = {"participant_id", "session_id",
                                                         "condition_id", "reason"};

// One line of the file.
struct Asked {
    std::string participant, session, condition, reason;
    int line = 0;

    bool fits(const Vote& row) const {
        const auto alike = [](const std::string& asked, Symbol found) {
            return asked.empty() || asked == found.text();
        };
        return alike(participant, row.participantId) && alike(session, row.sessionId) &&
               alike(condition, row.conditionId);
    }
};

Asked askedOf(const CsvRecord& record, const std::string& file) {
    const Place place{file, record.line, 0, {}};
    if (!record.fault.empty())
        throw Error(place, record.fault);
    if (record.cells.size() != ruleColumns.size())
        throw Error(place, fmt::format("expected {} cells, {}, found {}", ruleColumns.size(),
                                       fmt::join(ruleColumns, ","), record.cells.size()));
    const auto& cells = record.cells;
    if (cells[3].empty())
        throw Error({file, record.line, 4, "reason"}, "expected a reason, found nothing");
    if (cells[0].empty() && cells[1].empty() && cells[2].empty())
        throw Error(place, "expected a participant, a session or a condition, found none");
    return {cells[0], cells[1], cells[2], cells[3], record.line};
}

std::vector<Asked> readAsked(const std::filesystem::path& path) {
    const std::string file = path.string(), text = readFile(path);
    checkIsCsv(text, file);
    std::vector<CsvRecord> records = splitCsv(text);
    std::erase_if(records, isBlank);
    if (records.empty() || !std::equal(records[0].cells.begin(), records[0].cells.end(),
                                       ruleColumns.begin(), ruleColumns.end()))
        throw Error({file, 1, 0, {}},
                    fmt::format("expected the header {}", fmt::join(ruleColumns, ",")));
    std::vector<Asked> asked;
    for (const CsvRecord& record : std::span(records).subspan(1))
        asked.push_back(askedOf(record, file));
    return asked;
}

void moveAsked(std::vector<Answer>& rows, Excluded& excluded, const std::filesystem::path& path) {
    std::vector<Asked> lines = readAsked(path);
    std::vector<bool> used(lines.size());
    move(
        rows, excluded,
        [&](const Answer& answer) -> const std::string* {
            const std::string* why = nullptr;
            for (std::size_t i = 0; i < lines.size(); ++i)
                if (lines[i].fits(answer.row)) {
                    used[i] = true;
                    why = why ? why : &lines[i].reason;
                }
            return why;
        },
        true);
    for (std::size_t i = 0; i < lines.size(); ++i)
        if (!used[i])
            throw Error({path.string(), lines[i].line, 0, {}},
                        fmt::format("fits no row of the answers: participant \"{}\", session "
                                    "\"{}\", condition \"{}\"; correct it, or remove the line",
                                    lines[i].participant, lines[i].session, lines[i].condition));
}

} // namespace

Excluded exclude(std::vector<Answer>& rows, const Declared& declared,
                 std::span<const SlotRecord> slots, const std::filesystem::path& file) {
    const ExclusionRules& rules = declared.exclusions;
    Excluded excluded;
    if (!file.empty())
        moveAsked(rows, excluded, file);
    if (rules.voided)
        moveWhole(rows, excluded, voided(rows, slots));
    if (rules.catches > 0)
        moveWhole(rows, excluded, failedCatches(rows, declared));
    if (rules.incomplete)
        moveWhole(rows, excluded, incomplete(rows));
    if (rules.onePosition < 1)
        moveWhole(rows, excluded, onePosition(rows, rules.onePosition));
    if (rules.interrupted)
        moveTrials(rows, excluded, "the window lost the keyboard during the trial",
                   [](const Vote& row) { return row.interrupted; });
    if (rules.wrongMasks)
        moveTrials(rows, excluded, "the mask had other than the planned refreshes",
                   [](const Vote& row) { return row.maskFramesShown != row.maskFramesPlanned; });
    if (rules.fastest > 0)
        moveTrials(rows, excluded,
                   fmt::format("answered within {:g} s after the question", rules.fastest),
                   [&](const Vote& row) { return row.decisionRtMs < 1000 * rules.fastest; });
    return excluded;
}

std::vector<std::string> inWords(const ExclusionRules& rules) {
    std::vector<std::string> words;
    if (rules.voided)
        words.emplace_back("Sessions whose slot was given back (they ended early, or an "
                           "experimenter voided them) do not count: another person sees the same "
                           "order in their place.");
    if (rules.catches > 0)
        words.push_back(fmt::format("Sessions with fewer than {:.0f} % right answers to catch "
                                    "trials do not count.",
                                    100 * rules.catches));
    if (rules.incomplete)
        words.emplace_back("Sessions with fewer trials than the longest one do not count.");
    if (rules.onePosition < 1)
        words.push_back(fmt::format("People who choose one position in more than {:.0f} % of "
                                    "their trials do not count.",
                                    100 * rules.onePosition));
    if (rules.interrupted)
        words.emplace_back("Trials during which the window lost the keyboard do not count.");
    if (rules.wrongMasks)
        words.emplace_back("Trials whose mask had other than the planned refreshes do not count.");
    if (rules.fastest > 0)
        words.push_back(
            fmt::format("Answers within {:g} s after the question do not count.", rules.fastest));
    return words;
}

} // namespace obscura
