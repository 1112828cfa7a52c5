#include "analysis/golden/golden.h"
#include "base/files.h"
#include "tests/error_of.h"
#include "tests/folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path shared = fs::path(OBSCURA_SOURCE) / "../shared/golden";

std::vector<std::string> failing(const std::vector<GoldenValue>& values) {
    std::vector<std::string> keys;
    for (const GoldenValue& value : values)
        if (!value.holds())
            keys.push_back(value.key);
    return keys;
}

class Golden : public testing::Test {
  protected:
    void SetUp() override {
        if (!fs::exists(shared / "golden_values.csv"))
            GTEST_SKIP() << shared << " is not there: nothing was compared with R and pwcmp";
    }
    // A copy of the golden files, in which `from` has become `to`.
    fs::path changed(const std::string& file, const std::string& from, const std::string& to) {
        fs::remove_all(folder.path());
        fs::copy(shared, folder.path(), fs::copy_options::recursive);
        std::string text = readFile(folder / file);
        const std::size_t at = text.find(from);
        EXPECT_NE(at, text.npos) << from;
        writeFile(folder / file, text.replace(at, from.size(), to));
        return folder.path();
    }

    test::Folder folder;
};

TEST_F(Golden, AllValuesOfRAndPwcmpHold) {
    const std::vector<GoldenValue> values = goldenValues(shared);
    EXPECT_EQ(values.size(), 384u);
    EXPECT_THAT(failing(values), testing::IsEmpty());
    EXPECT_THAT(failing(goldenValues(shared / "human")), testing::IsEmpty()); // its layout alone
}

TEST_F(Golden, AChangedVoteChangesValues) {
    const auto keys = failing(goldenValues(changed("thesis_counts.csv", "H2,18,18", "H2,17,19")));
    EXPECT_THAT(keys, testing::Contains("thesis.exact_p[1]"));
}

TEST_F(Golden, AnUnknownKeyDoesNotHold) {
    const auto keys =
        failing(goldenValues(changed("golden_values.csv", "thesis.yates[1]", "thesis.nobody[1]")));
    EXPECT_THAT(keys, testing::ElementsAre("thesis.nobody[1]"));
}

TEST_F(Golden, UnanimousVotesHaveNoJod) {
    const fs::path path = changed("thesis_counts.csv", "H2,18,18", "H2,0,36");
    const auto values = goldenValues(path);
    const auto jod = std::find_if(values.begin(), values.end(), [](const GoldenValue& value) {
        return value.key == "thesis.jod[1]";
    });
    ASSERT_NE(jod, values.end());
    EXPECT_TRUE(std::isnan(jod->computed));
}

TEST_F(Golden, AMistakeInAFileIsNamedWithItsPlace) {
    EXPECT_THAT(
        test::errorOf([&] { goldenValues(changed("thesis_counts.csv", "H2,18,18", "H2,18,x")); }),
        HasSubstr("thesis_counts.csv:2:8: votes_b: expected a whole number >= 0, found \"x\""));
    EXPECT_THAT(test::errorOf([&] { goldenValues(folder.path() / "nothing"); }),
                HasSubstr("expected golden_values.csv with its data files"));
}

} // namespace
} // namespace obscura
