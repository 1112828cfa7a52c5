#include "analysis/plan/power_curves.h"

#include "report/gnuplot.h"
#include "report/marks.h"

#include <fmt/format.h>

namespace obscura {

namespace {

constexpr const char* style = R"(set xrange [50:90]
set yrange [0:100]
set xtics 50, 5, 90 nomirror out format '%.0f %%'
set ytics 0, 20, 100 nomirror out format '%.0f %%'
set ylabel 'chance to find it'
set key outside above left maxcols 1 Left reverse spacing 1.3
set rmargin 4
set arrow from 50, WANTED to 90, WANTED nohead linewidth 1 dashtype 3 linecolor rgb '#333333'
)";

std::string styleFor(const Plan& plan) {
    std::string text = style;
    const std::string wanted = fmt::format("{:g}", 100 * plan.options.power);
    for (std::size_t at = text.find("WANTED"); at != std::string::npos; at = text.find("WANTED"))
        text.replace(at, 6, wanted);
    return text + "set xlabel " +
           gnuplotText(fmt::format("true share of the claimed image (of a trend: at the highest "
                                   "score), N = {}",
                                   plan.people)) +
           "\n";
}

} // namespace

Figure powerCurves(const Plan& plan) {
    std::string data;
    std::vector<std::string> elements;
    std::size_t series = 0;
    for (const PlannedTest& test : plan.tests) {
        if (test.claim.kind == Claim::Kind::equivalent)
            continue;
        std::string points;
        for (const EffectPower& effect : test.effects)
            points += fmt::format("{} {:.5f}\n", 100 * effect.share, 100 * effect.power.share);
        const std::string name = fmt::format("claim{}", series);
        data += plot::block(name, points);
        elements.push_back(
            fmt::format("${} using 1:2 with linespoints linewidth 2 {} title {}", name,
                        plot::pointStyle(series),
                        gnuplotText(test.claim.name + (test.exact ? "" : " (simulated)"))));
        ++series;
    }
    if (elements.empty())
        elements.emplace_back("NaN notitle");
    return {"power", "What the study can find",
            plot::style + styleFor(plan) + data + "plot " + plot::list(elements) + "\n", 6.5,
            3.6 + 0.25 * static_cast<double>(series)};
}

} // namespace obscura
