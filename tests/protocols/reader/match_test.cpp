#include "base/files.h"
#include "protocols/reader/match.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>

namespace obscura {
namespace {

namespace fs = std::filesystem;

const std::string valid = R"(name = "small"
seed = 7
rays = 64
normals = "face"
reference = "cosine"
scores = ["depth"]
train = ["a", "b"]
test = ["c"]
image = { width = 64, height = 36 }
[scenes.a]
builtin = "sculpture"
radius = 0.2
camera = { position = [0, 1, 3], target = [0, 0.5, 0] }
[scenes.b]
builtin = "sculpture"
radius = 0.3
camera = { position = [1, 1, 3], target = [0, 0.5, 0] }
[scenes.c]
builtin = "sculpture"
radius = 0.2
camera = { position = [2, 1, 3], target = [0, 0.5, 0] }
[techniques.few]
technique = "blizzard"
samples = 8
)";

std::string with(const std::string& from, const std::string& to, std::string text = valid) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

std::string without(const std::string& part, std::string text) {
    for (std::size_t at; (at = text.find(part)) != std::string::npos;)
        text.erase(at, part.size());
    return text;
}

TEST(MatchStudy, ReadsAWholeStudy) {
    const MatchStudy study = parseMatchStudy(valid, "small.toml");
    EXPECT_EQ(study.truth, Truth::cosine);
    EXPECT_THAT(study.scores, testing::ElementsAre(Truth::depth));
    EXPECT_EQ(study.normals, Normals::face);
    EXPECT_EQ(study.training.width, 64); // as the test views, unless given
    ASSERT_EQ(study.train.size(), 2u);
    EXPECT_EQ(study.train[1].radius, 0.3);
    EXPECT_EQ(study.test[0].name, "c");
    EXPECT_EQ(study.techniques[0].settings[0].value, 8);
    EXPECT_EQ(study.sha256, sha256(valid));
}

TEST(MatchStudy, TakesAPartnerInPlaceOfAReference) {
    const MatchStudy study =
        parseMatchStudy(with("reference = \"cosine\"", "partner = \"few\""), "small.toml");
    EXPECT_EQ(study.partner, "few");
}

TEST(MatchStudy, RadiiMultiplyViews) {
    std::string text = without("radius = 0.2\n", without("radius = 0.3\n", valid));
    text = with("seed = 7", "seed = 7\nradii = [0.5, 1.5]", text);
    const MatchStudy study = parseMatchStudy(text, "small.toml");
    EXPECT_EQ(study.train.size(), 4u);
    EXPECT_EQ(study.test[1].name, "c");
    EXPECT_EQ(study.test[1].radius, 1.5);
    const MatchStudy one = atRadius(study, 1.5);
    EXPECT_EQ(one.train.size(), 2u);
    EXPECT_EQ(one.test.size(), 1u);
    try {
        atRadius(study, 2);
        FAIL() << "was accepted";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "expected a radius that training and test views of \"small\" "
                                   "have, found 2; one of: 0.5, 1.5");
    }
}

TEST(MatchStudy, ShippedStudiesAreWell) {
    for (const char* name : {"builtin", "sponza", "dragon", "robot"}) {
        const MatchStudy study =
            readMatchStudy(std::string(OBSCURA_SOURCE "/protocols/match-") + name + ".toml");
        EXPECT_EQ(study.name, name);
        EXPECT_GE(study.techniques.size(), 4u);
    }
    const MatchStudy sponza = readMatchStudy(OBSCURA_SOURCE "/protocols/match-sponza.toml");
    EXPECT_GE(sponza.train.size(), 8u); // four cameras at two radii
    EXPECT_GE(sponza.test.size(), 8u);
}

struct MatchMistake {
    const char* name;
    std::string from, to, message;
};
void PrintTo(const MatchMistake& mistake, std::ostream* out) { *out << mistake.name; }

