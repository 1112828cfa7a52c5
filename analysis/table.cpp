#include "analysis/table.h"

#include "analysis/statistics.h"
#include "analysis/verdict.h"
#include "base/csv.h"

#include "inference/tails.h"
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

// With a real minus sign, and no sign for what rounds to zero.
std::string signedText(double value, int decimals) {
    if (std::abs(value) < 0.5 * std::pow(10.0, -decimals))
        return fmt::format("{:.{}f}", 0.0, decimals);
    return fmt::format("{}{:.{}f}", value < 0 ? "−" : "+", std::abs(value), decimals);
}

double shareOf(Votes votes) {
    return static_cast<double>(votes.b) / static_cast<double>(votes.total());
}

// Of unanimous votes, which have no finite estimate, the one-sided bound: at least so far.
std::string jodText(Votes votes) {
    if (const auto value = jod(votes))
        return signedText(*value, 2);
    const JodLimits bound = jodLimits(clopperPearson(votes.b, votes.total()));
    return bound.low ? "≥ " + signedText(*bound.low, 2) : "≤ " + signedText(*bound.high, 2);
}

// A column: what it says of the pair, or the statistic that it shows.
struct Field {
    std::string_view name;
    bool number;
    std::string (*label)(const Tally&);
    std::string (*figure)(const Tally&) = nullptr; // of votes
    double Verdict::*adjusted = nullptr;           // or its p, adjusted
};

std::string cellOf(const Field& field, const Tally& tally, const std::optional<Verdict>& verdict) {
    if (field.label)
        return field.label(tally);
    if (!verdict)
        return dash;
    return field.adjusted ? pCell(*verdict.*field.adjusted) : field.figure(tally);
}

template <auto field>
std::string text(const Tally& tally) {
    return tally.*field;
}
template <auto member>
std::string votes(const Tally& tally) {
    return fmt::format("{}", tally.votes.*member);
}
// Beside the share: what it would be in balanced orders.
std::string balanced(const Tally& tally) {
    const auto share = balancedShare(tally.bFirst, tally.bSecond);
    return share ? fmt::format("{:.0f} % ({:.0f}–{:.0f})", 100 * share->share,
                               100 * share->interval.low, 100 * share->interval.high)
                 : dash;
}
using T = Tally;
const Field printed[] = {
    {"Level", false, text<&T::level>},
    {"Scene", false, text<&T::scene>},
    {"a", false, text<&T::techniqueA>},
    {"b", false, text<&T::techniqueB>},
    {"Hyp.", false, text<&T::hypothesis>},
    {"Votes a : b", true, [](const T& t) { return fmt::format("{} : {}", t.votes.a, t.votes.b); }},
    {"b share (95 %)", true, nullptr,
     [](const T& t) {
         const auto [low, high] = intervalOf(t);
         return fmt::format("{:.0f} % ({:.0f}–{:.0f})", 100 * shareOf(t.votes), 100 * low,
                            100 * high);
     }},
    {"same, orders balanced", true, balanced},
    {"χ²", true, nullptr, [](const T& t) { return fmt::format("{:.3f}", chiSquare(t.votes)); }},
    {"p (χ²)", true, nullptr, [](const T& t) { return pCell(chiSquareP(chiSquare(t.votes))); }},
    {"p (exact)", true, nullptr, [](const T& t) { return pCell(exactP(t.votes)); }},
    {"p (Holm)", true, nullptr, nullptr, &Verdict::holm},
    {"g", true, nullptr, [](const T& t) { return signedText(cohenG(t.votes), 3); }},
    {"JOD", true, nullptr, [](const T& t) { return jodText(t.votes); }},
};

const Field stored[] = {
    {"condition_id", false, text<&T::condition>},
    {"level", false, text<&T::level>},
    {"scene", false, text<&T::scene>},
    {"hypothesis", false, text<&T::hypothesis>},
    {"technique_a", false, text<&T::techniqueA>},
    {"technique_b", false, text<&T::techniqueB>},
    {"votes_a", true, votes<&Votes::a>},
    {"votes_b", true, votes<&Votes::b>},
};

std::string shareCells(const std::optional<EstimatedShare>& share) {
    return share ? fmt::format(",{},{},{}", share->share, share->interval.low, share->interval.high)
                 : ",,,";
}

// The votes by the place of b, and the shares that allow for it and for who answered.
std::string adjustedCells(const Findings& findings, std::size_t i) {
    const auto& [first, second] =
        std::pair(findings.tallies[i].bFirst, findings.tallies[i].bSecond);
    std::string cells = first.total() + second.total() == 0
                            ? ",,,,"
                            : fmt::format(",{},{},{},{}", first.a, first.b, second.a, second.b);
    cells += shareCells(balancedShare(first, second));
    const bool modelled = findings.people && !findings.people->observers.empty();
    return cells + shareCells(modelled ? findings.people->observers[i] : std::nullopt);
}

std::size_t width(const std::string& text) { // in code points
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t columns, bool right) {
    const std::string space(columns - width(text), ' ');
    return right ? space + text : text + space;
}

std::string alignedLine(const Table& table, const std::vector<std::string>& cells,
                        const std::vector<std::size_t>& widths) {
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i)
        line.append(i ? "  " : "").append(padded(cells[i], widths[i], table.columns[i].number));
    line.erase(line.find_last_not_of(' ') + 1);
    return line + "\n";
}

} // namespace

