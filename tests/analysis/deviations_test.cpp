#include "analysis/deviations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace obscura {
namespace {

using testing::HasSubstr;

Claim claimOf(const std::string& name, const std::string& condition) {
    Claim claim;
    claim.name = name;
    claim.conditions = {condition};
    return claim;
}

Tally tallyOf(const std::string& condition, Votes votes) {
    Tally tally;
    tally.condition = condition;
    tally.votes = votes;
    return tally;
}

const Deviation& lineOf(const std::vector<Deviation>& lines, const std::string& subject) {
    for (const Deviation& line : lines)
        if (line.subject == subject)
            return line;
    ADD_FAILURE() << subject;
    return lines.front();
}

Findings studied() {
    Findings findings;
    findings.tallies = {tallyOf("c1", {4, 24}), tallyOf("c2", {14, 14})};
    findings.conduct.emplace();
    findings.conduct->participants = 28;
    findings.conduct->trials = 56;
    findings.conduct->protocols = {"one"};
    findings.claims = testClaims({claimOf("first", "c1")}, findings.tallies, nullptr);
    return findings;
}

Declared declaredFirst() {
    Declared declared;
    declared.sha256 = "abc";
    declared.claims = {claimOf("first", "c1")};
    return declared;
}

TEST(Deviations, AreNoneWhereAllWasDoneAsDeclared) {
    Protocol protocol;
    protocol.ordering.participants = 28;
    for (const Deviation& line : deviationsOf(studied(), declaredFirst(), &protocol))
        EXPECT_FALSE(line.deviates) << line.subject << ": " << line.done;
}

TEST(Deviations, AreSaidEach) {
    Findings findings = studied();
    findings.tallies[1].votes = {14, 12};
    findings.conduct->participants = 27;
    findings.conduct->wrongMasks = 3;
    findings.conduct->protocols = {"one", "two"};
    Declared declared = declaredFirst();
    declared.claims.push_back(claimOf("second", "c3"));
    Protocol protocol;
    protocol.ordering.participants = 28;
    const auto lines = deviationsOf(findings, declared, &protocol);
    for (const auto& [subject, done] :
         std::map<std::string, std::string>{{"people", "27 answered"},
                                            {"design", "2 versions"},
                                            {"trials of each condition", "28; c2: 26"},
                                            {"claim: second", "not tested"},
                                            {"masks", "3 of 56 trials"}}) {
        EXPECT_TRUE(lineOf(lines, subject).deviates) << subject;
        EXPECT_THAT(lineOf(lines, subject).done, HasSubstr(done));
    }
    EXPECT_FALSE(lineOf(lines, "claim: first").deviates);
    EXPECT_EQ(lineOf(lines, "conditions without a claim").done, "exploratory: c2");
}

} // namespace
} // namespace obscura
