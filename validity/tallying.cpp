#include "validity/tallying.h"

#include "analysis/claims.h"
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

namespace obscura {

namespace {

namespace fs = std::filesystem;

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
        if (claim.confidence != 95 || !claim.interval)
            continue;
        // Of the people who changed, half did so in either direction: no world has a trend.
        const bool isRise = claim.measure.starts_with("rise");
        const double expected = isRise                                   ? 0
                                : claim.claim.kind == Claim::Kind::trend ? 0.5
                                                                         : truth.shares[0];
        outcomes.covered[name].add(holds(*claim.interval, expected));
    }
    outcomes.anyClaim.add(any);
}

// What is tested, without what was found: numbers are left out.
std::string nameOf(const Tested& tested) {
    std::string name = fmt::format("test {}: ", tested.kind->id);
    bool number = false;
    for (const char letter : tested.result.about) {
        const bool digit = letter >= '0' && letter <= '9';
        if (digit && !number)
            name += '#';
        number = digit || (number && letter == '.');
        if (!number)
            name += letter;
    }
    return name;
}

Outcomes analysed(const fs::path& file, const World& world, const std::vector<Claim>& claims) {
    Outcomes outcomes;
    const std::vector<fs::path> data = {file};
    const std::vector<std::string> order = {"c1", "c2", "c3", "c4", "c5", "c6", "c7"};
    const Answers answers = collectAnswers(data, AnswerRules());
    const std::vector<Tally> tallies = tallyVotes(answers.counted, nullptr, order);
    for (const Tally& tally : tallies)
        if (tally.condition == "c1")
            addCounts(tally, world.truth.shares[0], outcomes);
    addClaims(testClaims(claims, tallies, &answers.counted), world.truth, outcomes);
    for (const Tested& tested : testsOf(studyData(tallies, &answers.counted))) {
        const std::string name = nameOf(tested);
        // Of tests of one name the first: those of one study depend on each other.
        if (tested.result.test && !outcomes.rejected.contains(name))
            outcomes.rejected[name].add(tested.result.test->p < significance);
    }
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

// By the rate itself, not by what chance allows.
std::string sizeVerdict(const Rate& rate) {
    const double share = shareOf(rate);
    return share > 0.055 ? "**too often**" : share < 0.045 ? "below" : "holds";
}

std::string coverVerdict(const Rate& rate) {
    const double share = shareOf(rate);
    return share < 0.94 ? "**too seldom**" : share > 0.96 ? "above" : "holds";
}

// What is known of why a kind of test promises too much; "" where nothing is.
std::string_view reasonOf(std::string_view name) {
    if (name.starts_with("test gee"))
        return "robust standard errors are too small with so few people, most of all where "
               "Wald's test has several parameters (Mancl and DeRouen 2001)";
    if (name.starts_with("test logistic") || name.starts_with("test mixed"))
        return "chi-square is what the statistic tends to with many people, and there are few";
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
            if (coverVerdict(rate).starts_with("**"))
                words += fmt::format("- interval of {}, in \"{}\": holds the truth in {} % of "
                                     "studies.\n",
                                     name, all[i].name, rateText(rate));
    }
    return "## Promises that are not kept\n\n" + (words.empty() ? "None.\n" : words) + "\n";
}

std::string worldText(const World& world, const Outcomes& outcomes,
                      const std::map<std::string, double>& planned) {
    std::string words = fmt::format("## {}\n\nThe truth: {}.\n\n", world.name, world.words);
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
    words +=
        "\n| 95 % interval | holds the truth, % (95 % interval) | 94 to 96 % |\n|---|---|---|\n";
    for (const auto& [name, rate] : outcomes.covered)
        words += fmt::format("| {} | {} | {} |\n", name, rateText(rate), coverVerdict(rate));
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

Outcomes outcomesOf(const StudySimulator& simulator, const World& world, int studies, int people,
                    std::uint64_t seed, const std::string& folder, int threads,
                    const std::function<void(double)>& progress) {
    Outcomes all;
    std::mutex mutex;
    const std::vector<Claim> claims = simulator.protocol().claims;
    forEachInParallel(
        studies,
        [&](int study) {
            const fs::path file = fs::path(folder) / fmt::format("study-{}.csv", study);
            std::ofstream(file) << simulator.rows(
                world.truth, people, seed * 1000003 + static_cast<std::uint64_t>(study));
            const Outcomes some = analysed(file, world, claims);
            fs::remove(file);
            const std::lock_guard lock(mutex);
            join(all.rejected, some.rejected);
            join(all.covered, some.covered);
            join(all.supported, some.supported);
            all.anyClaim.hits += some.anyClaim.hits;
            all.anyClaim.of += some.anyClaim.of;
        },
        progress, threads);
    return all;
}

std::string validityPage(const std::vector<World>& all, const std::vector<Outcomes>& outcomes,
                         const std::map<std::string, double>& planned, int studies, int people,
                         std::uint64_t seed) {
    std::string words = fmt::format(
        "# Does the instrument tell the truth?\n\n"
        "Written by `obscura-validity --studies {} --seed {} --out docs/validity.md`; not by "
        "hand.\n\n"
        "{} simulated studies of {} people and 7 conditions in each of {} states of the world, "
        "whose "
        "answers are known. Each goes through the presenter's own orders, trial machine, simulated "
        "observer and rows, is written as a CSV file in memory, and is read and tested as "
        "`obscura-analysis` does. Bypassed are the window, the ledger, the journal, and the "
        "waiting for "
        "the disk.\n\n"
        "A test **holds** if its rate is 4.5 to 5.5 % where there is nothing to find; tests of "
        "counts are "
        "often *below*, for few outcomes are possible. **Too often** is a broken promise: do not "
        "believe that test in such a world by a p near .05. Rates are of the studies in "
        "which a test "
        "exists. A 95 % interval holds if it covers the truth in 94 to 96 % of studies. Tests of "
        "totals "
        "and `logistic` take votes for independent, which they are only where people are "
        "alike.\n\n",
        studies, seed, studies, people, all.size());
    words += failures(all, outcomes);
    for (std::size_t i = 0; i < all.size(); ++i)
        words += worldText(all[i], outcomes[i], planned);
    return words;
}

} // namespace obscura
