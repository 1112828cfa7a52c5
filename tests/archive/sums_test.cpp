#include "archive/sums.h"
#include "base/files.h"
#include "tests/error_of.h"
#include "tests/folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using test::errorOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class SumsTest : public testing::Test {
  protected:
    SumsTest() {
        NewFiles files{{"a b.txt", {"one"}}, {"d/ö.csv", {"two"}}, {"e", {""}}};
        files[sumsName] = {sumsOf(files)};
        writeFiles(archive(), files);
    }
    fs::path archive() const { return folder_ / "archive"; }
    std::vector<std::string> faults() const { return faultsOf(archive(), readSums(archive())); }
    // coreutils' word for it.
    bool isFine() const {
        const std::string command = "cd '" + archive().string() +
                                    "' && sha256sum --strict --quiet -c " + sumsName +
                                    " >/dev/null 2>&1";
        return std::system(command.c_str()) == 0;
    }

    test::Folder folder_;
};

TEST_F(SumsTest, Sha256sumReadsThem) {
    EXPECT_TRUE(isFine());
    EXPECT_THAT(faults(), IsEmpty());
    writeFile(archive() / "d/ö.csv", "twp");
    EXPECT_FALSE(isFine());
}

TEST_F(SumsTest, EachFaultIsNamed) {
    writeFile(archive() / "a b.txt", "onf");
    fs::remove(archive() / "e");
    writeFile(archive() / "new/file", "");
    EXPECT_THAT(faults(), ElementsAre("a b.txt has changed: its SHA-256 is not that of the list",
                                      "e is missing", "new/file is not in the list"));
}

TEST_F(SumsTest, LinksAreRefused) {
    fs::create_symlink("/etc/passwd", archive() / "link");
    EXPECT_THAT(errorOf([&] { faults(); }), HasSubstr("link: expected a file, found a link"));
    fs::remove(archive() / "link");
    fs::remove(archive() / sumsName);
    fs::create_symlink("/etc/passwd", archive() / sumsName);
    EXPECT_THAT(errorOf([&] { faults(); }), HasSubstr("found no SHA256SUMS"));
}

TEST_F(SumsTest, OtherListsAreRefused) {
    const std::string hash = sha256("x");
    for (const auto& [text, says] :
         {std::pair<std::string, const char*>{"words\n", ":1: expected a SHA-256"},
          {hash + "  a b.txt\n" + hash.substr(1) + "  e\n", ":2: expected a SHA-256"},
          {hash + "  ../e\n", ":1: expected a path within the archive"},
          {hash + "  /etc/passwd\n", "is absolute"},
          {hash + "  e\n" + hash + "  e\n", ":2: names \"e\" a second time"}}) {
        writeFile(archive() / sumsName, text);
        EXPECT_THAT(errorOf([&] { faults(); }), HasSubstr(says)) << text;
    }
}

TEST(Sums, NamesThatNotEverySystemHasAreRefused) {
    EXPECT_THAT(errorOf([] { sumsOf({{"data/a\\b.csv", {"x"}}}); }), HasSubstr("rename the file"));
}

} // namespace
} // namespace obscura
