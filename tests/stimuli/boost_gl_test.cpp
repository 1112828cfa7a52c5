#include "base/files.h"
#include "gl/context.h"
#include "stimuli/boost.h"
#include "stimuli/generate.h"
#include "tests/error_of.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

Image8 row(std::vector<std::uint8_t> values) {
    return {static_cast<int>(values.size()), 1, 1, std::move(values)};
}

Derivation how(double amplify, int magnify, std::array<int, 2> crop = {0, 0}) {
    Derivation result;
    result.amplify = amplify;
    result.magnify = magnify;
    result.crop = crop;
    return result;
}

TEST(Boosted, AmplifiesTheDifferenceFromTheReferenceAndCutsIt) {
    EXPECT_THAT(
        boosted(row({100, 110, 90, 250, 3}), row({100, 100, 100, 240, 9}), how(2, 1)).pixels,
        ElementsAre(100, 120, 80, 255, 0));
    EXPECT_THAT(boosted(row({101}), row({100}), how(2.5, 1)).pixels, ElementsAre(103)); // 102.5
    EXPECT_THAT(boosted(row({7, 200}), row({7, 200}), how(16, 1)).pixels, ElementsAre(7, 200));
}

// Lanczos' weights at a quarter of a pixel's distance, 3 lobes, by hand: sinc(x) sinc(x / 3) at
// -2.75, -1.75, -.75, .25, 1.25, 2.25 are .0074, -.0678, .2704, .8929, -.1328, .0300 (sum 1.0002).
TEST(Boosted, MagnifiesByLanczosKernel) {
    Image8 impulse{16, 2, 1, std::vector<std::uint8_t>(32, 0)};
    for (int y = 0; y < 2; ++y)
        impulse.pixels[static_cast<std::size_t>(16 * y + 7)] = 200;
    const Image8 result = boosted(impulse, impulse, how(2, 2, {4, 0}));
    ASSERT_EQ(result.width, 16);
    ASSERT_EQ(result.height, 2);
    // Sample x lies at 4 + (x + .5) / 2 - .5: samples 6 and 7 at 6.75 and 7.25.
    const std::vector<double> weights = {.0300, -.1328, .2704, .8929, .8929, .2704, -.1328, .0300};
    for (int i = 0; i < 8; ++i) {
        const int x = std::array{2, 4, 5, 6, 7, 8, 9, 11}[static_cast<std::size_t>(i)];
        EXPECT_NEAR(result.pixels[static_cast<std::size_t>(x)],
                    std::max(0.0, 200 * weights[static_cast<std::size_t>(i)]), 1.01)
            << x;
    }
}

TEST(Boosted, LeavesWhatIsEvenAsItIsAndShowsThePartThatWasNamed) {
    Image8 halves{8, 8, 3, std::vector<std::uint8_t>(192, 40)};
    for (std::size_t i = 96; i < 192; ++i) // below
        halves.pixels[i] = 220;
    const auto middleOf = [&](std::array<int, 2> crop) {
        const Image8 shown = boosted(halves, halves, how(2, 2, crop));
        return shown.pixels[3 * (4 * 8 + 4)];
    };
    EXPECT_NEAR(middleOf({0, 0}), 40, 12);
    EXPECT_NEAR(middleOf({4, 4}), 220, 12);
    const Image8 even{8, 8, 3, std::vector<std::uint8_t>(192, 77)};
    EXPECT_EQ(boosted(even, even, how(2, 2, {2, 2})).pixels, even.pixels);
}

std::string protocolText(const std::string& boost) {
    return "name = \"tiny\"\nseed = 3\nimage = { width = 64, height = 36, antialiasing = 1 }\n" +
           boost + R"(
[scenes.s]
builtin = "sculpture"
radius = 0.3
camera = { position = [0.8, 0.9, 1.9], target = [0.0, 0.57, 0.0] }
[levels.low]
ambient = [1, 1, 1]
[techniques]
none = { technique = "none" }
crytek = { technique = "crytek" }
blizzard = { technique = "blizzard" }
[[conditions]]
id = "c"
scene = "s"
level = "low"
roles = { a = "crytek", b = "blizzard", source = "none" }
[texts]
instructions = "i"
start = "s"
question = "q"
first = "1"
second = "2"
thanks = "t"
)";
}

const std::string boost = "[boost]\nreference = \"source\"\ncrop = { s = [20, 4] }\n";

class BoostedStimuli : public testing::Test {
  protected:
    static void SetUpTestSuite() { context_ = std::make_unique<gl::Context>(); }
    static void TearDownTestSuite() { context_.reset(); }
    void SetUp() override { fs::remove_all(out_); }

