#include "analysis/methods_text.h"

#include "base/version.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace obscura {

namespace {

// In their order, each once.
std::vector<std::string> distinct(const std::vector<Tally>& tallies, std::string Tally::*member) {
    std::vector<std::string> texts;
    for (const Tally& tally : tallies)
        if (!(tally.*member).empty() &&
            std::find(texts.begin(), texts.end(), tally.*member) == texts.end())
            texts.push_back(tally.*member);
    return texts;
}

std::string counted(std::size_t number, const char* noun) {
    return fmt::format("{} {}{}", number, noun, number == 1 ? "" : "s");
}

std::string conditions(const Findings& findings) {
    const std::vector<std::string> levels = distinct(findings.tallies, &Tally::level),
                                   scenes = distinct(findings.tallies, &Tally::scene);
    std::vector<std::string> pairs;
    for (const Tally& tally : findings.tallies)
        if (const std::string pair = fmt::format("{} with {}", tally.techniqueA, tally.techniqueB);
            std::find(pairs.begin(), pairs.end(), pair) == pairs.end())
            pairs.push_back(pair);
    return fmt::format("{} of pairs of images compared {}, in {} ({}) at {} of complexity ({}).",
                       counted(findings.tallies.size(), "condition"), fmt::join(pairs, ", "),
                       counted(scenes.size(), "scene"), fmt::join(scenes, ", "),
                       counted(levels.size(), "level"), fmt::join(levels, ", "));
}

std::string secondsSentence(const Percentiles& ms) {
    return fmt::format("{:.2f} s (median; 5th to 95th percentile {:.2f} to {:.2f} s)",
                       ms.median / 1000, ms.low / 1000, ms.high / 1000);
}

std::string orderWithin(const Conduct& conduct) {
    int first = 0, second = 0;
    for (const auto& [condition, shown] : conduct.shown) {
        first += shown.bFirst;
        second += shown.bSecond;
    }
    return fmt::format("Image b came second in {} of {} trials.", second, first + second);
}

std::string participants(const Conduct& c) {
    std::string text;
    if (c.simulated > 0)
        text = fmt::format("SIMULATED: {} of {} trials were answered by a program. ", c.simulated,
                           c.trials);
    const std::string first = c.firstTime.substr(0, 10), last = c.lastTime.substr(0, 10);
    text +=
        fmt::format("{} took part in {} {} (UTC) and gave {} that count.",
                    counted(static_cast<std::size_t>(c.participants), "participant"),
                    counted(static_cast<std::size_t>(c.sessions), "session"),
                    first == last ? "on " + first : fmt::format("between {} and {}", first, last),
                    counted(static_cast<std::size_t>(c.trials), "answer"));
    std::vector<std::string> losses;
    for (const auto* some : {&c.flow.unanswered, &c.flow.excluded})
        for (const Flow::Loss& loss : *some)
            losses.push_back(fmt::format("{} {}", loss.count, loss.reason));
    if (!losses.empty())
        text += fmt::format(" Sessions that do not count: {}.", fmt::join(losses, "; "));
    losses.clear();
    for (const Flow::Loss& loss : c.flow.leftOut)
        losses.push_back(fmt::format("{} {}", loss.count, loss.reason));
    if (!losses.empty())
        text += fmt::format(" Single trials left out: {}.", fmt::join(losses, "; "));
    return text + " [Add: how they were recruited, their age, sight and experience, consent.]";
}

std::string procedure(const Conduct& c) {
    return fmt::format("In each trial the two images of a pair were seen one after the other, for "
                       "as long as the participant wished, with a grey mask of {} between them; "
                       "then the participant chose one. {} [Add: the words of the question.]",
                       secondsSentence(c.maskMs), orderWithin(c));
}

std::string apparatus(const Conduct& c) {
    std::vector<std::string> sources;
    for (const auto& [source, trials] : c.timestampSources)
        sources.push_back(fmt::format("{} ({} of {} trials)",
                                      source == "none" ? "no vertical blank, not fit for claims "
                                                         "about timing"
                                                       : source,
                                      trials, c.trials));
    const std::string rate = c.slowestHz == c.fastestHz
                                 ? fmt::format("{:.2f} Hz", c.slowestHz)
                                 : fmt::format("{:.2f} to {:.2f} Hz", c.slowestHz, c.fastestHz);
    return fmt::format(
        "Images were shown by obscura-experiment {} on {} at {}. Times of their onset "
        "come from: {}. {} of {} trials had a missed frame, {} a mask of other than "
        "the planned length. [Add: display, its luminance and calibration, distance "
        "of the eyes, light of the room.]",
        fmt::join(c.programs, ", "), counted(c.machines.size(), "computer"), rate,
        fmt::join(sources, ", "), c.missedFrames, c.trials, c.wrongMasks);
}

std::string claimsOf(const Findings& findings) {
    if (findings.claims.empty())
        return "No claim was declared before the data; all results are exploratory.";
    std::vector<std::string> texts;
    for (const ClaimResult& result : findings.claims)
        texts.push_back(fmt::format("“{}” ({})", result.claim.name,
                                    result.method.empty() ? "not tested" : result.method));
    return fmt::format("Declared before the data, each tested among people of whom each counts "
                       "once, and corrected by Holm (1979) within its family: {}.",
                       fmt::join(texts, "; "));
}

// Of scales that answer the question, not of those beside them.
std::string scalesOf(const Findings& findings) {
    std::vector<std::string> texts;
    for (const auto& [kind, result] : findings.scales.all) {
        if (!kind->isLeading || result.items.empty() || result.curve)
            continue;
        std::string text = fmt::format("{} (in {}; {}; intervals: {})", kind->heading, result.unit,
                                       kind->source, result.intervals);
        if (std::find(texts.begin(), texts.end(), text) == texts.end())
            texts.push_back(std::move(text));
    }
    std::string said = texts.empty() ? "" : fmt::format(" Scales: {}.", fmt::join(texts, "; "));
    if (findings.stimuli && findings.stimuli->display)
        said += fmt::format(" JOD were predicted by ColorVideoVDP (Mantiuk et al. 2024) for a "
                            "display of {}.",
                            inWords(*findings.stimuli->display));
    if (findings.stimuli && findings.stimuli->timing)
        said +=
            fmt::format(" Times of techniques: {} ({}, {}).", findings.stimuli->timing->method,
                        findings.stimuli->timing->renderer, findings.stimuli->timing->processor);
    return said;
}

std::string analysis(const Findings& findings) {
    std::vector<std::string> sources;
    for (const Tested& tested : findings.tests)
        if (std::find(sources.begin(), sources.end(), tested.kind->source) == sources.end())
            sources.emplace_back(tested.kind->source);
    std::string text = claimsOf(findings);
    if (!findings.tallies.empty())
        text +=
            fmt::format(" Of each condition, the votes for a and b were compared with an even "
                        "split by the exact two-sided binomial test at .05, with p corrected by "
                        "Holm within each {} and intervals of 95 % by Clopper and Pearson (1934).",
                        findings.claims.empty() ? "hypothesis" : "claim");
    text += scalesOf(findings);
    if (!sources.empty())
        text += fmt::format(" Beyond single conditions, without correction: {}.",
                            fmt::join(sources, "; "));
    return text + fmt::format(" Software: obscura-analysis {} (commit {}).", version(), commit());
}

} // namespace

