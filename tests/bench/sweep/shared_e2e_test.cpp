// Several processes of obscura-bench measure one sweep, and are killed meanwhile.
#include "base/files.h"
#include "base/units.h"
#include "bench/sweep/files.h"
#include "tests/folder.h"
#include "tests/killed_workers.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace obscura {
namespace {

namespace fs = std::filesystem;

// Four configurations, two views, two sizes.
const std::string studyText = R"(name = "tiny"
seed = 7
reference = "cosine"
rays = 16
radii = [0.2]
train = ["front"]
test = ["left", "right"]
training = { width = 48, height = 27 }
sizes = [[64, 36], [48, 27]]
frames = 3
seconds = 0.01
[light]
sky = {}
[scenes.front]
builtin = "sculpture"
camera = { position = [0.8, 0.9, 1.75], target = [0, 0.57, 0], fovDegrees = 38 }
[scenes.left]
builtin = "sculpture"
camera = { position = [-1.1, 0.8, 1.4], target = [0, 0.55, 0], fovDegrees = 38 }
[scenes.right]
builtin = "sculpture"
camera = { position = [1.3, 0.8, 1.2], target = [0, 0.55, 0], fovDegrees = 38 }
[techniques]
none = { technique = "none" }
crytek = { technique = "crytek", blur = [0, 1] }
starcraft = { technique = "starcraft", samples = 4, blur = 0 }
)";
constexpr std::size_t rowCount = 4 * 2 * 2;

class SharedSweep : public testing::Test {
  protected:
    SharedSweep() { writeFile(root_ / "tiny.toml", studyText); }

