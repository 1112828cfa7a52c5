#include "base/error.h"
#include "base/files.h"
#include "base/process.h"
#include "tests/folder.h"
#include "tests/lossy_disk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace {

int linkAnswers = 0; // an errno that link() gives, whatever came of it

} // namespace

// In place of the C library's, to be a network's.
extern "C" int link(const char* from, const char* to) noexcept {
    const long failed = ::syscall(SYS_link, from, to);
    if (linkAnswers == 0)
        return static_cast<int>(failed);
    errno = linkAnswers;
    return -1;
}

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

// NFS says EEXIST to who asks again because the first answer was lost, sshfs EPERM for EEXIST.
TEST(Files, ANewFileIsOursOrTheirsWhateverANetworkAnswers) {
    const test::Folder root;
    linkAnswers = EEXIST;
    EXPECT_TRUE(writeNewFile(root / "a", "ours"));
    linkAnswers = EPERM;
    EXPECT_FALSE(writeNewFile(root / "a", "theirs"));
    linkAnswers = 0;
    EXPECT_FALSE(writeNewFile(root / "a", "theirs"));
    EXPECT_EQ(readFile(root / "a"), "ours");
    EXPECT_EQ(std::distance(fs::directory_iterator(root.path()), {}), 1);
}

TEST(Files, AFailedWriteKeepsTheOldFile) {
    const fs::path path = folder() / "a.txt";
    fs::create_directories(path / "in the way"); // a folder cannot be renamed over
    EXPECT_ANY_THROW(writeFile(path, "new"));
    EXPECT_TRUE(fs::exists(path / "in the way"));
    EXPECT_EQ(std::distance(fs::directory_iterator(path.parent_path()), {}), 1);
}

// What was told to be written is there after a power cut, with the folders above it; and at no
// moment before it is half there.
TEST(Files, APowerCutLosesNothingThatWasWritten) {
    const test::Folder root;
    writeFile(root / "old.txt", "first");
    const test::LossyDisk disk(root.path());
    writeFile(root / "old.txt", "second");
    writeFile(root / "new/deep/a.txt", "third");
    makeFolders(root / "empty/folder");
    writeFile(root / "empty/folder/b.txt", "fourth");
    using testing::Pair;
    EXPECT_THAT(disk.left(),
                testing::IsSupersetOf({Pair("old.txt", "second"), Pair("new/deep/a.txt", "third"),
                                       Pair("empty/folder/b.txt", "fourth")}));
}

// A name that writeFile() would give to what a process is writing.
std::string unfinishedBy(const ProcessId& process) {
    return ".obscura-unfinished." + process.text() + ".1";
}

ProcessId goneProcess() {
    ProcessId process = ProcessId::current();
    --process.start; // another that had this number
    return process;
}

TEST(Files, OnlyOurOwnUnfinishedFilesOfGoneProcessesAreRemoved) {
    const test::Folder root;
    writeFile(root / unfinishedBy(goneProcess()), "what a killed run leaves");
    ProcessId elsewhere = goneProcess();
    elsewhere.machine += "-b";
    const std::string gone = unfinishedBy(goneProcess());
    const std::vector<std::string> kept{unfinishedBy(ProcessId::current()),
                                        unfinishedBy(elsewhere),
                                        ".gitignore",
                                        ".env",
                                        ".first_a_crytek.123.png",
                                        ".obscura-unfinished",
                                        ".obscura-unfinished.",
                                        ".obscura-unfinished.1",
                                        ".obscura-unfinished.a.b.c.d.1",
                                        gone.substr(0, gone.size() - 2),
                                        gone + "x",
                                        gone + ".png",
                                        gone.substr(1),
                                        "x" + gone,
                                        "image.png"};
    for (const std::string& name : kept)
        writeFile(root / name, "of the user");
    // Links and folders are never ours, whatever they are called; nor is what they lead to.
    writeFile(root / "elsewhere" / gone, "of the user");
    fs::create_symlink(root / "image.png", root / (gone + "2"));
    fs::create_directory(root / (gone + "3"));
    fs::create_directory_symlink(root / "elsewhere", root / (gone + "4"));
    removeUnfinishedFiles(root.path());
    EXPECT_FALSE(fs::exists(root / gone));
    for (const std::string& name : kept)
        EXPECT_EQ(readFile(root / name), "of the user") << name;
    EXPECT_EQ(readFile(root / "elsewhere" / gone), "of the user");
    EXPECT_TRUE(fs::is_symlink(root / (gone + "2")));
    EXPECT_TRUE(fs::is_directory(root / (gone + "3")));
    EXPECT_TRUE(fs::is_symlink(root / (gone + "4")));
    EXPECT_NO_THROW(removeUnfinishedFiles(root / "nowhere"));
    EXPECT_NO_THROW(removeUnfinishedFiles(root / "image.png"));
}

TEST(Files, TheLongestNameCanBeWritten) {
    const test::Folder root;
    const std::string name(255, 'n');
    writeFile(root / name, "content");
    EXPECT_EQ(readFile(root / name), "content");
}

// Removing is the business of few: every place in the sources is listed here, with what it removes.
TEST(Files, NobodyElseRemovesAnything) {
    const std::map<std::string, int> allowed{
        {"files.cpp", 3},            // unfinished files of gone processes, and its own
        {"main.cpp", 1},             // the folder of obscura-validity's own process in memory
        {"new_files.cpp", 1},        // the folder in which this run was making an export or archive
        {"report.cpp", 1},           // a choice that obscura-bench choose wrote
        {"tallying.cpp", 1},         // a simulated study's CSV in that folder
        {"temporary_folder.cpp", 1}, // one in /tmp that obscura-archive has made for itself
        {"units.cpp",
         2} // claims of its own, of processes that were given up before it, and that are gone
    };
    std::map<std::string, int> found;
    const fs::path source = OBSCURA_SOURCE;
    const std::regex removal("(fs|filesystem)::remove(_all)?\\(|\\b(unlink|unlinkat|rmdir)\\(");
    for (const fs::directory_entry& top : fs::directory_iterator(source)) {
        const std::string folder = top.path().filename().string();
        if (!top.is_directory() || folder == "tests" || folder.starts_with("build") ||
            folder.starts_with("."))
            continue;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(top)) {
            if (entry.path().extension() != ".cpp" && entry.path().extension() != ".h")
                continue;
            const std::string text = readFile(entry.path());
            const auto count = std::distance(
                std::sregex_iterator(text.begin(), text.end(), removal), std::sregex_iterator());
            if (count > 0)
                found[entry.path().filename().string()] = static_cast<int>(count);
        }
    }
    EXPECT_EQ(found, allowed);
    for (const char* script : {"demo", "bless"}) // which write where a user's files may lie
        EXPECT_THAT(readFile(source / "scripts" / script),
                    testing::Not(testing::ContainsRegex("\\brm ")))
            << script;
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