std::string renderedBy(const Manifest& stimuli) {
    std::set<std::string> makers;
    for (const ConditionRecord& condition : stimuli.conditions)
        for (const ImageRecord& image : condition.images)
            makers.insert(fmt::format("obscura-stimuli {} ({}), OpenGL {}, {}, {}",
                                      image.recipe.programVersion, stimuli.commit,
                                      image.recipe.glVersion, image.recipe.glRenderer,
                                      image.recipe.glVendor));
    return fmt::format("{} × {} pixels, by {}", stimuli.width, stimuli.height,
                       fmt::join(makers, "; "));
}

std::vector<std::string> methodsText(const Findings& findings) {
    std::vector<std::string> paragraphs = {
        fmt::format("“{}.” {}", findings.title, conditions(findings))};
    if (findings.stimuli)
        paragraphs[0] +=
            fmt::format(" The images were rendered: {}.", renderedBy(*findings.stimuli));
    if (findings.conduct) {
        const Conduct& conduct = *findings.conduct;
        paragraphs[0] += " " + procedure(conduct);
        paragraphs.push_back(participants(conduct));
        paragraphs.push_back(apparatus(conduct));
    } else {
        paragraphs.emplace_back("The counts were published. [Add: where; and participants, "
                                "procedure and apparatus, which counts cannot tell.]");
    }
    paragraphs.push_back(analysis(findings));
    if (findings.conduct)
        paragraphs.back() += fmt::format(" SHA-256 of the protocol: {}.",
                                         fmt::join(findings.conduct->protocols, ", "));
    return paragraphs;
}

} // namespace obscura
