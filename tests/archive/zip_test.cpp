#include "archive/paths.h"
#include "archive/zip.h"
#include "base/files.h"
#include "tests/archive/zip_bytes.h"
#include "tests/error_of.h"
#include "tests/folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using test::deflatedOf;
using test::errorOf;
using test::zipBytes;
using test::ZipEntry;
using testing::HasSubstr;

// Its regular files with their contents, by path.
std::map<std::string, std::string> contentsOf(const fs::path& folder) {
    std::map<std::string, std::string> contents;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
        if (!entry.is_directory())
            contents[fs::relative(entry.path(), folder).generic_string()] = readFile(entry.path());
    return contents;
}

NewFiles someFiles(const fs::path& source) {
    writeFile(source, std::string(100000, 'p'));
    return {{"README.md", {"text\n"}},
            {"empty", {""}},
            {"a/b/ö.txt", {"umlaut"}},
            {"stimuli/a.png", {"", source}}};
}

TEST(Zip, WhatWeWriteOthersRead) {
    const test::Folder folder;
    const NewFiles files = someFiles(folder / "source");
    writeZip(folder / "study.zip", "study", files);
    fs::create_directory(folder / "out");
    // libarchive's, in CMake.
    const std::string command = "cd '" + (folder / "out").string() + "' && LC_ALL=C.UTF-8 '" +
                                OBSCURA_CMAKE + "' -E tar xf ../study.zip";
    ASSERT_EQ(std::system(command.c_str()), 0);
    const auto there = contentsOf(folder / "out/study");
    EXPECT_EQ(there.size(), files.size());
    for (const auto& [path, file] : files)
        EXPECT_EQ(there.at(path), path == "stimuli/a.png" ? std::string(100000, 'p') : file.text);
    EXPECT_EQ(unpackZip(folder / "study.zip", folder / "again"), folder / "again/study");
    EXPECT_EQ(contentsOf(folder / "again/study"), there);
}

TEST(Zip, EqualFilesGiveEqualBytes) {
    const test::Folder folder;
    writeZip(folder / "one.zip", "study", someFiles(folder / "source"));
    // Another time of the source's, and another time zone.
    fs::last_write_time(folder / "source",
                        fs::last_write_time(folder / "source") - std::chrono::hours(5000));
    ::setenv("TZ", "Asia/Tokyo", 1);
    writeZip(folder / "two.zip", "study", someFiles(folder / "elsewhere"));
    ::unsetenv("TZ");
    EXPECT_EQ(sha256File(folder / "one.zip"), sha256File(folder / "two.zip"));
}

TEST(Zip, NothingIsReplaced) {
    const test::Folder folder;
    writeFile(folder / "study.zip", "somebody's");
    EXPECT_NE(errorOf([&] { writeZip(folder / "study.zip", "study", {{"a", {"b"}}}); }), "");
    EXPECT_EQ(readFile(folder / "study.zip"), "somebody's");
}

TEST(Zip, OthersZipsAreUnpacked) {
    const test::Folder folder;
    const std::string text = "some words\n";
    ZipEntry packed{"s/packed", deflatedOf(text)};
    packed.method = 8;
    packed.size = static_cast<std::uint32_t>(text.size());
    packed.crc = test::crc32Of(text);
    ZipEntry directory{"s/d/", "", 040755};
    writeFile(folder / "z.zip", zipBytes({directory, {"s/d/stored", text}, packed}));
    EXPECT_EQ(unpackZip(folder / "z.zip", folder / "out"), folder / "out/s");
    EXPECT_THAT(contentsOf(folder / "out"),
                testing::UnorderedElementsAre(testing::Pair("s/d/stored", text),
                                              testing::Pair("s/packed", text)));
}

struct Hostile {
    const char* name;
    std::vector<ZipEntry> entries;
    std::string says;
};

ZipEntry with(ZipEntry entry, void (*change)(ZipEntry&)) {
    change(entry);
    return entry;
}

std::vector<Hostile> hostileZips() {
    const ZipEntry good{"s/a"};
    return {
        {"up", {good, {"../evil"}}, "leads out of its folder"},
        {"upFromWithin", {{"s/../../evil"}}, "leads out of its folder"},
        {"here", {{"s/./a"}}, "leads out of its folder"},
        {"absolute", {{"/evil"}}, "is absolute"},
        {"backslash", {{"s\\..\\..\\evil"}}, "backslash"},
        {"drive", {{"C:/evil"}}, "colon"},
        {"emptyPart", {{"s//a"}}, "an empty name"},
        {"control", {{"s/a\nb"}}, "control character"},
        {"longName", {{"s/" + std::string(300, 'n')}}, "255 bytes"},
        {"link", {good, {"s/link", "/etc", 0120777}}, "is a link"},
        {"device", {good, {"s/null", "", 020666}}, "is a link, a device"},
        {"folderAsFile", {{"s/d", "", 040755}}, "is a link, a device"},
        {"twice", {good, good}, "is there twice"},
        {"fileAndFolder", {good, {"s/a/b"}}, "is both a file and a folder"},
        {"twoFolders", {good, {"t/a"}}, "does not lie in the one folder"},
        {"encrypted", {with(good, [](ZipEntry& e) { e.flags = 1; })}, "is encrypted"},
        {"otherMethod", {with(good, [](ZipEntry& e) { e.method = 14; })}, "compressed by another"},
        {"huge",
         {with(good,
               [](ZipEntry& e) {
                   e.method = 8;
                   e.size = 0xfffffff0;
               })},
         "claims to have 4294967280 bytes"},
        {"longerThanDeclared",
         {with({"s/a", deflatedOf("0123456789")},
               [](ZipEntry& e) {
                   e.method = 8;
                   e.size = 5;
                   e.crc = test::crc32Of("0123456789");
               })},
         ""},
        {"shorterThanDeclared",
         {with({"s/a", deflatedOf("0123456789")},
               [](ZipEntry& e) {
                   e.method = 8;
                   e.size = 50;
                   e.crc = test::crc32Of("0123456789");
               })},
         ""},
        {"damaged", {with(good, [](ZipEntry& e) { e.crc = 1; })}, "is damaged"},
        {"notDeflate",
         {with({"s/a", "\xff\xff\xff\xff"}, [](ZipEntry& e) { e.method = 8; })},
         "is damaged"},
    };
}

