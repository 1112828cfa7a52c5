#include "analysis/table.h"

#include "base/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

std::string pText(double p) { return p < 0.001 ? "<0.001" : fmt::format("{:.3f}", p); }

// With a real minus sign, and no sign for what rounds to zero.
std::string signedText(double value, int decimals) {
    if (std::abs(value) < 0.5 * std::pow(10.0, -decimals))
        return fmt::format("{:.{}f}", 0.0, decimals);
    return fmt::format("{}{:.{}f}", value < 0 ? "−" : "+", std::abs(value), decimals);
}

// A column: what it says of the pair, or the statistic that it shows.
struct Field {
    std::string_view name;
    bool number;
    std::string (*label)(const Tally&);
    std::string (*figure)(const Frequencies&) = nullptr;
};

std::string cellOf(const Field& field, const Tally& tally, std::string_view absent) {
    if (field.label)
        return field.label(tally);
    const std::optional<Frequencies> statistics = frequencies(tally.votes);
    return statistics ? field.figure(*statistics) : std::string(absent);
}

template <auto field>
std::string text(const Tally& tally) {
    return tally.*field;
}
template <auto member>
std::string votes(const Tally& tally) {
    return fmt::format("{}", tally.votes.*member);
}
template <auto field>
std::string digits(const Frequencies& f) {
    return fmt::format("{}", f.*field);
}

using T = Tally;
using F = Frequencies;
constexpr const char* dash = "–";

const Field printed[] = {
    {"Level", false, text<&T::level>},
    {"Scene", false, text<&T::scene>},
    {"a", false, text<&T::techniqueA>},
    {"b", false, text<&T::techniqueB>},
    {"Hyp.", false, text<&T::hypothesis>},
    {"Votes a : b", true, [](const T& t) { return fmt::format("{} : {}", t.votes.a, t.votes.b); }},
    {"b share (95 %)", true, nullptr,
     [](const F& f) {
         return fmt::format("{:.0f} % ({:.0f}–{:.0f})", 100 * f.share, 100 * f.wilson.low,
                            100 * f.wilson.high);
     }},
    {"χ²", true, nullptr, [](const F& f) { return fmt::format("{:.3f}", f.chiSquare); }},
    {"p (χ²)", true, nullptr, [](const F& f) { return pText(f.chiSquareP); }},
    {"p (exact)", true, nullptr, [](const F& f) { return pText(f.exactP); }},
    {"g", true, nullptr, [](const F& f) { return signedText(f.g, 3); }},
    {"JOD", true, nullptr, [](const F& f) { return f.jod ? signedText(*f.jod, 2) : dash; }},
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
    {"share_b", true, nullptr, digits<&F::share>},
    {"wilson_low", true, nullptr, [](const F& f) { return fmt::format("{}", f.wilson.low); }},
    {"wilson_high", true, nullptr, [](const F& f) { return fmt::format("{}", f.wilson.high); }},
    {"chi_square", true, nullptr, digits<&F::chiSquare>},
    {"p_chi_square", true, nullptr, digits<&F::chiSquareP>},
    {"p_exact", true, nullptr, digits<&F::exactP>},
    {"cohen_g", true, nullptr, digits<&F::g>},
    {"cohen_h", true, nullptr, digits<&F::h>},
    {"cohen_w", true, nullptr, digits<&F::w>},
    {"jod", true, nullptr, [](const F& f) { return f.jod ? fmt::format("{}", *f.jod) : ""; }},
};

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

Table resultTable(const std::vector<Tally>& tallies) {
    Table table;
    for (const Field& field : printed)
        table.columns.push_back({std::string(field.name), field.number});
    for (const Tally& tally : tallies) {
        auto& row = table.rows.emplace_back();
        for (const Field& field : printed)
            row.push_back(cellOf(field, tally, dash));
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
    csv += ",caution\n";
    const std::string caution = fmt::format("{}", fmt::join(cautionsOf(findings), " "));
    for (const Tally& tally : findings.tallies) {
        csv += csvCell(sourceOf(findings));
        for (const Field& field : stored)
            csv.append(",").append(csvCell(cellOf(field, tally, "")));
        csv += fmt::format(",{}\n", csvCell(caution));
    }
    return csv;
}

} // namespace obscura
