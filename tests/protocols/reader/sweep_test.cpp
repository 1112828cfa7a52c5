#include "base/error.h"
#include "protocols/reader/sweep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace obscura {
namespace {

const std::string text = R"(name = "small"
seed = 7
reference = "cosine"
train = ["a"]
test = ["b"]
sizes = [[64, 36], [128, 72]]
seconds = 0.5

[scenes.a]
builtin = "atrium"
radius = 0.5
camera = { position = [0, 1, 3], target = [0, 1, 0] }
[scenes.b]
builtin = "atrium"
radius = 0.5
camera = { position = [0, 2, 3], target = [0, 1, 0] }

[light]
sky = {}
sun = { azimuthDegrees = 10, elevationDegrees = 30 }

[techniques]
none = { technique = "none" }
hbao = { technique = "hbao", steps = [2, 4], blur = [true, false], angleBias = 10 }
gtao = { technique = "gtao", preset = ["low", "high"] }

[growth]
view = "b"
radii = [0.25, 0.5]
sizes = [[64, 36]]
poles = [0, 8]
[growth.techniques]
gtao = { technique = "gtao", slices = [1, 2, 4] }
)";

std::vector<std::string> namesOf(const std::vector<TechniqueSetting>& settings) {
    std::vector<std::string> names;
    for (const TechniqueSetting& setting : settings)
        names.push_back(setting.name);
    return names;
}

TEST(SweepStudy, ListsMakeEveryCombination) {
    const SweepStudy study = parseSweepStudy(text, "small.toml");
    EXPECT_THAT(namesOf(study.match.techniques),
                testing::UnorderedElementsAre("none", "hbao blur=1 steps=2", "hbao blur=1 steps=4",
                                              "hbao blur=0 steps=2", "hbao blur=0 steps=4",
                                              "gtao low", "gtao high"));
    for (const TechniqueSetting& each : study.match.techniques)
        if (each.name == "hbao blur=0 steps=4") {
            std::map<std::string, double> values;
            for (const Setting& setting : each.settings)
                values[setting.name] = setting.value;
            EXPECT_THAT(values,
                        testing::ElementsAre(testing::Pair("angleBias", 10),
                                             testing::Pair("blur", 0), testing::Pair("steps", 4)));
        }
    EXPECT_EQ(variedName("hbao blur=0 steps=4"), "hbao");
    EXPECT_EQ(study.sizes.size(), 2u);
    EXPECT_EQ(study.sizes[1].width, 128);
    EXPECT_EQ(study.match.training.width, 64); // the first size, unless given
    ASSERT_TRUE(study.light && study.light->sun && study.growth);
    EXPECT_THAT(namesOf(study.growth->techniques),
                testing::ElementsAre("gtao slices=1", "gtao slices=2", "gtao slices=4"));
}

TEST(SweepStudy, IsSeenOnTheDisplayThatItNames) {
    EXPECT_EQ(parseSweepStudy(text, "small.toml").display.name, "standard_fhd");
    const std::string display = "[display]\nname = \"standard_4k\"\npeak = 120\n";
    const SweepStudy study = parseSweepStudy(text + display, "small.toml");
    EXPECT_EQ(study.display.peak, 120);
    EXPECT_EQ(study.display.width, 3840);
    EXPECT_EQ(quick(study, 1).display, study.display);
}

TEST(SweepStudy, QuickKeepsEveryConfiguration) {
    const SweepStudy full = parseSweepStudy(text, "small.toml"), few = quick(full, 1);
    EXPECT_EQ(few.match.techniques.size(), full.match.techniques.size());
    EXPECT_EQ(few.sizes.size(), 1u);
    EXPECT_EQ(few.match.test.size(), 1u);
}

struct Mistake {
    std::string before, after, message;
};

TEST(SweepStudy, MistakesNameTheirPlace) {
    const Mistake mistakes[] = {
        {"sizes = [[64, 36], [128, 72]]", "sizes = [[64, 0]]",
         "small.toml:6:10: sizes: expected [width, height] in pixels, each 16 ... 8192, found [64, "
         "0]"},
        {"sizes = [[64, 36], [128, 72]]\n", "",
         "small.toml:1:1: expected \"sizes\", a list like [[960, 540], [1920, 1080]], found none"},
        {"steps = [2, 4]", "steps = []",
         "small.toml:24:38: techniques.hbao.steps: expected at least one value in the list, found "
         "none"},
        {"steps = [2, 4]", "steps = [2, \"many\"]",
         "small.toml:24:42: techniques.hbao.steps: expected a number, true or false, found "
         "\"many\""},
        {"view = \"b\"", "view = \"c\"",
         "small.toml:28:1: growth.view: expected the name of a scene under [scenes], found \"c\""},
        {"seconds = 0.5", "second = 0.5",
         "small.toml:7:1: second: unknown key; did you mean \"seconds\"?"},
    };
    for (const Mistake& mistake : mistakes) {
        std::string wrong = text;
        wrong.replace(wrong.find(mistake.before), mistake.before.size(), mistake.after);
        try {
            parseSweepStudy(wrong, "small.toml");
            ADD_FAILURE() << "no error for " << mistake.after;
        } catch (const Error& error) {
            EXPECT_EQ(std::string(error.what()), mistake.message);
        }
    }
}

} // namespace
} // namespace obscura
