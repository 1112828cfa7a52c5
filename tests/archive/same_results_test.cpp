#include "archive/same_results.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace obscura {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Tables = std::map<std::string, std::string>;

const Tables before{
    {"results.json", R"({"made":{"version":"1"},"p":0.25,"note":"few","list":[1,2]})"},
    {"votes.csv", "condition,votes,p\nc1,20,0.5\nc2,21,0.25\n"}};

Tables with(const std::string& file, const std::string& what, const std::string& by) {
    Tables tables = before;
    std::string& text = tables.at(file);
    text.replace(text.find(what), what.size(), by);
    return tables;
}

TEST(SameResults, AreCountedByValue) {
    const ResultsComparison same = comparisonOf(before, before);
    EXPECT_EQ(same.same, 4 + 1 + 6); // values, the header, cells
    EXPECT_EQ(same.nearly, 0);
    EXPECT_THAT(same.numbers, IsEmpty());
    EXPECT_THAT(same.others, IsEmpty());
}

TEST(SameResults, NumbersThatDifferAreNamedWithHowFar) {
    EXPECT_THAT(comparisonOf(before, with("votes.csv", "21", "22")).numbers,
                ElementsAre("votes.csv: votes of row c2 was 21, is now 22: +1"));
    EXPECT_THAT(comparisonOf(before, with("results.json", "0.25", "0.2501")).numbers,
                ElementsAre("results.json: /p was 0.25, is now 0.2501: +0.0001"));
}

TEST(SameResults, RoundingIsNearlyTheSame) {
    const ResultsComparison rounded =
        comparisonOf(before, with("votes.csv", "0.25", "0.25000000001"));
    EXPECT_EQ(rounded.nearly, 1);
    EXPECT_NEAR(rounded.most, 4e-11, 1e-12);
    EXPECT_THAT(rounded.numbers, IsEmpty());
    EXPECT_THAT(comparisonOf(before, with("votes.csv", "0.25", "0.250000001")).numbers,
                testing::SizeIs(1));
    EXPECT_EQ(comparisonOf(before, with("votes.csv", "0.25", "0.250")).nearly, 0);
    EXPECT_THAT(comparisonOf(before, with("votes.csv", "0.25", "0")).numbers, testing::SizeIs(1));
}

TEST(SameResults, TextsAndWhatIsNewAreAMatterOfVersions) {
    EXPECT_THAT(comparisonOf(before, with("results.json", "few", "many")).others,
                ElementsAre("results.json: /note was \"few\", is now \"many\""));
    EXPECT_THAT(
        comparisonOf(before, with("results.json", "\"version\":\"1\"", "\"version\":\"2\"")).others,
        IsEmpty());
    const ResultsComparison row = comparisonOf(before, with("votes.csv", "c2,21,0.25\n", ""));
    EXPECT_THAT(row.numbers, IsEmpty());
    EXPECT_THAT(row.others, testing::SizeIs(3));
    EXPECT_THAT(row.others[0], HasSubstr("of row c2 was"));
    Tables more = before;
    more["new.csv"] = "a\n1\n";
    EXPECT_THAT(comparisonOf(before, more).others, ElementsAre("new.csv: it is missing"));
    EXPECT_THAT(comparisonOf(more, before).others,
                ElementsAre("new.csv: it is not among what the analysis gives"));
}

TEST(SameResults, DamagedFilesDiffer) {
    EXPECT_THAT(comparisonOf(before, with("results.json", "{\"made\"", "{made")).others,
                testing::Not(IsEmpty()));
}

} // namespace
} // namespace obscura
