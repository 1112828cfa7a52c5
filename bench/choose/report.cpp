#include "bench/choose/report.h"

#include "base/csv.h"
#include "base/error.h"
#include "base/files.h"
#include "bench/choose/figure.h"
#include "bench/choose/study_file.h"
#include "bench/choose/words.h"
#include "renderer/techniques/settings.h"
#include "report/lettering.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

namespace fs = std::filesystem;

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

constexpr std::string_view fragmentHead =
    "# Written by obscura-bench choose; a protocol takes it by include = [\"choice.toml\"].\n";

std::string fragment(const SweepStudy& study, const Budget& budget, const Choice& choice) {
    const Candidate& chosen = choice.candidates[*choice.chosen];
    const Headline headline = headlineOf(study, budget, choice);
    std::string text = fmt::format(
        "{}# {}\n# {}\n# At {} x {}; {}, {}.\n[techniques.chosen] # {}\ntechnique = \"{}\"\n",
        fragmentHead, headline.answer, headline.reason, study.sizes.front().width,
        study.sizes.front().height, choice.machine.renderer, choice.machine.program, nameOf(chosen),
        chosen.configuration.setting.technique);
    if (chosen.configuration.setting.preset)
        text += fmt::format("preset = \"{}\"\n", chosen.configuration.setting.preset->name);
    for (const Setting& given : chosen.configuration.setting.settings)
        text += fmt::format("{} = {}\n", given.name, given.value);
    for (const auto& [name, value] : chosen.configuration.fitted)
        text += fmt::format("{} = {}\n", name, value);
    return text;
}

std::string cell(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

std::string table(const Choice& choice) {
    std::string text = "configuration,rung,glance_ms,ms,glance_rmse,training,rmse,verdict\n";
    for (const Candidate& candidate : choice.candidates)
        text +=
            fmt::format("{},{},{},{},{},{},{},{}\n", csvCell(nameOf(candidate)),
                        nameOf(candidate.rung), cell(candidate.glanceMilliseconds),
                        cell(candidate.milliseconds), cell(candidate.glanceRmse),
                        cell(candidate.training), cell(candidate.rmse), csvCell(candidate.verdict));
    return text;
}

std::string viewsTable(const SweepStudy& study, const Budget& budget, const Choice& choice) {
    std::string text = "configuration,view,radius,ms_95,rmse,flip,lit_flip,jod,flicker\n";
    for (const Candidate& candidate : choice.candidates)
        for (std::size_t i = 0; i < candidate.views.size(); ++i) {
            const ViewResult& view = candidate.views[i];
            text += fmt::format("{},{},{},{},{},{},{},{},{}\n", csvCell(nameOf(candidate)),
                                csvCell(study.match.test[i].name), study.match.test[i].radius,
                                cell(view.milliseconds), cell(view.rmse), cell(view.flip),
                                cell(view.litFlip), cell(view.jod),
                                budget.flicker && view.flicker > 0 ? cell(view.flicker) : "");
        }
    return text;
}

std::string facts(const SweepStudy& study, const Budget& budget, const Choice& choice) {
    const Headline headline = headlineOf(study, budget, choice);
    nlohmann::ordered_json root;
    root["formatVersion"] = 1;
    root["asked"] = inWords(budget);
    root["answer"] = headline.answer;
    root["reason"] = headline.reason;
    root["chosen"] = choice.chosen
                         ? nlohmann::ordered_json(nameOf(choice.candidates[*choice.chosen]))
                         : nlohmann::ordered_json();
    root["confidence"] = boundLevel;
    root["size"] = {study.sizes.front().width, study.sizes.front().height};
    const SweepMachine& machine = choice.machine;
    root["machine"] = {{"vendor", machine.vendor},       {"renderer", machine.renderer},
                       {"glVersion", machine.glVersion}, {"processor", machine.processor},
                       {"clocks", machine.clocks},       {"method", machine.method}};
    root["program"] = machine.program;
    root["date"] = machine.date;
    root["seconds"] = choice.seconds;
    return root.dump(2) + "\n";
}

std::string line(const Candidate& candidate, const std::string& words) {
    return fmt::format("  {:<34} {:>8.3g} ms  {}\n", nameOf(candidate), costOf(candidate), words);
}

// The candidates that would add something: those dearer than the chosen one that are better than
// it and than any between, measured where it was, or else at a glance; those that failed left out.
std::string dearerOnes(const Choice& choice) {
    const Candidate& chosen = choice.candidates[*choice.chosen];
    double measured = chosen.rmse, glanced = chosen.glanceRmse;
    std::string text;
    for (const Candidate& candidate : choice.candidates) {
        const bool atAGlance = candidate.rung == Rung::glance;
        const double rmse = atAGlance ? candidate.glanceRmse : candidate.rmse;
        double& best = atAGlance ? glanced : measured;
        if (costOf(candidate) <= costOf(chosen) || !(rmse < best) ||
            (!atAGlance && !candidate.verdict.empty()))
            continue;
        best = rmse;
        text += line(candidate, atAGlance ? fmt::format("RMSE {:.3f} at a glance, not {:.3f}", rmse,
                                                        chosen.glanceRmse)
                                          : fmt::format("RMSE {:.3f}", rmse));
    }
    return text.empty() ? "Nothing dearer adds anything.\n"
                        : "What dearer ones would add:\n" + text;
}

// Candidates with why they fell out: each on a line of its own, or together those of one reason.
std::string reasons(const std::vector<const Candidate*>& candidates) {
    std::vector<std::pair<std::string, std::vector<const Candidate*>>> byVerdict;
    for (const Candidate* candidate : candidates) {
        const std::string& verdict = candidate->verdict;
        auto known = std::find_if(byVerdict.begin(), byVerdict.end(),
                                  [&](const auto& each) { return each.first == verdict; });
        if (known == byVerdict.end())
            known = byVerdict.insert(known, {verdict, {}});
        known->second.push_back(candidate);
    }
    std::string text;
    for (const auto& [verdict, some] : byVerdict) {
        if (some.size() == 1) {
            text += line(*some.front(), verdict);
            continue;
        }
        std::string names;
        for (const Candidate* candidate : some)
            names += (names.empty() ? "" : ", ") + nameOf(*candidate);
        text += "  " + verdict + ":\n";
        for (const std::string& part : wrapped(names, 96))
            text += "    " + part + "\n";
    }
    return text;
}

// Why cheaper ones were not chosen; asked for the best, why better ones were not.
std::string othersNot(const Budget& budget, const Choice& choice) {
    std::vector<const Candidate*> others;
    const Candidate& chosen = choice.candidates[*choice.chosen];
    for (const Candidate& candidate : choice.candidates) {
        const bool better = budget.best ? candidate.rung != Rung::glance &&
                                              worth(budget, candidate) < worth(budget, chosen)
                                        : costOf(candidate) < costOf(chosen);
        if (better && !candidate.verdict.empty())
            others.push_back(&candidate);
    }
    return others.empty() ? ""
                          : fmt::format("{} ones, and why not:\n{}",
                                        budget.best ? "Better" : "Cheaper", reasons(others));
}

std::string alikeOnes(const Budget& budget, const Choice& choice) {
    std::string text;
    for (const std::size_t i : choice.alike)
        text += line(choice.candidates[i],
                     fmt::format("{} {:.4g}", budget.best->spelt,
                                 meanOf(choice.candidates[i].views, budget.best->value)));
    return text.empty() ? "" : "Those that the views do not tell from it:\n" + text;
}

// When nothing was found: what was measured, the nearest first, and then the rest.
std::string nearestOnes(const Budget& budget, const Choice& choice) {
    std::string text = "Nearest first:\n";
    for (const Candidate* candidate : nearestFirst(budget, choice)) {
        text += line(*candidate, candidate->verdict);
        if (const std::string words = whatWouldAdmit(budget, *candidate); !words.empty())
            text += fmt::format("  {:>37} {}\n", "", words);
    }
    std::vector<const Candidate*> others;
    for (const Candidate& candidate : choice.candidates)
        if (candidate.rung == Rung::glance)
            others.push_back(&candidate);
    return text + (others.empty() ? "" : "Not measured:\n" + reasons(others));
}

} // namespace

