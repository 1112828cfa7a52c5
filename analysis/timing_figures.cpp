#include "analysis/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace obscura {

namespace {

constexpr int mostBars = 40;
constexpr double inchesHigh = 3;

struct Bar {
    double from = 0, to = 0;
    int trials = 0;
};

// Of whole milliseconds: as wide as it takes to have few of them, at least one.
std::vector<Bar> barsOf(const std::map<int, int>& times) {
    const int low = times.begin()->first, high = times.rbegin()->first;
    const int width = (high - low) / mostBars + 1;
    std::vector<Bar> bars;
    for (const auto& [time, trials] : times) {
        const double from = low + (time - low) / width * width - 0.5;
        if (bars.empty() || bars.back().from != from)
            bars.push_back({from, from + width, 0});
        bars.back().trials += trials;
    }
    return bars;
}

constexpr const char* boxes = R"(set style fill solid 0.85 border linecolor rgb '#0072B2'
set yrange [0:*]
set ytics nomirror out format '%.0f'
set xtics nomirror out
set ylabel 'trials' offset -1, 0
set lmargin 11
set rmargin 3
unset key
)";

// No tick between whole trials.
std::string wholeTicks(int most) { return most < 6 ? "set ytics 1\n" : ""; }

Figure drawing(const Findings& findings, const std::string& name, const std::string& title,
               const std::string& script, double width) {
    return {name, title,
            plot::style + std::string(boxes) + stampScript(findings, width, inchesHigh) + script,
            width, inchesHigh};
}

StudyFigure figure(const Findings& findings, const std::string& name, const std::string& title,
                   const std::string& script, const std::string& caption, Table numbers) {
    return {drawing(findings, name, title, script, wideFigure), caption, std::move(numbers),
            drawing(findings, name, title, script, narrowFigure)};
}

StudyFigure mask(const Findings& findings) {
    const Conduct& conduct = *findings.conduct;
    std::string data;
    int most = 0;
    Table numbers{{{"Mask, ms"}, {"Trials", true}}, {}};
    const std::vector<Bar> bars = barsOf(conduct.maskTimes);
    for (const Bar& bar : bars) {
        most = std::max(most, bar.trials);
        data += fmt::format("{} {} {}\n", (bar.from + bar.to) / 2, bar.trials, bar.to - bar.from);
        numbers.rows.push_back({bar.to - bar.from == 1
                                    ? fmt::format("{:.0f}", bar.from + 0.5)
                                    : fmt::format("{:.0f}–{:.0f}", bar.from + 0.5, bar.to - 0.5),
                                fmt::format("{}", bar.trials)});
    }
    const double low = bars.front().from, high = bars.back().to;
    const double room = std::max(5.0, 0.05 * (high - low));
    return figure(findings, "mask", "Duration of the grey mask",
                  plot::block("mask", data) + wholeTicks(most) +
                      fmt::format("set xlabel 'mask, ms'\nset xrange [{}:{}]\n"
                                  "plot $mask using 1:2:3 with boxes linecolor rgb '#0072B2'\n",
                                  std::floor(low - room), std::ceil(high + room)),
                  fmt::format("Trials by how long the grey mask between the two images lasted, as "
                              "the display measured it. In {} of {} trials it had other than the "
                              "planned number of refreshes.",
                              conduct.wrongMasks, conduct.trials),
                  std::move(numbers));
}

StudyFigure counts(const Findings& findings, const std::string& name, const std::string& title,
                   const std::map<int, int>& trials, const std::string& axis,
                   const std::string& caption) {
    std::string data;
    int most = 0;
    Table numbers{{{axis}, {"Trials", true}}, {}};
    for (const auto& [count, of] : trials) {
        most = std::max(most, of);
        data += fmt::format("{} {}\n", count, of);
        numbers.rows.push_back({fmt::format("{}", count), fmt::format("{}", of)});
    }
    return figure(findings, name, title,
                  plot::block("counts", data) + wholeTicks(most) +
                      fmt::format("set xlabel '{}'\nset xrange [{}:{}]\nset xtics {}\n"
                                  "plot $counts using 1:2:(0.8) with boxes linecolor rgb "
                                  "'#0072B2'\n",
                                  axis, trials.begin()->first - 0.6, trials.rbegin()->first + 0.6,
                                  1 + (trials.rbegin()->first - trials.begin()->first) / 8),
                  caption, std::move(numbers));
}

} // namespace

std::vector<StudyFigure> timingFigures(const Findings& findings) {
    if (!findings.conduct || findings.conduct->trials == 0)
        return {};
    const Conduct& conduct = *findings.conduct;
    std::vector<StudyFigure> figures = {mask(findings)};
    // Where nothing went amiss a single bar would show nothing.
    if (conduct.wrongMasks > 0)
        figures.push_back(counts(findings, "mask-refreshes", "Refreshes of the mask",
                                 conduct.maskFrames, "refreshes beyond those planned",
                                 "Trials by how many refreshes the mask had beyond those planned "
                                 "(0: as planned)."));
    if (conduct.missedFrames > 0)
        figures.push_back(counts(
            findings, "missed-frames", "Missed frames", conduct.missed, "missed frames of a trial",
            fmt::format("Trials by how many frames came late; {} of {} had at least one.",
                        conduct.missedFrames, conduct.trials)));
    return figures;
}

} // namespace obscura