    // The program in place of this process; what it says goes into a log, and references into a
    // cache of the folder's own. `bits`: a renderer that calls itself otherwise.
    [[noreturn]] void become(const std::string& out, std::vector<std::string> more,
                             const char* bits = "128") const {
        std::vector<std::string> words{std::string(OBSCURA_BIN) + "/obscura-bench", "sweep",
                                       root_ / "tiny.toml", "--out", root_ / out};
        words.insert(words.end(), more.begin(), more.end());
        ::setenv("OBSCURA_CACHE", (root_ / (out + ".cache")).c_str(), 1);
        ::setenv("LP_NATIVE_VECTOR_WIDTH", bits, 1);
        const int file = ::open(logOf(out).c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
        ::dup2(file, 1);
        ::dup2(file, 2);
        std::vector<char*> raw;
        for (std::string& word : words)
            raw.push_back(word.data());
        raw.push_back(nullptr);
        ::execv(raw[0], raw.data());
        ::_exit(127);
    }
    fs::path logOf(const std::string& out) const { return root_ / (out + ".log"); }

    // From beginning to end.
    Sweep run(const std::string& out, const std::vector<std::string>& more,
              const char* bits = "128") const {
        int status = 0;
        const pid_t worker = test::startWorker([&] { become(out, more, bits); });
        EXPECT_EQ(::waitpid(worker, &status, 0), worker);
        EXPECT_EQ(status, 0) << readFile(logOf(out));
        return readSweep(root_ / out);
    }

    std::map<std::string, std::string> thumbnails(const std::string& out) const {
        std::map<std::string, std::string> hashes;
        for (const fs::directory_entry& entry : fs::directory_iterator(root_ / out / "thumbnails"))
            hashes[entry.path().filename()] = sha256File(entry.path());
        return hashes;
    }

    void expectAllDone(const std::string& out) const {
        const UnitsState state = unitsState(root_ / out);
        EXPECT_EQ(state.done, state.units);
        EXPECT_THAT(state.held, testing::IsEmpty());
        for (const fs::directory_entry& entry : fs::directory_iterator(root_ / out / "units"))
            EXPECT_THAT(entry.path().string(), testing::Not(testing::HasSubstr("claim-")));
    }

    const test::Folder root_;
};

std::size_t count(const Sweep& sweep, bool (SweepRow::*has)() const) {
    return static_cast<std::size_t>(std::count_if(
        sweep.rows.begin(), sweep.rows.end(), [&](const SweepRow& row) { return (row.*has)(); }));
}

TEST_F(SharedSweep, IsThatOfOneProcessHoweverManyAreKilled) {
    const std::vector<std::string> errors{"--measure", "errors"};
    const Sweep alone = run("alone", errors);
    ASSERT_EQ(alone.rows.size(), rowCount);
    EXPECT_EQ(count(alone, &SweepRow::hasErrors), rowCount);
    EXPECT_EQ(count(alone, &SweepRow::hasTimes), 0u);
    EXPECT_EQ(alone.rows[0].configuration, "none"); // in the study's order
    EXPECT_EQ(alone.rows[4].width, 48);
    EXPECT_EQ(alone.rows[8].view, "right");

    EXPECT_GT(test::killWorkers(3, 6, 1.5, 1, [&] { become("shared", errors); }), 0);
    EXPECT_EQ(readFile(root_ / "shared/sweep.csv"), readFile(root_ / "alone/sweep.csv"));
    for (const char* file : {"growth.csv", "sweep.json", "sweep.html"})
        EXPECT_EQ(sha256File(root_ / "shared" / file), sha256File(root_ / "alone" / file)) << file;
    EXPECT_EQ(thumbnails("shared"), thumbnails("alone"));
    EXPECT_EQ(thumbnails("alone").size(), rowCount);
    expectAllDone("shared");
}

TEST_F(SharedSweep, OfTwoAtOnceHasEveryErrorAndEveryTimeOnce) {
    test::killWorkers(2, 0, 0, 1, [&] { become("two", {}); });
    const Sweep two = readSweep(root_ / "two");
    EXPECT_EQ(two.rows.size(), rowCount) << readFile(logOf("two"));
    EXPECT_EQ(count(two, &SweepRow::hasErrors), rowCount);
    EXPECT_EQ(count(two, &SweepRow::hasTimes), rowCount);
    expectAllDone("two");
    const std::string csv = readFile(root_ / "two/sweep.csv");
    EXPECT_EQ(sweepCsv(run("two", {}).rows), csv) << "nothing is measured again";
}

// A renderer that calls itself otherwise stands for another machine.
TEST_F(SharedSweep, HasErrorsOfOneMachineAndTimesOfAnother) {
    const Sweep errors = run("one", {"--measure", "errors"}, "128");
    EXPECT_EQ(errors.machine.renderer, "");
    EXPECT_THAT(errors.machine.errorsBy, testing::HasSubstr("128 bits"));
    const Sweep both = run("one", {"--measure", "times"}, "256");
    EXPECT_THAT(both.machine.renderer, testing::HasSubstr("256 bits"));
    EXPECT_THAT(both.machine.errorsBy, testing::HasSubstr("128 bits"));
    EXPECT_EQ(both.machine.notes, "");
    EXPECT_EQ(count(both, &SweepRow::hasTimes), rowCount);
    ASSERT_EQ(both.rows.size(), errors.rows.size());
    for (std::size_t i = 0; i < both.rows.size(); ++i) {
        EXPECT_EQ(both.rows[i].matched.rmse, errors.rows[i].matched.rmse);
        EXPECT_EQ(both.rows[i].fitted, errors.rows[i].fitted); // timed as matched there
    }
    // Times of a third kind do not mix with them. Of as many rows, those stay that come first by
    // the kind's name.
    const Sweep third = run("one", {"--measure", "times"}, "128");
    EXPECT_THAT(third.machine.renderer, testing::HasSubstr("128 bits"));
    EXPECT_THAT(third.machine.notes,
                testing::StartsWith(fmt::format("{} rows were timed on another kind", rowCount)));
    EXPECT_THAT(readFile(logOf("one")), testing::HasSubstr("--measure times"));
    EXPECT_THAT(readFile(root_ / "one/sweep.html"), testing::HasSubstr("another kind of machine"));
    expectAllDone("one");
}

} // namespace
} // namespace obscura
