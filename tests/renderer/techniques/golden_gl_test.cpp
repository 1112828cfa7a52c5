// Small stored images: what no formula says. Every condition of golden/golden.toml, both members:
// the image as shown, and its visibility. Judged by four numbers of golden/tolerances.toml: a
// difference that may be seen in a few values, one that no value may reach, and a bound on the
// signed mean, since faults of occlusion are shifts. scripts/bless renews them.
#include "base/files.h"
#include "gl/context.h"
#include "protocols/reader/toml_table.h"
#include "renderer/render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <set>

namespace obscura {
namespace {

namespace fs = std::filesystem;
const fs::path goldens = OBSCURA_SOURCE "/tests/renderer/golden";

struct Case {
    std::string name; // of the files
    std::size_t condition;
    int member;
};

void PrintTo(const Case& test, std::ostream* out) { *out << test.name; }

const Protocol& study() {
    static const Protocol protocol = readProtocol(goldens / "golden.toml");
    return protocol;
}

std::vector<Case> cases() {
    std::vector<Case> result;
    for (std::size_t i = 0; i < study().conditions.size(); ++i)
        for (const int member : {0, 1})
            result.push_back(
                {study().conditions[i].id + "_" +
                     study().conditions[i].roles[static_cast<std::size_t>(member)].technique,
                 i, member});
    return result;
}

struct Tolerances {
    double allowed, share, largest, mean;
};

Tolerances tolerancesOf(const std::string& kind) {
    const std::string file = (goldens / "tolerances.toml").string();
    const toml::table root = toml::parse(readFile(file), file);
    TomlTable table = *TomlTable(root, file, "").table(kind);
    table.text("reason"); // compulsory: a number without one is not a decision
    return {table.number("allowed", 0, 1), table.number("share", 0, 1),
            table.number("largest", 0, 1), table.number("mean", 0, 1)};
}

Image floatsOf(const Image8& image) {
    Image result{image.width, image.height, image.channels, {}};
    for (const std::uint8_t value : image.pixels)
        result.pixels.push_back(static_cast<float>(value) / 255.0f);
    return result;
}

class Golden : public testing::TestWithParam<Case> {
  protected:
    static void SetUpTestSuite() {
        context_ = std::make_unique<gl::Context>();
        renderer_ = std::make_unique<RecipeRenderer>(Folders{});
    }
    static void TearDownTestSuite() {
        renderer_.reset();
        context_.reset();
    }
    static void judge(const Image& golden, const Image& now, const std::string& kind) {
        const Tolerances tolerances = tolerancesOf(kind);
        ASSERT_EQ(golden.pixels.size(), now.pixels.size());
        const Difference difference = compare(golden, now, tolerances.allowed);
        EXPECT_LE(difference.share, tolerances.share) << kind;
        EXPECT_LE(difference.largest, tolerances.largest) << kind;
        EXPECT_LE(std::abs(difference.mean), tolerances.mean) << kind;
        EXPECT_GT(tolerances.largest, tolerances.allowed);
    }

    inline static std::unique_ptr<gl::Context> context_;
    inline static std::unique_ptr<RecipeRenderer> renderer_;
};

TEST_P(Golden, LooksAsItDid) {
    const auto& [name, condition, member] = GetParam();
    SceneHashes scenes({});
    const Recipe recipe =
        makeRecipe(study(), study().conditions[condition], member, scenes, context_->driver());
    const Rendering now = renderer_->render(recipe);
    if (const char* folder = std::getenv("OBSCURA_BLESS")) { // scripts/bless
        writePng(fs::path(folder) / (name + ".png"), now.image);
        writeExr(fs::path(folder) / (name + ".exr"), now.visibility, std::array{std::string("V")});
        if (!fs::exists(goldens / (name + ".png")))
            return;
    }
    ASSERT_TRUE(fs::exists(goldens / (name + ".png"))) << "no golden image; scripts/bless makes it";
    judge(floatsOf(readImage8(goldens / (name + ".png"))), floatsOf(now.image), "image");
    judge(readImage(goldens / (name + ".exr")), now.visibility, "visibility");
}

INSTANTIATE_TEST_SUITE_P(Cases, Golden, testing::ValuesIn(cases()), [](const auto& test) {
    std::string name = test.param.name;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
    return name;
});

TEST(GoldenCases, CoverEveryTechniqueAndLevel) {
    std::set<std::string> shown, levels;
    for (const Condition& condition : study().conditions) {
        levels.insert(condition.level);
        for (const Role& role : condition.roles)
            shown.insert(study().technique(role.technique).technique);
    }
    for (const Technique& row : techniques())
        EXPECT_TRUE(shown.contains(std::string(row.id))) << row.id;
    EXPECT_EQ(levels, (std::set<std::string>{"low", "moderate", "high"}));
}

} // namespace
} // namespace obscura