std::string choiceText(const SweepStudy& study, const Budget& budget, const Choice& choice) {
    const Headline headline = headlineOf(study, budget, choice);
    std::string text = fmt::format("{}\n{}\n", headline.answer, headline.reason);
    if (!choice.chosen)
        text += nearestOnes(budget, choice);
    else
        text += alikeOnes(budget, choice) + othersNot(budget, choice) +
                (budget.best ? "" : dearerOnes(choice));
    return text + fmt::format("The search took {:.0f} s besides references of held-out views.\n",
                              choice.seconds);
}

void requireOwnChoice(const fs::path& folder) {
    const std::pair<const char*, std::string_view> ours[] = {{"choice.toml", fragmentHead},
                                                             {"study.toml", studyTextHead}};
    for (const auto& [name, head] : ours) {
        const fs::path path = folder / name;
        if (!fs::exists(fs::symlink_status(path)))
            continue;
        if (!fs::is_regular_file(fs::symlink_status(path)) || !readFile(path).starts_with(head))
            throw Error({path.string(), 0, 0, {}},
                        "expected a file that obscura-bench choose wrote, which a new one "
                        "replaces, or nothing; found something else. Move it, or name another "
                        "folder by --out");
    }
}

void writeChoice(const fs::path& folder, const SweepStudy& study, const fs::path& environments,
                 const Budget& budget, const Choice& choice) {
    requireOwnChoice(folder);
    writeFile(folder / "choice.csv", table(choice));
    writeFile(folder / "choice-views.csv", viewsTable(study, budget, choice));
    writeFile(folder / "choice.json", facts(study, budget, choice));
    writeFile(folder / "study.toml", studyText(study, environments.string()));
    if (choice.chosen)
        writeFile(folder / "choice.toml", fragment(study, budget, choice));
    else
        fs::remove(folder / "choice.toml"); // ours, of an earlier budget
    if (!choice.candidates.empty())
        writeFigures(folder, {choiceFigure(study, budget, choice)});
}

} // namespace obscura
