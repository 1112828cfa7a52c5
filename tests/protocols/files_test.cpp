#include "protocols/error.h"
#include "protocols/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace obscura {
namespace {

namespace fs = std::filesystem;

fs::path folder() {
    const fs::path path = fs::path(testing::TempDir()) / "obscura_files_test";
    fs::remove_all(path);
    return path;
}

// NIST FIPS 180-4 examples.
TEST(Sha256Test, GivesTheStandardsDigests) {
    EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    Sha256 parts;
    parts.add("abcdbcdecdefdefgefghfghighijhijk");
    parts.add("ijkljklmklmnlmnomnopnopq");
    EXPECT_EQ(parts.hex(), "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

TEST(Files, WriteLeavesNothingButTheFile) {
    const fs::path path = folder() / "deep" / "a.txt";
    writeFile(path, "first");
    writeFile(path, "second");
    EXPECT_EQ(readFile(path), "second");
    EXPECT_EQ(sha256File(path), sha256("second"));
    EXPECT_EQ(std::distance(fs::directory_iterator(path.parent_path()), {}), 1);
}

TEST(Files, AFailedWriteKeepsTheOldFile) {
    const fs::path path = folder() / "a.txt";
    fs::create_directories(path / "in the way"); // a folder cannot be renamed over
    EXPECT_ANY_THROW(writeFile(path, "new"));
    EXPECT_TRUE(fs::exists(path / "in the way"));
    EXPECT_EQ(std::distance(fs::directory_iterator(path.parent_path()), {}), 1);
}

TEST(Files, ReadingNamesThePathAndTheReason) {
    try {
        readFile("/nowhere/at/all");
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "/nowhere/at/all: cannot be read: No such file or directory");
    }
}

TEST(Suggestions, AreNearOrAbsent) {
    const std::vector<std::string> names{"blizzard", "crytek", "none"};
    EXPECT_EQ(nearest("blizard", names), "blizzard");
    EXPECT_EQ(nearest("cryteck", names), "crytek");
    EXPECT_EQ(nearest("raytracing", names), "");
}

} // namespace
} // namespace obscura
