#include "entry/completion.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace obscura {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Kind = Argument::Kind;

const std::vector<Argument> bench{
    {Kind::program, "", "bench", 0, "", "measures"},
    {Kind::option, "", "--help", 0, "", "this"},
    {Kind::command, "", "sweep", 0, "", "all"},
    {Kind::command, "", "merge", 0, "", "parts"},
    {Kind::positional, "sweep", "study", 1, "PROTOCOL", ""},
    {Kind::option, "sweep", "--level", 1, "low moderate high", "light"},
    {Kind::option, "sweep", "--camera", 6, "", "where"},
    {Kind::option, "sweep", "--test", 1 << 29, "plane wall", "which"},
    {Kind::option, "sweep", "--quick", 0, "", "soon"},
    {Kind::option, "sweep", "--out", 1, "DIR", "where to"},
    {Kind::positional, "merge", "parts", 1 << 29, "FILE", ""},
};

std::vector<std::string> wordsOf(const Completion& completion) {
    std::vector<std::string> words;
    for (const auto& word : completion.words)
        words.push_back(word.text);
    return words;
}

Completion after(std::vector<std::string> words) {
    return completionOf(bench, std::move(words), {"demo", "ladder"});
}

TEST(CompletionTest, OffersCommandsAndThenTheirOptions) {
    EXPECT_THAT(wordsOf(after({""})), ElementsAre("sweep", "merge"));
    EXPECT_EQ(after({""}).also, "nothing");
    EXPECT_THAT(wordsOf(after({"sw"})), ElementsAre("sweep"));
    EXPECT_EQ(after({"sw"}).words.front().about, "all");
    EXPECT_THAT(wordsOf(after({"-"})), ElementsAre("--help"));
    EXPECT_THAT(wordsOf(after({"sweep", "--"})),
                ElementsAre("--level", "--camera", "--test", "--quick", "--out"));
    EXPECT_THAT(wordsOf(after({"sweep", "--quick", "--o"})), ElementsAre("--out"));
}

TEST(CompletionTest, OffersTheValuesOfAClosedSet) {
    EXPECT_THAT(wordsOf(after({"sweep", "--level", ""})), ElementsAre("low", "moderate", "high"));
    EXPECT_THAT(wordsOf(after({"sweep", "--level", "m"})), ElementsAre("moderate"));
    EXPECT_THAT(wordsOf(after({"sweep", "--level", "-"})), testing::SizeIs(5));
    // As bash splits it, and as zsh does not.
    EXPECT_THAT(wordsOf(after({"sweep", "--level", "=", "h"})), ElementsAre("high"));
    EXPECT_THAT(wordsOf(after({"sweep", "--level", "="})), ElementsAre("low", "moderate", "high"));
    EXPECT_THAT(wordsOf(after({"sweep", "--level=h"})), ElementsAre("--level=high"));
    EXPECT_THAT(wordsOf(after({"sweep", "--nothing=h"})), IsEmpty());
}

TEST(CompletionTest, KnowsHowManyValuesAnOptionTakes) {
    EXPECT_THAT(wordsOf(after({"sweep", "--test", "plane", "w"})), ElementsAre("wall"));
    const std::vector<std::string> five{"sweep", "--camera", "0", "-1", "-.5", "1", "2", ""};
    EXPECT_THAT(wordsOf(after(five)), IsEmpty());
    EXPECT_EQ(after(five).also, "nothing");
    EXPECT_THAT(wordsOf(after({"sweep", "--camera", "0", "-1", "-.5", "1", "2", "3", "d"})),
                ElementsAre("demo"));
    EXPECT_THAT(wordsOf(after({"sweep", "--level", "low", "d"})), ElementsAre("demo"));
}

TEST(CompletionTest, LeavesFilesAndFoldersToTheShell) {
    EXPECT_EQ(after({"sweep", ""}).also, "files");
    EXPECT_THAT(wordsOf(after({"sweep", ""})), ElementsAre("demo", "ladder"));
    EXPECT_EQ(after({"sweep", "--out", ""}).also, "folders");
    EXPECT_EQ(after({"sweep", "--out=/t"}).also, "folders");
    EXPECT_EQ(after({"sweep", "demo", ""}).also, "nothing"); // there is but one study
    EXPECT_EQ(after({"merge", "one", "two", "t"}).also, "files");
    EXPECT_THAT(wordsOf(after({"merge", "sweep", "s"})), IsEmpty()); // "sweep" is a folder here
    EXPECT_EQ(after({"--help", ""}).also, "nothing");
}

} // namespace
} // namespace obscura
