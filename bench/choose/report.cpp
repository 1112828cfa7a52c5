#include "bench/choose/report.h"

#include "base/csv.h"
#include "base/error.h"
#include "base/files.h"
#include "bench/sweep/pareto.h"
#include "renderer/techniques/settings.h"
#include "report/gnuplot.h"
#include "report/paper_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

namespace obscura {

namespace {

const char* nameOf(Rung rung) {
    switch (rung) {
    case Rung::glance:
        return "looked at";
    case Rung::held_out:
        return "measured";
    case Rung::chosen:
        break;
    }
    return "chosen";
}

const std::string& nameOf(const Candidate& candidate) {
    return candidate.configuration.setting.name;
}

std::string limitsOf(const Budget& budget) {
    std::string text;
    const auto add = [&](const char* name, const std::optional<double>& most) {
        if (most)
            text += fmt::format("{}{} at most {:g}", text.empty() ? "" : ", ", name, *most);
    };
    add("RMSE", budget.rmse);
    add("FLIP", budget.flip);
    add("FLIP of the lit image", budget.litFlip);
    add("flicker", budget.flicker);
    add("milliseconds", budget.milliseconds);
    for (const std::string& test : budget.failures)
        text += (text.empty() ? "no failure of " : ", no failure of ") + test;
    return text;
}

// The candidates that would add something: those beyond the chosen one on the front at a glance,
// except for those that were measured and failed.
std::vector<const Candidate*> dearer(const Choice& choice) {
    std::vector<const Candidate*> result;
    double best = choice.candidates[*choice.chosen].glanceRmse;
    for (std::size_t i = *choice.chosen + 1; i < choice.candidates.size(); ++i)
        if (choice.candidates[i].glanceRmse < best &&
            !(choice.candidates[i].rung == Rung::held_out &&
              !choice.candidates[i].verdict.empty())) {
            best = choice.candidates[i].glanceRmse;
            result.push_back(&choice.candidates[i]);
        }
    return result;
}

constexpr std::string_view fragmentHead =
    "# Written by obscura-bench choose; a protocol takes it by include = [\"choice.toml\"].\n";

std::string fragment(const SweepStudy& study, const Budget& budget, const Candidate& candidate) {
    std::string text(fragmentHead);
    text += fmt::format(
        "# The cheapest of {} candidates with {}\n# on views that it was not fitted on ({} x {}): "
        "RMSE {:.4f}, {:.3g} ms.\n[techniques.chosen] # {}\ntechnique = \"{}\"\n",
        study.match.techniques.size(), limitsOf(budget), study.sizes.front().width,
        study.sizes.front().height, candidate.rmse, candidate.milliseconds, nameOf(candidate),
        candidate.configuration.setting.technique);
    if (candidate.configuration.setting.preset)
        text += fmt::format("preset = \"{}\"\n", candidate.configuration.setting.preset->name);
    for (const Setting& given : candidate.configuration.setting.settings)
        text += fmt::format("{} = {}\n", given.name, given.value);
    for (const auto& [name, value] : candidate.configuration.fitted)
        text += fmt::format("{} = {}\n", name, value);
    return text;
}

std::string cell(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }

std::string table(const Choice& choice) {
    std::string text = "configuration,rung,glance_ms,ms,glance_rmse,rmse,verdict\n";
    for (const Candidate& candidate : choice.candidates)
        text += fmt::format("{},{},{},{},{},{},{}\n", csvCell(nameOf(candidate)),
                            nameOf(candidate.rung), candidate.glanceMilliseconds,
                            cell(candidate.milliseconds), cell(candidate.glanceRmse),
                            cell(candidate.rmse), csvCell(candidate.verdict));
    return text;
}

// A candidate that takes no time has no logarithm and stands at the chart's left edge.
std::string line(const Candidate& candidate, double least) {
    std::vector<double> rmse;
    for (const ViewResult& view : candidate.views)
        rmse.push_back(view.rmse);
    return fmt::format("{} {} {} \"{}\" {} {}\n", std::max(candidate.glanceMilliseconds, least),
                       candidate.glanceRmse, candidate.rmse, nameOf(candidate), upperBound(rmse),
                       std::max(candidate.milliseconds, least));
}

bool isFinalist(const Candidate& candidate) { return !std::isnan(candidate.milliseconds); }

std::string lines(const Choice& choice, double least,
                  const std::function<bool(const Candidate&)>& wanted) {
    std::string text;
    for (const Candidate& candidate : choice.candidates)
        if (wanted(candidate))
            text += line(candidate, least);
    return text;
}

// All candidates were seen alike at a glance, so there they can be compared.
std::string glanceFront(const Choice& choice, double least) {
    std::vector<ParetoPoint> points;
    for (const Candidate& candidate : choice.candidates)
        points.push_back({std::max(candidate.glanceMilliseconds, least), candidate.glanceRmse,
                          nameOf(candidate)});
    std::string text;
    for (const std::size_t i : paretoFront(points))
        text += fmt::format("{} {}\n", points[i].milliseconds, points[i].error);
    return text;
}

struct Series {
    std::string style, title, data; // data: gnuplot's lines
};

// What has no data is left out: gnuplot ends with a segmentation fault where all of a series is
// NaN.
std::string plotOf(std::span<const Series> all) {
    std::string plots, data;
    for (const Series& series : all) {
        if (series.data.empty())
            continue;
        plots +=
            fmt::format("{} '-' {} {}", plots.empty() ? "plot" : ",", series.style,
                        series.title.empty() ? "notitle" : "title " + gnuplotText(series.title));
        data += series.data + "e\n";
    }
    return plots + "\n" + data;
}

Figure figureOf(const SweepStudy& study, const Budget& budget, const Choice& choice) {
    double least = 1e9;
    for (const Candidate& candidate : choice.candidates)
        if (candidate.glanceMilliseconds > 0)
            least = std::min(least, candidate.glanceMilliseconds);
    least /= 2;
    Figure figure{"choice", "Time against error of the candidates, and the choice", "", 8, 5.5};
    figure.script = fmt::format(
        "set logscale x\nset xlabel {}\nset ylabel {}\nset key outside below\nset bmargin 7\nset "
        "grid lc rgb "
        "'#dddddd'\nset yrange [0:*]\nset xrange [{}:*]\n",
        gnuplotText(fmt::format("milliseconds at {} x {} (logarithmic; free ones at the left edge)",
                                study.sizes.front().width, study.sizes.front().height)),
        gnuplotText("RMSE of matched visibility"), least * 0.9);
    if (budget.rmse)
        figure.script += fmt::format("set arrow from graph 0, first {0} to graph 1, first {0} "
                                     "nohead dashtype 2 lc rgb '#D55E00'\nset label {1} at graph "
                                     "0.99, first {0} right offset 0, 0.6 tc rgb '#D55E00'\n",
                                     *budget.rmse, gnuplotText("budget"));
    const auto all = [](const Candidate&) { return true; };
    const auto failed = [](const Candidate& candidate) {
        return candidate.rung == Rung::held_out && !isFinalist(candidate);
    };
    const std::string chosen = lines(
        choice, least, [](const Candidate& candidate) { return candidate.rung == Rung::chosen; });
    const Series series[] = {
        {"using 1:2 with steps lc rgb '#888888'", "Pareto front at a glance",
         glanceFront(choice, least)},
        {"using 1:2 with points pt 6 ps 0.8 lc rgb '#888888'", "at a glance: small, one view",
         lines(choice, least, all)},
        {"using 1:3:3:5 with yerrorbars pt 7 ps 1 lc rgb '#0072B2'",
         "RMSE on held-out views, mean and 95 % bound", lines(choice, least, failed)},
        {"using 6:3:3:5 with yerrorbars pt 5 ps 1 lc rgb '#E69F00'",
         "finalists: also time on held-out views", lines(choice, least, isFinalist)},
        {"using 6:3 with points pt 7 ps 1.8 lc rgb '#009E73'", "chosen", chosen},
        {"using 6:3:4 with labels left offset 1.2, 0", "", chosen}};
    figure.script += plotOf(series);
    return figure;
}

} // namespace

std::string choiceText(const SweepStudy& study, const Budget& budget, const Choice& choice) {
    std::string text = fmt::format(
        "{} candidates, {} held-out views, {}; {:.0f} s besides references of held-out views\n",
        choice.candidates.size(), study.match.test.size(), limitsOf(budget), choice.seconds);
    const auto add = [&](const Candidate& candidate, const std::string& words) {
        text += fmt::format("  {:<34} {:>8.3g} ms  {}", nameOf(candidate),
                            candidate.glanceMilliseconds, words);
        text += isFinalist(candidate)
                    ? fmt::format("; {:.3g} ms on held-out views\n", candidate.milliseconds)
                    : "\n";
    };
    if (!choice.chosen) {
        text += "None meets the budget. Why, the cheapest at a glance first:\n";
        for (const Candidate& candidate : choice.candidates)
            add(candidate, candidate.verdict);
        return text;
    }
    const Candidate& chosen = choice.candidates[*choice.chosen];
    text += fmt::format("Chosen: {}, {:.3g} ms, RMSE {:.3f} on held-out views; at a glance {:.3g} "
                        "ms, RMSE {:.3f}\n",
                        nameOf(chosen), chosen.milliseconds, chosen.rmse, chosen.glanceMilliseconds,
                        chosen.glanceRmse);
    text += *choice.chosen ? "Cheaper ones at a glance, and why not:\n" : "";
    for (std::size_t i = 0; i < *choice.chosen; ++i)
        add(choice.candidates[i], choice.candidates[i].verdict);
    const auto more = dearer(choice);
    text += more.empty() ? "Nothing dearer adds anything.\n"
                         : "What dearer ones would add at a glance:\n";
    for (const Candidate* candidate : more)
        add(*candidate, fmt::format("RMSE {:.3f}", candidate->glanceRmse));
    return text;
}

void requireOwnChoice(const std::filesystem::path& folder) {
    const std::filesystem::path path = folder / "choice.toml";
    if (!std::filesystem::exists(std::filesystem::symlink_status(path)))
        return;
    if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(path)) ||
        !readFile(path).starts_with(fragmentHead))
        throw Error(
            {path.string(), 0, 0, {}},
            "expected a choice that obscura-bench choose wrote, which a new one replaces, or "
            "nothing; found something else. Move it, or name another folder by --out");
}

void writeChoice(const std::filesystem::path& folder, const SweepStudy& study, const Budget& budget,
                 const Choice& choice) {
    writeFile(folder / "choice.csv", table(choice));
    requireOwnChoice(folder);
    if (choice.chosen)
        writeFile(folder / "choice.toml",
                  fragment(study, budget, choice.candidates[*choice.chosen]));
    else
        std::filesystem::remove(folder / "choice.toml"); // ours, of an earlier budget
    writeFigures(folder, {figureOf(study, budget, choice)});
}

} // namespace obscura