const MatchMistake matchMistakes[] = {
    {"NoReference", "reference = \"cosine\"\n", "",
     "small.toml:1:1: expected either \"reference\" (one of cosine, uniform, falloff, depth) or "
     "\"partner\" (the name of a technique), found neither"},
    {"ReferenceAndPartner", "rays = 64", "partner = \"few\"",
     "small.toml:1:1: expected either \"reference\" (one of cosine, uniform, falloff, depth) or "
     "\"partner\" (the name of a technique), found both"},
    {"UnknownReference", "\"cosine\"", "\"cosin\"",
     "small.toml:5:13: reference: expected one of \"cosine\", \"uniform\", \"falloff\", \"depth\", "
     "found \"cosin\"; did you mean \"cosine\"?"},
    {"UnknownPartner", "reference = \"cosine\"", "partner = \"fwe\"",
     "small.toml:5:11: partner: expected the name of a technique under [techniques], found "
     "\"fwe\"; did you mean \"few\"?"},
    {"UnknownScore", "[\"depth\"]", "[\"uniform\", \"dept\"]",
     "small.toml:6:22: scores[2]: expected one of \"cosine\", \"uniform\", \"falloff\", \"depth\", "
     "found \"dept\"; did you mean \"depth\"?"},
    {"ScoreIsNumber", "[\"depth\"]", "[1]",
     "small.toml:6:11: scores[1]: expected a text in quotes, found 1"},
    {"NoTraining", "train = [\"a\", \"b\"]\n", "",
     "small.toml:1:1: train: expected names of scenes under [scenes], found nothing; add \"train\" "
     "here"},
    {"TestIsEmpty", "[\"c\"]", "[]",
     "small.toml:8:8: test: expected names of scenes under [scenes], found an array of 0"},
    {"UnknownView", "[\"a\", \"b\"]", "[\"a\", \"d\"]",
     "small.toml:7:15: train[2]: expected the name of a scene under [scenes], found \"d\"; one of: "
     "a, b, c"},
    {"TestOnATrainingView", "[\"c\"]", "[\"c\", \"a\"]",
     "small.toml:8:14: test[2]: expected a scene that is not in use yet, found \"a\" again: what "
     "is fitted on one view must be tested on another"},
    {"IdleView", "[\"a\", \"b\"]", "[\"a\"]",
     "small.toml:14:1: scenes.b: expected every scene in \"train\" or \"test\", found it in "
     "neither"},
    {"OwnRadius", "samples = 8", "radius = 0.5",
     "small.toml:24:1: techniques.few.radius: a technique that is matched has each view's radius; "
     "leave this out, or give \"radiusMultiplier\""},
    {"RadiusBesideRadii", "seed = 7", "seed = 7\nradii = [0.5]",
     "small.toml:13:1: scenes.a.radius: unknown key; one of: file, builtin, camera, exposure, "
     "ground"},
    {"RadiiAreText", "seed = 7", "seed = 7\nradii = [\"wide\"]",
     "small.toml:3:10: radii[1]: expected a number from 0.0001 to 10000, found \"wide\""},
    {"UnknownKey", "rays = 64", "rais = 64",
     "small.toml:3:1: rais: unknown key; did you mean \"rays\"?"},
    {"NoRays", "rays = 64", "rays = 0",
     "small.toml:3:8: rays: expected a whole number from 1 to 1048576, found 0"},
};

class MatchStudyError : public testing::TestWithParam<MatchMistake> {};

TEST_P(MatchStudyError, NamesPlaceExpectedAndFound) {
    try {
        parseMatchStudy(with(GetParam().from, GetParam().to), "small.toml");
        FAIL() << "was accepted";
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()), GetParam().message);
    }
}

INSTANTIATE_TEST_SUITE_P(Mistakes, MatchStudyError, testing::ValuesIn(matchMistakes),
                         [](const auto& test) { return std::string(test.param.name); });

// Studies of both kinds read included files by the same code.
class Include : public testing::Test {
  protected:
    void SetUp() override {
        root_ = fs::path(testing::TempDir()) /
                (std::string("obscura_include_") +
                 testing::UnitTest::GetInstance()->current_test_info()->name());
        writeFile(root_ / "part" / "more.toml", "[techniques.more]\ntechnique = \"crytek\"\n");
    }
    void TearDown() override { fs::remove_all(root_); }
    MatchStudy read(const std::string& included) const {
        return parseMatchStudy(with("seed = 7", "seed = 7\ninclude = [" + included + "]"), file());
    }
    std::string file() const { return (root_ / "small.toml").string(); }
    // Without the folder.
    std::string message(const std::string& included) const {
        try {
            read(included);
        } catch (const Error& error) {
            return without(root_.string() + "/", error.what());
        }
        return "was accepted";
    }
    fs::path root_;
};

TEST_F(Include, AddsTechniques) {
    const MatchStudy study = read("\"part/more.toml\"");
    ASSERT_EQ(study.techniques.size(), 2u);
    EXPECT_EQ(study.techniques[0].name, "more");
    EXPECT_EQ(study.techniques[0].place.file, (root_ / "part/more.toml").string());
}

TEST_F(Include, HashCoversWhatIsIncluded) {
    const std::string before = read("\"part/more.toml\"").sha256;
    EXPECT_EQ(read("\"part/more.toml\"").sha256, before);
    writeFile(root_ / "part" / "more.toml", "[techniques.more]\ntechnique = \"blizzard\"\n");
    EXPECT_NE(read("\"part/more.toml\"").sha256, before);
}

TEST_F(Include, ErrorsNameTheIncludedFile) {
    EXPECT_EQ(message("\"part/none.toml\""), "small.toml:3:12: include[1]: part/none.toml: cannot "
                                             "be read: No such file or directory");
    writeFile(root_ / "part" / "more.toml", "\n[techniques.few]\ntechnique = \"crytek\"\n");
    EXPECT_EQ(message("\"part/more.toml\""),
              "small.toml:23:1: techniques.few: expected a new name, found \"few\", which "
              "part/more.toml:2 has given already");
    writeFile(root_ / "part" / "other.toml", "[techniques.few]\ntechnique = \"crytek\"\n");
    EXPECT_EQ(message("\"part/more.toml\", \"part/other.toml\""),
              "part/other.toml:1:1: techniques.few: expected a new name, found \"few\", which "
              "part/more.toml:2 has given already");
    writeFile(root_ / "part" / "more.toml", "[techniques.more]\ntechnique = 3\n");
    EXPECT_EQ(message("\"part/more.toml\""), "part/more.toml:2:13: techniques.more.technique: "
                                             "expected a text in quotes, found 3");
    writeFile(root_ / "part" / "more.toml", "[techniques.m]\ntechnique = \"crytek\"\n[levels.a]\n");
    EXPECT_EQ(message("\"part/more.toml\""),
              "part/more.toml:3:2: levels: unknown key; one of: techniques");
    writeFile(root_ / "part" / "more.toml", "[techniques.m\n");
    EXPECT_THAT(message("\"part/more.toml\""), testing::StartsWith("part/more.toml:1:14: expected "
                                                                   "TOML"));
}

} // namespace
} // namespace obscura
