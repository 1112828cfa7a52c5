// Several processes of obscura-bench stability fill one folder, and are killed meanwhile.
#include "base/files.h"
#include "base/units.h"
#include "tests/folder.h"
#include "tests/killed_workers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

namespace obscura {
namespace {

namespace fs = std::filesystem;

// Pictures of every kind: a failure test, and cameras with and without motion.
[[noreturn]] void runTests(const test::Folder& root, const std::string& out,
                           const std::vector<std::string>& more = {}) {
    std::vector<std::string> command{OBSCURA_BIN "/obscura-bench",
                                     "stability",
                                     "--quick",
                                     "--height",
                                     "72",
                                     "--scene",
                                     "sculpture",
                                     "--camera",
                                     "0",
                                     "1",
                                     "3",
                                     "0",
                                     "0.5",
                                     "0",
                                     "--frames",
                                     "3",
                                     "--out",
                                     root / out,
                                     "--technique",
                                     "none",
                                     "--technique",
                                     "crytek",
                                     "--technique",
                                     "alchemy samples=4"};
    for (const char* test : {"plane", "still", "turn"})
        command.insert(command.end(), {"--test", test});
    command.insert(command.end(), more.begin(), more.end());
    test::become(command, root / (out + ".log"));
}

std::map<std::string, std::string> contentsOf(const fs::path& folder) {
    std::map<std::string, std::string> result;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
        if (const std::string name = fs::relative(entry.path(), folder).string();
            entry.is_regular_file() && !name.starts_with("units/"))
            result[name] = sha256File(entry.path());
    return result;
}

TEST(SharedStability, IsThatOfOneProcessHoweverManyAreKilled) {
    const test::Folder root;
    int status = 0;
    const pid_t alone = test::startWorker([&] { runTests(root, "alone"); });
    ASSERT_EQ(::waitpid(alone, &status, 0), alone);
    ASSERT_EQ(status, 0) << readFile(root / "alone.log");

    EXPECT_GT(test::killWorkers(3, 6, 1.5, 1, [&] { runTests(root, "shared"); }), 0);
    const auto expected = contentsOf(root / "alone");
    EXPECT_EQ(contentsOf(root / "shared"), expected) << readFile(root / "shared.log");
    EXPECT_EQ(expected.size(), 3U + 4 * 3 + 1); // every test's and configuration's, and the GIF
    const UnitsState state = unitsState(root / "shared");
    EXPECT_EQ(state.units, (1 + 3) + 1 + 2 * 2 + 2U); // the test, frames, cameras, GIF and page
    EXPECT_EQ(state.done, state.units);
    EXPECT_THAT(state.held, testing::IsEmpty());

    // What is lost is made again, and the rest is not.
    fs::remove(root / "shared" / "pictures" / "plane-crytek.png");
    fs::remove(root / "shared" / "stability.csv");
    const pid_t again = test::startWorker([&] { runTests(root, "shared"); });
    ASSERT_EQ(::waitpid(again, &status, 0), again);
    ASSERT_EQ(status, 0) << readFile(root / "shared.log");
    EXPECT_EQ(contentsOf(root / "shared"), expected);
}

} // namespace
} // namespace obscura
