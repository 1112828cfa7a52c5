#include "analysis/votes.h"
#include "tests/analysis/sample_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace obscura {
namespace {

using test::errorOf;
using test::sampleResponse;
using testing::ElementsAre;

std::vector<Answer> answersOf(const std::vector<Response>& rows) {
    std::vector<Answer> answers;
    for (std::size_t i = 0; i < rows.size(); ++i)
        answers.push_back({Vote(rows[i]), Symbol("a.csv"), static_cast<int>(i) + 2});
    return answers;
}

std::vector<std::string> idsOf(const std::vector<Tally>& tallies) {
    std::vector<std::string> ids;
    for (const Tally& tally : tallies)
        ids.push_back(tally.condition);
    return ids;
}

TEST(TallyVotes, CountsEachConditionWhicheverImageCameFirst) {
    // Participants 1 to 7 see a first, 8 to 14 see b first.
    std::vector<Response> rows;
    for (int number = 1; number <= 14; ++number)
        rows.push_back(sampleResponse(number, "c1", number % 7 < 3));
    const auto tallies = tallyVotes(answersOf(rows), nullptr);
    ASSERT_EQ(tallies.size(), 1u);
    EXPECT_EQ(tallies[0].votes.b, 6);
    EXPECT_EQ(tallies[0].votes.a, 8);
    EXPECT_EQ(tallies[0].techniqueB, "blizzard24");
}

TEST(TallyVotes, KeepsConditionsOfOneLevelTogether) {
    std::vector<Response> rows;
    for (const auto& [id, level] :
         {std::pair("c3", "high"), {"c1", "high"}, {"c2", "low"}, {"c4", "low"}}) {
        rows.push_back(sampleResponse(1, id, true));
        rows.back().level = level;
    }
    EXPECT_THAT(idsOf(tallyVotes(answersOf(rows), nullptr)), ElementsAre("c3", "c1", "c2", "c4"));
}

TEST(TallyVotes, RefusesAConditionThatMeansTwoPairs) {
    Response other = sampleResponse(2, "c1", true);
    other.techniqueA = "crytek24";
    EXPECT_EQ(errorOf([&] {
                  tallyVotes(answersOf({sampleResponse(1, "c1", true), other}), nullptr);
              }),
              "a.csv:3: condition_id: expected condition \"c1\" to compare none / blizzard24 on "
              "atrium, moderate, H1, found crytek24 / blizzard24 on atrium, moderate, H1");
}

class TallyWithStimuli : public testing::Test {
  protected:
    test::Folder folder_;
    Manifest stimuli_ = readManifest(test::writeStimuli(folder_.path()) / "manifest.json");
};

TEST_F(TallyWithStimuli, FollowsTheManifestAndKeepsConditionsWithoutVotes) {
    const auto tallies = tallyVotes(answersOf({sampleResponse(1, "c1", true)}), &stimuli_);
    EXPECT_THAT(idsOf(tallies), ElementsAre("c2", "c1", "c3"));
    EXPECT_EQ(tallies[1].votes.b, 1);
    EXPECT_EQ(tallies[2].votes.total(), 0);
}

TEST_F(TallyWithStimuli, RefusesAConditionThatTheStimuliLack) {
    EXPECT_EQ(errorOf([&] { tallyVotes(answersOf({sampleResponse(1, "c4", true)}), &stimuli_); }),
              "a.csv:2: condition_id: the stimuli have no condition \"c4\"; one of: c2, c1, c3");
}

TEST_F(TallyWithStimuli, RefusesImagesThatTheStimuliDoNotHold) {
    Response row = sampleResponse(8, "c1", true); // b first
    EXPECT_EQ(tallyVotes(answersOf({row}), &stimuli_)[1].votes.b, 1);
    row.sha256Second = std::string(64, 'b');
    EXPECT_EQ(errorOf([&] { tallyVotes(answersOf({row}), &stimuli_); }),
              "a.csv:2: sha256_second: the image shown is not the one in the stimuli's manifest");
}

class ReadCounts : public testing::Test {
  protected:
    static constexpr const char* header =
        "condition_id,level,scene,tech_a,tech_b,hypothesis,votes_a,votes_b\n";

    std::vector<Tally> read(const std::string& lines) {
        writeFile(file_, header + lines);
        return readCounts(file_);
    }
    // The message without the path in front.
    std::string error(const std::string& lines) {
        return errorOf([&] { read(lines); }).substr(file_.string().size());
    }

    test::Folder folder_;
    std::filesystem::path file_ = folder_ / "counts.csv";
};

TEST_F(ReadCounts, KnowsTheRowsOfParticipants) {
    writeFile(file_, responseHeader() + responseLine(sampleResponse(1, "c1", true)));
    EXPECT_THAT(errorOf([&] { readCounts(file_); }),
                testing::HasSubstr("found the rows of participants; give them without --counts"));
}

TEST_F(ReadCounts, TakesEachLine) {
    const auto tallies =
        read("1,low,dragon,A,B,,18,17\n\"2,x\",high,\"two \"\"words\"\"\",A,B,H1,0,3");
    ASSERT_EQ(tallies.size(), 2u);
    EXPECT_EQ(tallies[0].votes.a, 18);
    EXPECT_EQ(tallies[0].votes.b, 17);
    EXPECT_EQ(tallies[1].condition, "2,x");
    EXPECT_EQ(tallies[1].scene, "two \"words\"");
}

TEST_F(ReadCounts, NamesLineAndColumnOfAFault) {
    EXPECT_EQ(error("1,low,dragon,A,B,H2,18,x\n"),
              ":2:8: votes_b: expected a whole number from 0 to 1000000000000, found \"x\"");
    EXPECT_EQ(error("1,low,dragon,A,B,H2,-1,2\n"),
              ":2:7: votes_a: expected a whole number from 0 to 1000000000000, found \"-1\"");
    EXPECT_EQ(error("1,low,,A,B,H2,1,2\n"), ":2:3: scene: expected text, found nothing");
    EXPECT_EQ(error("1,low,dragon,A,B,H2,1\n"), ":2: expected 8 columns, found 7");
    EXPECT_EQ(error("1,low,dragon,A,B,H2,1,2\n1,high,dragon,A,B,H2,1,2\n"),
              ":3:1: condition_id: condition \"1\" stands here twice");
    EXPECT_EQ(error(""), ":1: expected the header "
                         "condition_id,level,scene,tech_a,tech_b,hypothesis,votes_a,votes_b and a "
                         "line for each condition, or a table written by obscura-analysis");
}

} // namespace
} // namespace obscura