class HostileZips : public testing::TestWithParam<Hostile> {};

TEST_P(HostileZips, AreRefusedAndWriteNothingElsewhere) {
    const test::Folder folder;
    writeFile(folder / "z.zip", zipBytes(GetParam().entries));
    const std::string error = errorOf([&] { unpackZip(folder / "z.zip", folder / "in/to"); });
    EXPECT_THAT(error, HasSubstr("z.zip: "));
    EXPECT_THAT(error, HasSubstr(GetParam().says));
    for (const auto& [path, content] : contentsOf(folder.path()))
        EXPECT_TRUE(path == "z.zip" || path.starts_with("in/to/s/")) << path;
    EXPECT_FALSE(fs::exists("/evil"));
}

INSTANTIATE_TEST_SUITE_P(Kinds, HostileZips, testing::ValuesIn(hostileZips()),
                         [](const auto& kind) { return std::string(kind.param.name); });

// Few bytes that unpack to very many, over many entries of which none is too much alone.
TEST(Zip, ManyLargeClaimsAreRefused) {
    const test::Folder folder;
    std::vector<ZipEntry> entries;
    for (int i = 0; i < 50; ++i) {
        entries.push_back({"s/" + std::to_string(i), deflatedOf("x")});
        entries.back().method = 8;
        entries.back().size = 300000; // of some 5000 bytes of zip in all
    }
    writeFile(folder / "z.zip", zipBytes(entries));
    EXPECT_THAT(errorOf([&] { unpackZip(folder / "z.zip", folder / "out"); }),
                HasSubstr("found files that claim 15000000 bytes"));
}

TEST(Zip, WhatIsNoZipIsRefused) {
    const test::Folder folder;
    for (const std::string& text : {std::string(), std::string("words"), std::string(22, '\0')}) {
        writeFile(folder / "z.zip", text);
        EXPECT_THAT(errorOf([&] { unpackZip(folder / "z.zip", folder / "out"); }),
                    HasSubstr("z.zip: expected"));
    }
    EXPECT_THAT(errorOf([&] { unpackZip(folder / "none.zip", folder / "out"); }),
                HasSubstr("none.zip: expected a zip file"));
}

// Cut anywhere it is refused; with any byte changed it is refused or unpacked, within its folder.
TEST(Zip, DamageIsSurvived) {
    const test::Folder folder;
    ZipEntry packed{"s/packed", deflatedOf("some words\n")};
    packed.method = 8;
    packed.size = 11;
    packed.crc = test::crc32Of("some words\n");
    const std::string whole = zipBytes({{"s/a"}, packed});
    for (std::size_t size = 0; size < whole.size(); ++size) {
        writeFile(folder / "z.zip", whole.substr(0, size));
        EXPECT_NE(errorOf([&] { unpackZip(folder / "z.zip", folder / "out"); }), "") << size;
    }
    EXPECT_FALSE(fs::exists(folder / "out/s/a"));
    int refused = 0;
    for (std::size_t at = 0; at < whole.size(); ++at) {
        std::string other = whole;
        other[at] = static_cast<char>(other[at] ^ 0x55);
        const fs::path out = folder / ("flip" + std::to_string(at));
        writeFile(folder / "z.zip", other);
        try {
            unpackZip(folder / "z.zip", out);
        } catch (const Error&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, static_cast<int>(whole.size()) / 2); // times and versions may change
    for (const auto& [path, content] : contentsOf(folder.path()))
        EXPECT_TRUE(path == "z.zip" || path.starts_with("flip")) << path;
}

TEST(Paths, PlainOnesAreTaken) {
    for (const char* path : {"a", "a/b.png", "..a/b..", "with blank/ö.csv", ".bidsignore"})
        EXPECT_EQ(faultOfPath(path), "") << path;
    for (const char* path : {"", "/", "a/", "a/..", "../a", "a\\b", "a:b", "a\tb"})
        EXPECT_NE(faultOfPath(path), "") << path;
}

} // namespace
} // namespace obscura