    GenerateResult run(const std::string& lines = boost) {
        return generate(parseProtocol(protocolText(lines), "tiny.toml"), {}, out_, false,
                        context_->driver(), quiet);
    }
    std::string fault(const std::string& lines = boost) {
        return test::errorOf([&] { verified(lines); });
    }
    void verified(const std::string& lines = boost) {
        verify(parseProtocol(protocolText(lines), "tiny.toml"), manifest(), {}, context_->driver(),
               quiet);
    }
    Manifest manifest() const { return readManifest(out_ / "manifest.json"); }
    Image8 load(const FileRecord& file) const { return readImage8(out_ / file.path, 3); }

    inline static const Announce quiet = [](int, int, const std::string&) {};
    inline static std::unique_ptr<gl::Context> context_;
    fs::path out_ = fs::path(testing::TempDir()) / "obscura_boosted";
};

TEST_F(BoostedStimuli, SayWhatTheyWereMadeOf) {
    EXPECT_EQ(run().rendered, 3);
    const ConditionRecord condition = manifest().conditions.at(0);
    const ImageRecord &a = condition.image("a"), &source = condition.image("source");
    ASSERT_TRUE(a.derived && source.derived);
    EXPECT_EQ(a.derived->fromSha256, a.layers.at("rendered").sha256);
    EXPECT_EQ(a.derived->referenceSha256, source.layers.at("rendered").sha256);
    EXPECT_EQ(a.derived->reference, "source");
    EXPECT_EQ(a.derived->amplify, 2);
    EXPECT_EQ(a.derived->magnify, 2);
    EXPECT_THAT(a.derived->crop, ElementsAre(20, 4));
    EXPECT_EQ(sha256File(out_ / a.image.path), a.image.sha256);
    EXPECT_EQ(load(a.image).pixels,
              boosted(load(a.layers.at("rendered")), load(source.layers.at("rendered")), *a.derived)
                  .pixels);
    EXPECT_NO_THROW(verified());
}

TEST_F(BoostedStimuli, AreMadeAnewWithoutRendering) {
    run();
    EXPECT_EQ(run("[boost]\nreference = \"source\"\namplify = 4\n").rendered, 0);
    EXPECT_EQ(manifest().conditions[0].image("a").derived->amplify, 4);
    EXPECT_EQ(run("").rendered, 0);
    EXPECT_FALSE(manifest().conditions[0].image("a").derived);
    EXPECT_NO_THROW(verified(""));
}

TEST_F(BoostedStimuli, AreRefusedWhenTheyAreNotWhatTheyShouldBe) {
    run();
    const Manifest whole = manifest();
    EXPECT_THAT(fault("[boost]\nreference = \"source\"\namplify = 4\n"),
                HasSubstr("was boosted otherwise than the protocol asks now"));
    EXPECT_THAT(fault(""), HasSubstr("is boosted, which the protocol does not ask"));

    const std::string file = whole.conditions[0].image("a").image.path;
    const std::string bytes = readFile(out_ / file);
    writeFile(out_ / file, bytes + " ");
    EXPECT_THAT(fault(), HasSubstr(file + ": has changed since it was made"));

    // Also when the manifest was made to agree: the other image in its place.
    writeFile(out_ / file, readFile(out_ / whole.conditions[0].image("b").image.path));
    Manifest forged = whole;
    forged.conditions[0].image("a").image.sha256 = sha256File(out_ / file);
    writeManifest(out_ / "manifest.json", forged);
    EXPECT_THAT(fault(), HasSubstr("is not what boosting the rendered images gives"));
    writeFile(out_ / file, bytes);
    writeManifest(out_ / "manifest.json", whole);
    EXPECT_NO_THROW(verified());
}

TEST(BoostTable, MistakesAreNamedWithTheirPlace) {
    const auto mistake = [](const std::string& lines) {
        return test::errorOf([&] { parseProtocol(protocolText(lines), "tiny.toml"); });
    };
    EXPECT_THAT(mistake("[boost]\n"), HasSubstr("expected an image \"reference\", which the others "
                                                "are boosted against, found none"));
    EXPECT_THAT(mistake("[boost]\nreference = \"source\"\nmagnify = 5\n"),
                HasSubstr("tiny.toml:6:1: boost.magnify: expected a divisor of the images' width "
                          "and height, 64 and 36, found 5"));
    EXPECT_THAT(mistake("[boost]\nreference = \"source\"\ncrop = { s = [33, 0] }\n"),
                HasSubstr("boost.crop.s: expected the top left corner of the part that is "
                          "magnified, [x, y] in whole pixels, at most [32, 18]"));
    EXPECT_THAT(mistake("[boost]\nreference = \"source\"\ncrop = { t = [3, 0] }\n"),
                HasSubstr("boost.crop.t: unknown key"));
    EXPECT_THAT(mistake("[boost]\nreference = \"source\"\namplify = 0.5\n"),
                HasSubstr("boost.amplify"));
    EXPECT_THAT(mistake("[boost]\nreference = \"source\"\ncrop = { s = [1.5, 0] }\n"),
                HasSubstr("whole pixels"));
}

} // namespace
} // namespace obscura
