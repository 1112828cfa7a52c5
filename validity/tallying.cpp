#include "validity/tallying.h"

#include "analysis/claims.h"
#include "analysis/scales/scale_kinds.h"
#include "analysis/study_tests.h"
#include "analysis/verdict.h"
#include "base/files.h"
#include "base/parallel.h"

#include "inference/counts.h"
#include "inference/tails.h"
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <mutex>
#include <set>

namespace obscura {

namespace {

namespace fs = std::filesystem;

constexpr const char* ninety = " (90 %)"; // ends the names of intervals that are no 95 % ones

bool holds(const Interval& interval, double truth) {
    return interval.low <= truth && truth <= interval.high;
}

// Statistics of the first condition: its people are different ones.
void addCounts(const Tally& tally, double share, Outcomes& outcomes) {
    const Votes votes = tally.votes;
    const auto rejected = [&](const char* name, double p) {
        outcomes.rejected[fmt::format("condition: {}", name)].add(p < significance);
    };
    rejected("exact binomial", exactP(votes));
    rejected("mid-p", midP(votes));
    rejected("chi-square", chiSquareP(chiSquare(votes)));
    rejected("chi-square, Yates", chiSquareP(chiSquareYates(votes)));
    outcomes.covered["share: Clopper and Pearson"].add(
        holds(clopperPearson(votes.b, votes.total()), share));
    outcomes.covered["share: Wilson"].add(holds(wilson(votes.b, votes.total()), share));
    outcomes.covered["share: Jeffreys"].add(holds(jeffreys(votes.b, votes.total()), share));
}

void addClaims(const std::vector<ClaimResult>& claims, const Truth& truth, Outcomes& outcomes) {
    bool any = false;
    for (const ClaimResult& claim : claims) {
        const std::string name = fmt::format("claim: {}", claim.claim.name);
        if (claim.test)
            outcomes.rejected[name].add(claim.test->p < significance);
        outcomes.supported[claim.claim.name].add(claim.outcome == ClaimResult::Outcome::supported);
        any = any || (claim.claim.kind != Claim::Kind::equivalent && claim.holm < significance);
        if (!claim.interval)
            continue;
        // Of the people who changed, half did so in either direction: no world has a trend.
        const bool isRise = claim.measure.starts_with("rise");
        const double expected = isRise                                   ? 0
                                : claim.claim.kind == Claim::Kind::trend ? 0.5
                                                                         : truth.shares[0];
        outcomes.covered[claim.confidence == 90 ? name + ninety : name].add(
            holds(*claim.interval, expected));
    }
    if (!claims.empty())
        outcomes.anyClaim.add(any);
}

// What is tested: models test several things.
std::string nameOf(const Tested& tested) {
    const std::string& about = tested.result.about;
    return fmt::format("test {}{}", tested.kind->id,
                       about.starts_with("position:")                  ? ", position"
                       : about.starts_with("do the conditions differ") ? ", conditions"
                                                                       : "");
}

// Of tests of one name the first: those of one study depend on each other.
void addTests(const StudyData& data, Outcomes& outcomes) {
    std::set<std::string> done;
    for (const Tested& tested : testsOf(data))
        if (const std::string name = nameOf(tested); tested.result.test && done.insert(name).second)
            outcomes.rejected[name].add(tested.result.test->p < significance);
}

// The first technique is the origin.
void addScale(const ScaleData& data, const std::vector<double>& truth, Outcomes& outcomes) {
    for (const ScaleResult& scale : thurstoneScales(data)) {
        for (const ScaleDiagnostic& diagnostic : scale.diagnostics)
            if (diagnostic.test)
                outcomes.rejected["scale: " + diagnostic.name.substr(0, diagnostic.name.find(','))]
                    .add(diagnostic.test->p < significance);
        for (std::size_t i = 1; i < scale.items.size(); ++i) {
            const auto& [low, high] = scale.items[i].interval;
            outcomes.covered[fmt::format("scale: technique {} (JOD)", i + 1)].add(
                (!low || *low <= truth[i]) && (!high || truth[i] <= *high));
        }
    }
}

Outcomes analysed(const fs::path& file, const World& world, const Protocol& protocol) {
    Outcomes outcomes;
    const std::vector<fs::path> data = {file};
    std::vector<std::string> order;
    for (const Condition& condition : protocol.conditions)
        order.push_back(condition.id);
    const Answers answers = collectAnswers(data, AnswerRules());
    const std::vector<Tally> tallies = tallyVotes(answers.counted, nullptr, order);
    for (const Tally& tally : tallies)
        if (tally.condition == "c1" && tally.votes.total() == world.people)
            addCounts(tally, world.truth.shares[0], outcomes);
    addClaims(testClaims(protocol.claims, tallies, &answers.counted), world.truth, outcomes);
    addTests(studyData(tallies, &answers.counted), outcomes);
    addTests(studyData(tallies, nullptr), outcomes); // as if only totals were published
    if (!world.scale.empty())
        addScale(scaleData(tallies, &answers.counted, nullptr), world.scale, outcomes);
    return outcomes;
}

void join(std::map<std::string, Rate>& all, const std::map<std::string, Rate>& some) {
    for (const auto& [name, rate] : some) {
        all[name].hits += rate.hits;
        all[name].of += rate.of;
    }
}

std::string rateText(const Rate& rate) {
    const Interval interval = clopperPearson(rate.hits, rate.of);
    return fmt::format("{:.2f} ({:.2f} to {:.2f})", 100.0 * rate.hits / rate.of, 100 * interval.low,
                       100 * interval.high);
}

double shareOf(const Rate& rate) { return static_cast<double>(rate.hits) / rate.of; }

// By the rate itself; but a promise is broken only where chance alone would not break it so.
std::string sizeVerdict(const Rate& rate) {
    const double share = shareOf(rate);
    if (share > 0.055)
        return clopperPearson(rate.hits, rate.of).low > 0.05 ? "**too often**" : "may be chance";
    return share < 0.045 ? "below" : "holds";
}

std::string coverVerdict(const std::string& name, const Rate& rate) {
    const double nominal = name.ends_with(ninety) ? 0.9 : 0.95;
    const double above = shareOf(rate) - nominal;
    if (above < -0.01)
        return clopperPearson(rate.hits, rate.of).high < nominal ? "**too seldom**"
                                                                 : "may be chance";
    return above > 0.01 ? "above" : "holds";
}

// What is known of why a kind of test promises too much; "" where nothing is.
std::string_view reasonOf(std::string_view name) {
    if (name.starts_with("test logistic"))
        return "chi-square is what the statistic tends to with many people, and there are few";
    if (name == "test mixed, conditions")
        return "chi-square is what the statistic tends to with many people, and there are few: of "
               "56 it rejected in 5.2 %";
    if (name.starts_with("test people"))
        return "chi-square approximates a distribution of few possible values";
    return {};
}

// Every broken promise of every world.
std::string failures(const std::vector<World>& all, const std::vector<Outcomes>& outcomes) {
    std::string words;
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (const auto& [name, rate] : outcomes[i].rejected)
            if (all[i].isNull(name) && sizeVerdict(rate).starts_with("**"))
                words += fmt::format("- {}, in \"{}\": rejects in {} % of studies{}{}.\n", name,
                                     all[i].name, rateText(rate),
                                     reasonOf(name).empty() ? "" : "; ", reasonOf(name));
        for (const auto& [name, rate] : outcomes[i].covered)
            if (coverVerdict(name, rate).starts_with("**"))
                words += fmt::format("- interval of {}, in \"{}\": holds the truth in {} % of "
                                     "studies.\n",
                                     name, all[i].name, rateText(rate));
    }
    return "## Promises that are not kept\n\n" + (words.empty() ? "None.\n" : words) + "\n";
}

std::string worldText(const World& world, const Outcomes& outcomes,
                      const std::map<std::string, double>& planned, int studies) {
    std::string words = fmt::format("## {}\n\nThe truth: {}. {} studies of {} people.\n\n",
                                    world.name, world.words, studies, world.people);
    std::string nulls, powers;
    for (const auto& [name, rate] : outcomes.rejected) {
        const bool isNull = world.isNull(name);
        (isNull ? nulls : powers) +=
            fmt::format("| {} | {} | {} |\n", name, rateText(rate),
                        isNull ? sizeVerdict(rate) : fmt::format("{}", rate.of));
    }
    words += "Nothing to find; p < .05 in so many percent of studies (nominal: 5):\n\n"
             "| test | rejected, % (95 % interval) | 4.5 to 5.5 % |\n|---|---|---|\n" +
             nulls;
    if (!powers.empty())
        words += "\nSomething to find; power:\n\n| test | found, % (95 % interval) | studies |\n"
                 "|---|---|---|\n" +
                 powers;
    words += "\n| 95 % interval | holds the truth, % (95 % interval) | nominal -+ 1 % "
             "|\n|---|---|---|\n";
    for (const auto& [name, rate] : outcomes.covered)
        words += fmt::format("| {} | {} | {} |\n", name, rateText(rate), coverVerdict(name, rate));
    if (outcomes.anyClaim.of == 0)
        return words + "\n";
    if (world.name != "effect")
        return words +
               fmt::format("\nSome difference claimed, after Holm: {} % of studies; {}.\n\n",
                           rateText(outcomes.anyClaim), sizeVerdict(outcomes.anyClaim));
    words +=
        "\n| claim | supported after Holm, % (95 % interval) | as planned, % |\n|---|---|---|\n";
    for (const auto& [name, rate] : outcomes.supported)
        words +=
            fmt::format("| {} | {} | {:.2f} |\n", name, rateText(rate), 100 * planned.at(name));
    return words + "\n";
}

} // namespace

