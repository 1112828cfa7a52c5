#include "analysis/deviations.h"

#include "base/csv.h"
#include "protocols/reader/balance.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

namespace obscura {

namespace {

Deviation people(const Conduct& conduct, const Protocol* protocol) {
    Deviation line{"people", "not known here: give --protocol",
                   fmt::format("{} answered", conduct.participants)};
    if (conduct.incomplete > 0)
        line.done += fmt::format(", {} of them not to the end", conduct.incomplete);
    line.deviates = conduct.incomplete > 0;
    if (protocol) {
        line.declared = fmt::format("{} finish", protocol->ordering.participants);
        line.deviates = line.deviates || conduct.participants != protocol->ordering.participants;
    }
    return line;
}

Deviation design(const Conduct& conduct, const Declared& declared) {
    const std::size_t texts = conduct.protocols.size();
    Deviation line{"design",
                   declared.sha256.empty() ? "its hash is not known here" : declared.sha256,
                   declared.sha256.empty() ? "" : "all answers carry this hash"};
    if (texts > 1)
        line.done += fmt::format("{}{} versions of the protocol's file were used (words, planned "
                                 "number)",
                                 line.done.empty() ? "" : "; ", texts);
    if (!conduct.changedImages.empty())
        line.done += fmt::format("; images changed: {}", fmt::join(conduct.changedImages, ", "));
    line.deviates = texts > 1 || !conduct.changedImages.empty();
    return line;
}

// Every condition as often as the one that was answered most often.
Deviation trials(const std::vector<Tally>& tallies) {
    std::int64_t most = 0;
    for (const Tally& tally : tallies)
        most = std::max(most, tally.votes.total());
    Deviation line{"trials of each condition", "equally many", fmt::format("{}", most)};
    for (const Tally& tally : tallies)
        if (tally.votes.total() < most) {
            line.deviates = true;
            line.done += fmt::format("; {}: {}", tally.condition, tally.votes.total());
        }
    return line;
}

std::vector<Deviation> exclusions(const Findings& findings, const Declared& declared) {
    std::map<std::string, int> reasons;
    for (const Exclusion& exclusion : findings.exclusions)
        reasons[exclusion.reason] += exclusion.trials;
    std::string done;
    for (const auto& [reason, count] : reasons)
        done += fmt::format("{}{} trials: {}", done.empty() ? "" : "; ", count, reason);
    // Which rule a reason is of, its words say; a file's reasons are a person's.
    return {{"what does not count", fmt::format("{}", fmt::join(inWords(declared.exclusions), " ")),
             done.empty() ? "nothing was left out" : done, false}};
}

std::vector<Deviation> claims(const std::vector<ClaimResult>& results,
                              const std::vector<Claim>& declared) {
    std::vector<Deviation> lines;
    for (const Claim& claim : declared) {
        const auto result = std::find_if(results.begin(), results.end(),
                                         [&](const auto& one) { return one.claim == claim; });
        Deviation line{"claim: " + claim.name,
                       fmt::format("{} over {}, family \"{}\"",
                                   claimKindNames()[static_cast<std::size_t>(claim.kind)],
                                   fmt::join(claim.conditions, ", "), claim.family),
                       "not tested", true};
        if (result != results.end()) {
            const bool isUnusable = result->outcome == ClaimResult::Outcome::unusable;
            line.done = isUnusable ? "could not be tested: " + result->why : result->method;
            for (const std::string& note : result->notes)
                line.done += "; " + note;
            line.deviates = isUnusable || !result->notes.empty();
        }
        lines.push_back(line);
    }
    return lines;
}

Deviation exploratory(const std::vector<Tally>& tallies, const std::vector<Claim>& claims) {
    std::set<std::string> claimed;
    for (const Claim& claim : claims)
        claimed.insert(claim.conditions.begin(), claim.conditions.end());
    std::vector<std::string> others;
    for (const Tally& tally : tallies)
        if (tally.votes.total() > 0 && !claimed.contains(tally.condition))
            others.push_back(tally.condition);
    return {"conditions without a claim", "nothing is claimed of them",
            others.empty() ? "none" : fmt::format("exploratory: {}", fmt::join(others, ", "))};
}

Deviation masks(const Conduct& conduct) {
    return {"masks", "as many refreshes as planned",
            conduct.wrongMasks == 0 ? "all"
                                    : fmt::format("{} of {} trials with other ones",
                                                  conduct.wrongMasks, conduct.trials),
            conduct.wrongMasks > 0};
}

} // namespace

std::vector<Deviation> deviationsOf(const Findings& findings, const Declared& declared,
                                    const Protocol* protocol) {
    std::vector<Deviation> lines;
    if (findings.conduct) {
        lines.push_back(people(*findings.conduct, protocol));
        lines.push_back(design(*findings.conduct, declared));
    }
    lines.push_back(trials(findings.tallies));
    for (const auto& some :
         {exclusions(findings, declared), claims(findings.claims, declared.claims)})
        lines.insert(lines.end(), some.begin(), some.end());
    lines.push_back(exploratory(findings.tallies, declared.claims));
    if (findings.conduct)
        lines.push_back(masks(*findings.conduct));
    return lines;
}

Declared declaredBy(const Protocol& protocol) {
    Declared declared;
    for (const int index : mainConditions(protocol))
        declared.order.push_back(protocol.conditions[static_cast<std::size_t>(index)].id);
    declared.claims = protocol.claims;
    declared.exclusions = protocol.exclusions;
    return declared;
}

Table deviationTable(const std::vector<Deviation>& deviations) {
    Table table{{{"Subject"}, {"Declared"}, {"Done"}, {"Deviates"}}, {}};
    for (const Deviation& line : deviations)
        table.rows.push_back(
            {line.subject, line.declared, line.done, line.deviates ? "yes" : "no"});
    return table;
}

std::string deviationsCsv(const std::vector<Deviation>& deviations) {
    std::string text = "subject,declared,done,deviates\n";
    for (const auto& row : deviationTable(deviations).rows)
        text +=
            fmt::format("{},{},{},{}\n", csvCell(row[0]), csvCell(row[1]), csvCell(row[2]), row[3]);
    return text;
}

} // namespace obscura
