#include "analysis/people_figures.h"

#include "analysis/verdict.h"
#include "report/gnuplot.h"

#include "inference/tails.h"
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace obscura {

namespace {

constexpr double positionHeight = 3.2, timesHeight = 2.6; // inches
constexpr std::int64_t mostBins = 20;

// Entries side by side where there is room.
const char* keyOf(double width) {
    return width < wideFigure ? "set key outside above left maxcols 1\n"
                              : "set key outside above left maxrows 1\n";
}

// -- Position --

// People by their share of second pictures, in as many bins as a typical person's votes allow.
struct Bins {
    std::int64_t last = 0;                // shares are 0 / last, 1 / last, ... 1
    std::vector<double> people, expected; // by chance alone
    std::vector<double> biased;           // of the people, those flagged
};

Bins binsOf(const std::vector<Person>& persons) {
    std::map<std::int64_t, std::int64_t> numbers; // people by their trials
    for (const Person& person : persons)
        ++numbers[person.trials()];
    const auto usual = std::max_element(numbers.begin(), numbers.end(), [](auto& x, auto& y) {
                           return x.second < y.second;
                       })->first;
    Bins bins;
    bins.last = std::min(usual, mostBins);
    const auto count = static_cast<std::size_t>(bins.last) + 1;
    bins.people.resize(count);
    bins.expected.resize(count);
    bins.biased.resize(count);
    const auto binOf = [&](std::int64_t chosen, std::int64_t trials) {
        return static_cast<std::size_t>(
            std::lround(static_cast<double>(chosen * bins.last) / static_cast<double>(trials)));
    };
    for (const Person& person : persons) {
        const std::size_t bin = binOf(person.places.b, person.trials());
        ++bins.people[bin];
        bins.biased[bin] += person.holm < significance;
    }
    for (const auto& [trials, people] : numbers)
        for (std::int64_t k = 0; k <= trials; ++k)
            bins.expected[binOf(k, trials)] +=
                static_cast<double>(people) * binomialMass(k, trials, 0.5);
    return bins;
}

double percentAt(const Bins& bins, std::size_t bin) {
    return 100 * static_cast<double>(bin) / static_cast<double>(bins.last);
}

std::string positionScript(const Findings& findings, const Bins& bins, double width) {
    std::string rows;
    for (std::size_t i = 0; i < bins.people.size(); ++i)
        rows += fmt::format("{} {} {} {}\n", percentAt(bins, i), bins.people[i], bins.biased[i],
                            bins.expected[i]);
    const double half = 50 / static_cast<double>(bins.last);
    const double top = std::max(*std::max_element(bins.people.begin(), bins.people.end()),
                                *std::max_element(bins.expected.begin(), bins.expected.end()));
    std::vector<std::string> elements = {
        "$people using 1:2 with boxes linecolor rgb '#4A8FC2' title 'people'"};
    if (*std::max_element(bins.biased.begin(), bins.biased.end()) > 0)
        elements.emplace_back("$people using 1:($3 > 0 ? $3 : 1/0) with boxes fillstyle pattern 2 "
                              "border linecolor rgb '#D55E00' title 'one place more than chance'");
    elements.emplace_back("$people using 1:4 with linespoints pointtype 6 pointsize 0.8 linewidth "
                          "1.5 linecolor rgb '#000000' title 'expected by chance'");
    return plot::style + stampScript(findings, width, positionHeight) +
           fmt::format("set xrange [{}:{}]\nset yrange [0:{}]\n", -half, 100 + half, 1.08 * top) +
           "set xtics 0, 25, 100 nomirror out format '%.0f %%'\nset ytics nomirror out\n"
           "set xlabel " +
           gnuplotText("share of a person's votes for the second picture") +
           "\nset ylabel 'people'\n" + keyOf(width) +
           "set arrow from 50, graph 0 to 50, graph 1 nohead linewidth 1 dashtype 3 "
           "linecolor rgb '#333333'\n" +
           fmt::format("set boxwidth {} absolute\nset style fill solid 1\n", 1.6 * half) +
           plot::block("people", rows) + "plot " + plot::list(elements) + "\n";
}

// -- Times --

std::string secondsLabel(double ms) { return fmt::format("{:.2f} s", ms / 1000); }

std::string timesScript(const Findings& findings, const ResponseTimes& times, double width) {
    std::string boxes, medians, flagged, labels;
    std::vector<double> all(times.flaggedMs);
    for (std::size_t i = 0; i < times.measures.size(); ++i) {
        const ResponseTimes::Measure& one = times.measures[i];
        const std::size_t y = times.measures.size() - i; // the first on top
        const auto& q = one.quantiles;
        boxes +=
            fmt::format("{} {} {} {} {}\n", y, q[0] / 1000, q[1] / 1000, q[3] / 1000, q[4] / 1000);
        medians += fmt::format("{} {}\n", q[2] / 1000, y);
        labels += fmt::format("{}{} {}", labels.empty() ? "" : ", ",
                              gnuplotText(std::string(one.name)), y);
        all.insert(all.end(), {q[0], q[4]});
    }
    for (double& value : all)
        value /= 1000;
    for (const double value : times.flaggedMs)
        if (value > 0)
            flagged += fmt::format("{} 1\n", value / 1000);
    std::string script =
        plot::style + stampScript(findings, width, timesHeight) +
        plot::ticks("x", logarithmicAxis(all)) +
        fmt::format("set yrange [0.4:{}]\nset ytics scale 0 ({})\nset grid noytics\n",
                    static_cast<double>(times.measures.size()) + 0.6, labels) +
        "set xlabel 'seconds'\nset lmargin 17\nset rmargin 3\n" + keyOf(width) +
        plot::block("boxes", boxes) + plot::block("medians", medians);
    if (!flagged.empty())
        script += plot::block("flagged", flagged);
    std::vector<std::string> elements = {
        "$boxes using 2:1:($5 - $2):(0) with vectors nohead linewidth 1.5 linecolor rgb '#0072B2' "
        "title '5 to 95 %'",
        "$boxes using 3:1:3:4:($1 - 0.22):($1 + 0.22) with boxxyerror fillstyle solid 1 "
        "linecolor rgb '#4A8FC2' title 'middle half'",
        "$medians using 1:2 with points pointtype 7 pointsize 0.9 linecolor rgb '#000000' "
        "title 'median'"};
    if (!flagged.empty())
        elements.emplace_back("$flagged using 1:2 with points pointtype 6 pointsize 0.9 "
                              "linewidth 1.5 linecolor rgb '#D55E00' title 'flagged, but counted'");
    return script + "plot " + plot::list(elements) + "\n";
}

} // namespace

std::vector<StudyFigure> positionFigures(const Findings& findings) {
    if (!findings.people || findings.people->persons.size() < 2)
        return {};
    const Bins bins = binsOf(findings.people->persons);
    StudyFigure figure;
    const auto draw = [&](double width) {
        return Figure{"position", "How often people chose the second picture",
                      positionScript(findings, bins, width), width, positionHeight};
    };
    figure.drawing = draw(wideFigure);
    figure.narrow = draw(narrowFigure);
    figure.caption = "People by the share of their votes that went to the second picture. Where "
                     "place does not matter the bars follow the circles; people at either end "
                     "chose a place, not a picture. Hatched: beyond chance for the person "
                     "alone (exact p < .05 after Holm).";
    figure.numbers = {{{"Second picture chosen, %", true},
                       {"People", true},
                       {"Of them beyond chance", true},
                       {"Expected by chance", true}},
                      {}};
    for (std::size_t i = 0; i < bins.people.size(); ++i)
        figure.numbers.rows.push_back(
            {fmt::format("{:.0f}", percentAt(bins, i)), fmt::format("{:.0f}", bins.people[i]),
             fmt::format("{:.0f}", bins.biased[i]), fmt::format("{:.1f}", bins.expected[i])});
    return {figure};
}

std::vector<StudyFigure> timesFigures(const Findings& findings) {
    if (!findings.people)
        return {};
    const ResponseTimes& times = findings.people->times;
    const bool drawable = std::all_of(times.measures.begin(), times.measures.end(),
                                      [](const auto& one) { return one.quantiles.front() > 0; });
    if (!drawable) // a logarithm is missing
        return {};
    StudyFigure figure;
    const auto draw = [&](double width) {
        return Figure{"times", "How long people looked, and took to answer",
                      timesScript(findings, times, width), width, timesHeight};
    };
    figure.drawing = draw(wideFigure);
    figure.narrow = draw(narrowFigure);
    figure.caption = fmt::format(
        "Each picture's viewing time and the time from the question to the answer: median, middle "
        "half, and from 5 to 95 %. Decisions whose logarithm is more than 2.5 MAD from the median "
        "are flagged ({} of {}); their votes count.",
        times.count(), times.isFlagged.size());
    figure.numbers = {{{"Time"},
                       {"5 %", true},
                       {"25 %", true},
                       {"Median", true},
                       {"75 %", true},
                       {"95 %", true},
                       {"MAD", true},
                       {"Geometric mean", true},
                       {"Mean of the middle 80 %", true}},
                      {}};
    for (const ResponseTimes::Measure& one : times.measures) {
        const auto& [q05, q25, q50, q75, q95] = one.quantiles;
        const Summary& s = one.summary;
        figure.numbers.rows.push_back(
            {std::string(one.name), secondsLabel(q05), secondsLabel(q25), secondsLabel(q50),
             secondsLabel(q75), secondsLabel(q95), secondsLabel(s.mad),
             s.geometricMean ? secondsLabel(*s.geometricMean) : "–", secondsLabel(s.trimmedMean)});
    }
    return {figure};
}

} // namespace obscura
