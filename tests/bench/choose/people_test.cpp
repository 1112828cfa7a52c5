#include "base/files.h"
#include "bench/choose/people.h"
#include "tests/error_of.h"
#include "tests/folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace obscura {
namespace {

using testing::HasSubstr;

const std::string header =
    "scene,level,technique,name,milliseconds,jod_people,low,high,jod_predicted,rmse\n";
const std::string ladder = header + R"(hall,sky,none,none,0,-2.1,-2.6,-1.6,8.1,0.24
hall,sky,starcraft,cheap,0.4,-0.9,-1.4,-0.6,9.2,0.17
hall,sky,gtao,"fair, low",0.9,-0.6,-1.1,-0.1,9.55,0.12
hall,sky,gtao,dear,3.5,-0.2,-0.4,0.1,9.7,0.1
hall,sky,ray_traced,truth,,0,,,10,0
)";

PeopleLimit limitFrom(const std::string& text, double margin) {
    const test::Folder folder;
    writeFile(folder / "ladder.csv", text);
    return limitOf(readPeople(folder.path()), margin);
}

// The cheapest whose interval reaches -0.5: not `cheap`, which misses it by 0.1, nor `dear`.
TEST(People, TheCheapestThatTheyDoNotTellSetsTheLimit) {
    const PeopleLimit limit = limitFrom(ladder, 0.5);
    EXPECT_NEAR(limit.jod, 9.55, 1e-12);
    EXPECT_THAT(limit.words, HasSubstr("hall, sky: fair, low (0.9 ms) is the cheapest"));
    EXPECT_THAT(limit.words, HasSubstr("-0.60, 95 % interval -1.10 to -0.10; predicted are 9.55"));
    EXPECT_THAT(limit.words, HasSubstr("They may place it 1.10 below"));
    EXPECT_NEAR(limitFrom(ladder, 0.6).jod, 9.2, 1e-12);
    EXPECT_NEAR(limitFrom(ladder, 0).jod, 9.7, 1e-12);
    EXPECT_THAT(limitFrom(ladder, 0.4).words, HasSubstr("may place")); // of `fair`
    EXPECT_THAT(limitFrom(ladder, 0).words, HasSubstr("may place"));
}

// A limit that is enough in every scene and level.
TEST(People, TheStrictestSceneSetsTheLimit) {
    const PeopleLimit limit = limitFrom(ladder + R"(aisle,dusk,none,none,0,-0.1,-0.3,0.1,9.8,0.05
aisle,dusk,gtao,dear,3,0,-0.2,0.2,9.9,0.02
aisle,dusk,ray_traced,truth,,0,,,10,0
)",
                                        0.5);
    EXPECT_NEAR(limit.jod, 9.8, 1e-12);
    EXPECT_THAT(limit.words, HasSubstr("aisle, dusk: none (0 ms)"));
    EXPECT_THAT(limit.words, HasSubstr("hall, sky"));
}

// An interval without an end reaches anything.
TEST(People, AnEndlessIntervalTellsNothing) {
    EXPECT_NEAR(limitFrom(header + "a,b,none,none,0,-3,,,7,0\n", 0.5).jod, 7, 1e-12);
    EXPECT_THAT(limitFrom(header + "a,b,none,none,0,-3,-4,,7,0\n", 0.5).words,
                HasSubstr("may place it 4.00 below"));
}

TEST(People, MistakesNameTheirPlace) {
    EXPECT_THAT(test::errorOf([] { limitFrom(header, 0.5); }), HasSubstr("found none"));
    EXPECT_THAT(test::errorOf([] { limitFrom("scene,level\n", 0.5); }), HasSubstr("ladder.csv:1"));
    EXPECT_THAT(
        test::errorOf([] { limitFrom(header + "a,b,c,d,x,0,0,0,0,0\n", 0.5); }),
        HasSubstr("ladder.csv:2: milliseconds: expected a number, or nothing, found \"x\""));
    EXPECT_THAT(test::errorOf([] { limitFrom(header + "a,b,none,none,0,-3,-4,-2,7,0\n", 0.5); }),
                HasSubstr("by more than 0.5 JOD in a, b, found none; allow more by --margin"));
}

} // namespace
} // namespace obscura
