// The documentation site: of this source it is built without a broken link, and its HTML is valid;
// a mistake in a source fails it, with the place.
#include "base/files.h"
#include "tests/folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

struct Outcome {
    int status = -1;
    std::string said; // on both channels
};

Outcome run(const std::string& command) {
    std::FILE* pipe = ::popen((command + " 2>&1 </dev/null").c_str(), "r");
    Outcome outcome;
    char buffer[4096];
    while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, pipe))
        outcome.said.append(buffer, count);
    const int status = ::pclose(pipe);
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome;
}

bool isInstalled(const std::string& program) { return run("command -v " + program).status == 0; }

class Site : public testing::Test {
  protected:
    void SetUp() override {
        for (const char* program : {"cmark-gfm", "python3"})
            if (!isInstalled(program))
                GTEST_SKIP() << "NOT TESTED: the documentation site, for which " << program
                             << " is to be installed";
        // A source of one page, which the tests add to.
        write("docs/site/home.html", "<meta name=\"generator\" content=\"$generator\">\n");
        write("README.md",
              "# Small\n\nA site.\n\n## What `--check` warns of\n\n## Twice\n\n## Twice\n");
    }

    void write(const std::string& name, const std::string& text) {
        fs::create_directories((source / name).parent_path());
        writeFile(source / name, text);
    }

    Outcome build() const {
        return run(fmt::format("'{}/docs/site/build.py' --root '{}' --out '{}'", OBSCURA_SOURCE,
                               source.string(), out.string()));
    }

    const test::Folder folder;
    const fs::path source = folder / "source";
    const fs::path out = folder / "out";
};

// What tidy of Debian 12 says of a page, but for attributes that are younger than it is.
std::string invalidities(const fs::path& page) {
    const std::string said = run(fmt::format("tidy -errors -quiet -utf8 '{}'", page.string())).said;
    return std::regex_replace(
        said, std::regex("[^\n]*proprietary attribute \"(aria-current|loading)\"\n"), "");
}

TEST_F(Site, OfThisSourceHasNoBrokenLinkAndIsValid) {
    const Outcome outcome =
        run(fmt::format("'{0}/docs/site/build.py' --out '{1}' --bench '{2}/obscura-bench'",
                        OBSCURA_SOURCE, out.string(), OBSCURA_BIN));
    ASSERT_EQ(outcome.status, 0) << outcome.said;
    for (const char* name :
         {"index.html", "readme.html", "viewer.html", "results/index.html",
          "results/llvmpipe-sponza/sweep.html", "results/llvmpipe-stability/stability.html"})
        EXPECT_TRUE(fs::is_regular_file(out / name)) << name;
    if (!isInstalled("tidy"))
        GTEST_SKIP()
            << "NOT TESTED: whether the site's HTML is valid, for which tidy is to be installed";
    // Pages of the bench have tests of their own, and figures that this tidy does not know.
    for (const fs::path& part : {out, out / "results"})
        for (const auto& entry : fs::directory_iterator(part))
            if (entry.path().extension() == ".html") {
                EXPECT_EQ(invalidities(entry.path()), "") << entry.path();
            }
}

// They travel with every clone.
TEST(Pictures, AreSmall) {
    std::uintmax_t total = 0;
    for (const auto& entry : fs::directory_iterator(OBSCURA_SOURCE "/docs/pictures")) {
        EXPECT_LE(entry.file_size(), 300'000u) << entry.path();
        total += entry.file_size();
    }
    EXPECT_LE(total, 2'000'000u);
    EXPECT_GT(total, 0u);
}

// The anchors are those that github.com gives the same headings.
TEST_F(Site, TakesLinksToPagesAnchorsAndPictures) {
    write("docs/pictures/dot.svg",
          "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 8 4\"/>");
    write("docs/other.md",
          "# Other\n\n[a](../README.md#what---check-warns-of) [b](../README.md#twice-1) "
          "[c](#other)\n\n![A dot](pictures/dot.svg)\n\n| a |\n|---|\n| 1 |\n");
    const Outcome outcome = build();
    ASSERT_EQ(outcome.status, 0) << outcome.said;
    const std::string page = readFile(out / "other.html");
    for (const char* part :
         {"href=\"readme.html#what---check-warns-of\"", "href=\"readme.html#twice-1\"",
          "src=\"pictures/dot.svg\" alt=\"A dot\" width=\"8\" height=\"4\"",
          "<div class=\"wide\" tabindex=\"0\"><table",
          "<a href=\"other.html\" aria-current=\"page\">Other</a>"})
        EXPECT_THAT(page, HasSubstr(part));
    EXPECT_THAT(page, Not(HasSubstr("sourcepos")));
}

TEST_F(Site, NamesThePlaceOfAMistake) {
    struct Mistake {
        std::string text, says;
    };
    const std::vector<Mistake> mistakes = {
        {"# A\n\nOne line,\nand [another](none.md).\n", "docs/a.md:4: expected a link to a page"},
        {"# A\n\n- [here](../README.md#here)\n",
         "docs/a.md:3: expected an anchor of README.md after the #; found \"../README.md#here\""},
        {"# A\n\n[here](#there)\n", "docs/a.md:3: expected an anchor of docs/a.md"},
        {"# A\n\n| a |\n|---|\n| 1 |\n| [2](b.md) |\n", "docs/a.md:6: "},
        {"# A\n\n![B](pictures/b.png)\n", "docs/a.md:3: expected a link to a file that is there"},
        {"# A\n\n[code](../CMakeLists.txt)\n", "docs/a.md:3: expected a link to a page"},
        {"# A\n\n# B\n", "docs/a.md:3: expected one heading of the first level"},
        {"Text.\n", "docs/a.md:1: expected a heading"},
        {"# A\n\nA <b>bold</b> word.\n",
         "docs/a.md:3: expected Markdown alone; found the HTML element <b>"},
        {"# A\n\nA <name>.\n", "docs/a.md:3: expected Markdown alone; found HTML or a bare <"},
        {"# A\n\n![B](https://example.org/b.png)\n", "expected nothing from the network"},
    };
    for (const Mistake& mistake : mistakes) {
        write("docs/a.md", mistake.text);
        const Outcome outcome = build();
        EXPECT_EQ(outcome.status, 1) << mistake.text << outcome.said;
        EXPECT_THAT(outcome.said, HasSubstr(mistake.says)) << mistake.text;
    }
}

TEST_F(Site, IsNotMixedWithOtherFiles) {
    fs::create_directories(out);
    writeFile(out / "index.html", "something else");
    EXPECT_EQ(build().status, 1);
    EXPECT_THAT(build().said, HasSubstr("expected a new folder for --out"));
    EXPECT_EQ(readFile(out / "index.html"), "something else");
    fs::remove(out / "index.html");
    EXPECT_EQ(build().status, 0);
    EXPECT_EQ(build().status, 0) << "a site of ours is built anew";
}

} // namespace
} // namespace obscura