std::string pCell(double p) { return p < 0.001 ? "<0.001" : fmt::format("{:.3f}", p); }

std::string digits(std::optional<double> value) { return value ? fmt::format("{}", *value) : ""; }

Table resultTable(const std::vector<Tally>& tallies) {
    const bool orders = std::any_of(tallies.begin(), tallies.end(), [](const Tally& tally) {
        return tally.bFirst.total() > 0 && tally.bSecond.total() > 0;
    });
    std::vector<Field> fields;
    for (const Field& field : printed)
        if (orders || field.label != balanced)
            fields.push_back(field);
    Table table;
    for (const Field& field : fields)
        table.columns.push_back({std::string(field.name), field.number});
    const auto verdicts = verdictsOf(tallies);
    for (std::size_t i = 0; i < tallies.size(); ++i) {
        auto& row = table.rows.emplace_back();
        for (const Field& field : fields)
            row.push_back(cellOf(field, tallies[i], verdicts[i]));
    }
    return table;
}

std::string alignedText(const Table& table) {
    std::vector<std::string> headings, rules;
    std::vector<std::size_t> widths;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        headings.push_back(table.columns[i].heading);
        widths.push_back(width(headings[i]));
        for (const auto& row : table.rows)
            widths[i] = std::max(widths[i], width(row[i]));
        rules.emplace_back();
        for (std::size_t n = 0; n < widths[i]; ++n)
            rules[i] += "─";
    }
    std::string text = alignedLine(table, headings, widths) + alignedLine(table, rules, widths);
    for (const auto& row : table.rows)
        text += alignedLine(table, row, widths);
    return text;
}

std::string resultCsv(const Findings& findings) {
    std::string csv = "source";
    for (const Field& field : stored)
        csv += fmt::format(",{}", field.name);
    for (const CountStatistic& statistic : countStatistics())
        csv += fmt::format(",{}", statistic.id);
    csv += ",p_holm,p_benjamini_hochberg,votes_a_b_first,votes_b_b_first,votes_a_b_second,"
           "votes_b_b_second,share_b_balanced,balanced_low,balanced_high,share_b_observers,"
           "observers_low,observers_high,family,verdict,caution\n";
    const std::string caution = fmt::format("{}", fmt::join(cautionsOf(findings), " "));
    const auto verdicts = verdictsOf(findings.tallies);
    for (std::size_t i = 0; i < verdicts.size(); ++i) {
        const Tally& tally = findings.tallies[i];
        csv += csvCell(sourceOf(findings));
        for (const Field& field : stored)
            csv.append(",").append(csvCell(field.label(tally)));
        for (const CountStatistic& statistic : countStatistics())
            csv.append(",").append(digits(verdicts[i] ? statistic.of(tally.votes) : std::nullopt));
        csv += verdicts[i]
                   ? fmt::format(",{},{}", verdicts[i]->holm, verdicts[i]->benjaminiHochberg)
                   : ",,";
        csv += adjustedCells(findings, i);
        csv += fmt::format(",{},{},{}\n", csvCell(tally.family),
                           verdicts[i] ? nameOf(verdicts[i]->outcome) : "", csvCell(caution));
    }
    return csv;
}

Table testTable(const Findings& findings) {
    Table table{{{"Question"},
                 {"About"},
                 {"Test"},
                 {"Statistic", true},
                 {"df", true},
                 {"p", true},
                 {"p (Holm)", true},
                 {"To know"}},
                {}};
    for (const Tested& one : findings.tests) {
        const std::optional<Test>& test = one.result.test;
        const auto number = [&](std::optional<double> Test::*member) {
            return test && (*test).*member ? fmt::format("{:.4g}", *((*test).*member))
                                           : std::string(dash);
        };
        table.rows.push_back({std::string(one.kind->question), one.result.about,
                              std::string(one.kind->source), number(&Test::statistic),
                              number(&Test::df), test ? pCell(test->p) : dash,
                              one.holm ? pCell(*one.holm) : dash, one.result.note});
    }
    return table;
}

std::string testsText(const Findings& findings) {
    std::string text;
    std::string_view question;
    for (const auto& [kind, result, holm] : findings.tests) {
        if (kind->question != question)
            text += fmt::format("{}\n", kind->question);
        question = kind->question;
        const std::string p = !result.test             ? "no test"
                              : result.test->p < 0.001 ? "p < 0.001"
                                                       : fmt::format("p = {:.3f}", result.test->p);
        const std::string adjusted =
            holm ? fmt::format(", {} after Holm",
                               holm < 0.001 ? "< 0.001" : fmt::format("{:.3f}", *holm))
                 : "";
        text += fmt::format("  {}: {}{} ({}){}{}\n", result.about, p, adjusted, kind->source,
                            result.note.empty() ? "" : "; ", result.note);
    }
    return text;
}

std::string testsCsv(const Findings& findings) {
    std::string csv = "source,test,question,about,statistic,df,p,p_holm,note,method\n";
    for (const auto& [kind, result, holm] : findings.tests) {
        const Test test = result.test.value_or(Test());
        csv += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", csvCell(sourceOf(findings)), kind->id,
                           csvCell(kind->question), csvCell(result.about), digits(test.statistic),
                           digits(test.df), result.test ? fmt::format("{}", test.p) : "",
                           digits(holm), csvCell(result.note), csvCell(kind->source));
    }
    return csv;
}

} // namespace obscura
