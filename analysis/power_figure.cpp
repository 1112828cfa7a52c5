#include "analysis/figures.h"
#include "analysis/verdict.h"
#include "report/gnuplot.h"
#include "report/marks.h"

#include "inference/power.h"
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace obscura {

namespace {

// What the exact test could have found with as many votes as there are. Shares are those of the
// preferred of the two, 1/2 to 1: power is the same for a and b.
constexpr double target = 0.8;
constexpr std::size_t mostCurves = 3;

// The share from which on the power reaches the target; absent if even 1 does not.
std::optional<double> detectable(std::int64_t votes, double level) {
    const auto isEnough = [&](double share) {
        return power(exactP, votes, share, level) >= target;
    };
    if (!isEnough(1))
        return std::nullopt;
    double low = 0.5, high = 1;
    while (high - low > 1e-6) {
        const double middle = (low + high) / 2;
        (isEnough(middle) ? high : low) = middle;
    }
    return high;
}

// Of the tests that are corrected together with that of each condition.
std::vector<int> familySizes(const std::vector<Tally>& tallies) {
    std::map<std::string, int> sizes;
    for (const Tally& tally : tallies)
        sizes[tally.family] += tally.votes.total() > 0;
    std::vector<int> result;
    for (const Tally& tally : tallies)
        result.push_back(sizes[tally.family]);
    return result;
}

double shareOfPreferred(Votes votes) {
    return static_cast<double>(std::max(votes.a, votes.b)) / static_cast<double>(votes.total());
}

std::string percent(std::optional<double> share) {
    return share ? fmt::format("{:.0f} %", 100 * *share) : "none";
}

// Numbers of votes to draw: each, or the least, the middle and the most.
std::vector<std::int64_t> drawn(const std::vector<Tally>& tallies) {
    std::set<std::int64_t> different;
    for (const Tally& tally : tallies)
        if (tally.votes.total() > 0)
            different.insert(tally.votes.total());
    std::vector<std::int64_t> all(different.begin(), different.end());
    if (all.size() > mostCurves)
        all = {all.front(), all[all.size() / 2], all.back()};
    return all;
}

constexpr const char* powerStyle = R"(set xrange [50:100]
set yrange [0:100]
set xtics 50, 10, 100 nomirror out format '%.0f %%'
set ytics 0, 20, 100 nomirror out format '%.0f %%'
set xlabel 'true share of the preferred image'
set ylabel 'chance to find it'
set key outside above left maxcols 1 spacing 1.3
set rmargin 4
set arrow from 50, 80 to 100, 80 nohead linewidth 1 dashtype 3 linecolor rgb '#333333'
)";

std::string script(const Findings& findings) {
    const std::vector<int> sizes = familySizes(findings.tallies);
    const int family = *std::max_element(sizes.begin(), sizes.end());
    std::string data;
    std::vector<std::string> elements;
    std::size_t series = 0;
    for (const std::int64_t votes : drawn(findings.tallies)) {
        std::string curve;
        for (int share = 100; share <= 200; ++share) // half percents
            curve += fmt::format("{} {:.5f} {:.5f}\n", share / 2.0,
                                 100 * power(exactP, votes, share / 200.0, significance),
                                 100 * power(exactP, votes, share / 200.0, significance / family));
        const std::string name = fmt::format("n{}", votes);
        data += plot::block(name, curve);
        const std::string_view colour = markOf(series++).colour;
        elements.push_back(fmt::format("${} using 1:2 with lines linewidth 2 linecolor rgb '{}' "
                                       "title 'N = {}, tested alone'",
                                       name, colour, votes));
        if (family > 1)
            elements.push_back(fmt::format("${} using 1:3 with lines linewidth 2 dashtype 2 "
                                           "linecolor rgb '{}' title 'N = {}, first of {} tests'",
                                           name, colour, votes, family));
    }
    std::string seen;
    for (const Tally& tally : findings.tallies)
        if (tally.votes.total() > 0)
            seen += fmt::format("{} 0\n", 100 * shareOfPreferred(tally.votes));
    data += plot::block("seen", seen);
    elements.emplace_back("$seen using 1:(2.5) with points pointtype 10 pointsize 1 linewidth 1.5 "
                          "linecolor rgb '#333333' title 'shares seen'");
    return plot::style + std::string(powerStyle) + data + "plot " + plot::list(elements) + "\n";
}

Table numbersOf(const std::vector<Tally>& tallies) {
    Table table{{{"Condition"},
                 {"Votes", true},
                 {"Share seen", true},
                 {"Found in 80 %, alone", true},
                 {"Tests corrected together", true},
                 {"Found in 80 %, first of them", true}},
                {}};
    const std::vector<int> sizes = familySizes(tallies);
    for (std::size_t i = 0; i < tallies.size(); ++i) {
        const std::int64_t votes = tallies[i].votes.total();
        if (votes == 0)
            continue;
        table.rows.push_back({tallies[i].condition, fmt::format("{}", votes),
                              percent(shareOfPreferred(tallies[i].votes)),
                              percent(detectable(votes, significance)), fmt::format("{}", sizes[i]),
                              percent(detectable(votes, significance / sizes[i]))});
    }
    return table;
}

} // namespace

std::vector<StudyFigure> powerFigures(const Findings& findings) {
    if (drawn(findings.tallies).empty())
        return {};
    const auto draw = [&](double width, double height) {
        return Figure{"power", "What this study could have found",
                      stampScript(findings, width, height) + script(findings), width, height};
    };
    const std::string repeated =
        findings.conduct && findings.conduct->mostVotes > 1
            ? " Some people voted several times; the curves take every vote for another person's, "
              "so they promise too much."
            : "";
    return {{draw(wideFigure, 4),
             "How often the exact test of one condition, with the N votes that it has, "
             "finds a difference when one exists, against how large it truly is; the dotted line "
             "is 80 %. Broken lines: as the first of Holm's tests that are corrected together. "
             "Triangles: the shares that were seen, for scale. The power at a share that was seen "
             "says no more than its p (Hoenig and Heisey 2001)." +
                 repeated,
             numbersOf(findings.tallies), draw(narrowFigure, 4)}};
}

} // namespace obscura
