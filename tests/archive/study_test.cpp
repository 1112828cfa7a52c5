#include "archive/study.h"
#include "base/files.h"
#include "tests/error_of.h"
#include "tests/folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using test::errorOf;
using testing::HasSubstr;

// As scripts/demo leaves it.
class FindStudy : public testing::Test {
  protected:
    FindStudy() {
        for (const char* file : {"results.json", "report.html", "stimuli/manifest.json",
                                 "data-1/demo/README.md", "data-1/demo/sessions/ledger.jsonl",
                                 "data-1/demo/data/a.csv", ".hidden/x/manifest.json"})
            writeFile(folder_ / file, "");
        writeFile(folder_ / "demo.toml", "[[conditions]]\n");
        writeFile(folder_ / "matched.toml", "[techniques.a]\n");
    }
    StudyPlaces found(StudyPlaces given = {}) const { return findStudy(folder_.path(), given); }
    std::string refusal(StudyPlaces given = {}) const {
        return errorOf([&] { found(given); });
    }

    test::Folder folder_;
};

TEST_F(FindStudy, KnowsPartsByWhatIsInThem) {
    const StudyPlaces places = found();
    EXPECT_EQ(places.protocol, folder_ / "demo.toml");
    EXPECT_EQ(places.stimuli, folder_ / "stimuli");
    EXPECT_EQ(places.data, folder_ / "data-1/demo");
    EXPECT_EQ(places.results, folder_.path());
}

TEST_F(FindStudy, AsksWhichOfSeveral) {
    writeFile(folder_ / "data-2/demo/sessions/ledger.jsonl", "");
    EXPECT_THAT(refusal(), HasSubstr("found 2: "));
    EXPECT_THAT(refusal(), HasSubstr("say which by --data"));
    EXPECT_EQ(found({{}, {}, folder_ / "data-2/demo", {}}).data, folder_ / "data-2/demo");
    EXPECT_EQ(found({{}, {}, folder_ / "data-2", {}}).data, folder_ / "data-2/demo")
        << "as obscura-experiment takes it";
}

TEST_F(FindStudy, SaysWhatIsMissing) {
    fs::remove(folder_ / "demo.toml");
    EXPECT_THAT(refusal(), HasSubstr("expected the protocol, a .toml file with [[conditions]]; "
                                     "name it by --protocol, for there is none in"));
    EXPECT_THAT(errorOf([] { findStudy("", {}); }), HasSubstr("or give a folder that has it"));
    EXPECT_THAT(refusal({folder_ / "matched.toml", {}, {}, {}}),
                HasSubstr("expected the protocol, a .toml file with [[conditions]], as --protocol "
                          "names it"));
    EXPECT_THAT(errorOf([&] { findStudy(folder_ / "nowhere", {}); }),
                HasSubstr("expected a study's folder, found none"));
}

TEST_F(FindStudy, ResultsMayBeMissing) {
    fs::remove(folder_ / "results.json");
    EXPECT_EQ(found().results, "");
}

} // namespace
} // namespace obscura