void Outcomes::add(const Outcomes& more) {
    join(rejected, more.rejected);
    join(covered, more.covered);
    join(supported, more.supported);
    anyClaim.hits += more.anyClaim.hits;
    anyClaim.of += more.anyClaim.of;
}

Outcomes outcomesOf(const StudySimulator& simulator, const World& world, Block block,
                    std::uint64_t seed, const std::string& folder, int threads) {
    Outcomes all;
    std::mutex mutex;
    forEachInParallel(
        block.studies,
        [&](int i) {
            const int study = block.first + i;
            const fs::path file = fs::path(folder) / fmt::format("study-{}.csv", study);
            std::ofstream(file) << simulator.rows(
                world.truth, world.people, seed * 1000003 + static_cast<std::uint64_t>(study));
            const Outcomes some = analysed(file, world, simulator.protocol());
            fs::remove(file);
            const std::lock_guard lock(mutex);
            all.add(some);
        },
        {}, threads);
    return all;
}

std::string validityPage(const std::vector<World>& all, const std::vector<Outcomes>& outcomes,
                         const std::map<std::string, double>& planned, int studies,
                         std::uint64_t seed) {
    std::string words = fmt::format(
        "# Does the instrument tell the truth?\n\n"
        "Written by `obscura-validity --studies {} --seed {} --out docs/validity.md`; not by "
        "hand.\n\n"
        "Simulated studies in {} states of the world, whose answers are known. Each goes through "
        "the presenter's own orders, trial machine, simulated observer and rows, is written as a "
        "CSV file in memory, and is read and tested as `obscura-analysis` does. Bypassed are the "
        "window, the ledger, the journal, and the waiting for the disk.\n\n"
        "A test **holds** if its rate is 4.5 to 5.5 % where there is nothing to find; tests of "
        "counts are often *below*, for few outcomes are possible. **Too often** is a broken "
        "promise: do not believe that test in such a world by a p near .05. Rates are of the "
        "studies in which a test exists. A 95 % interval holds if it covers the truth in 94 to "
        "96 % of studies, a 90 % one in 89 to 91 %. Tests have the names of `tests.csv`; of "
        "several of one name in a study (groups, conditions) the first counts. `homogeneity` and "
        "`trend-totals` see the totals only; they, `position` and `logistic` take votes for "
        "independent, which they are only where people are alike. Of models the program reports "
        "no interval.\n\n",
        studies, seed, all.size());
    words += failures(all, outcomes);
    for (std::size_t i = 0; i < all.size(); ++i)
        words += worldText(all[i], outcomes[i], planned, all[i].studies(studies));
    return words;
}

} // namespace obscura
