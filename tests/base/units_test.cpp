#include "base/error.h"
#include "base/files.h"
#include "base/process.h"
#include "base/random.h"
#include "base/units.h"
#include "tests/folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <set>
#include <thread>

namespace obscura {
namespace {

namespace fs = std::filesystem;

std::vector<WorkUnit> planOf(int units, int groups = 1) {
    std::vector<WorkUnit> plan;
    for (int i = 0; i < units; ++i)
        plan.push_back({fmt::format("unit {}", i), fmt::format("group {}", i * groups / units), 1});
    return plan;
}

std::vector<fs::path> filesWith(const fs::path& folder, const std::string& part) {
    std::vector<fs::path> found;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (entry.path().filename().string().find(part) != std::string::npos)
            found.push_back(entry.path());
    return found;
}

// As if its process had not been heard of for an hour.
void age(const fs::path& path) {
    struct stat status {};
    ASSERT_EQ(::stat(path.c_str(), &status), 0);
    const timespec times[2]{{status.st_mtim.tv_sec - 3600, 0}, {status.st_mtim.tv_sec - 3600, 0}};
    ASSERT_EQ(::utimensat(AT_FDCWD, path.c_str(), times, 0), 0);
}

// A claim by a process of another machine, of which nothing but the lease can be known.
void claimElsewhere(const fs::path& claim) {
    ProcessId elsewhere = ProcessId::current();
    elsewhere.machine += "-b";
    writeFile(claim, elsewhere.text() + "\n0\n");
}

TEST(Units, EachIsGivenOnceAndItsResultStays) {
    const test::Folder root;
    Units units(root.path(), "a study", planOf(3)), other(root.path(), "a study", planOf(3));
    const auto first = units.claimNext(""), second = other.claimNext("");
    EXPECT_EQ(first, "unit 0");
    EXPECT_EQ(second, "unit 1");
    EXPECT_FALSE(units.result("unit 0"));
    EXPECT_TRUE(units.finish("unit 0", "nought"));
    EXPECT_EQ(other.result("unit 0"), "nought");
    EXPECT_EQ(units.claimNext(""), "unit 2");
    EXPECT_TRUE(units.finish("unit 2", "two"));
    other.giveBack("unit 1");
    EXPECT_EQ(units.claimNext(""), "unit 1");
    EXPECT_TRUE(units.finish("unit 1", "one"));
    EXPECT_FALSE(units.claimNext(""));
    EXPECT_FALSE(other.claimNext(""));
    EXPECT_TRUE(filesWith(root / "units", "claim").empty());
}

// Of what an earlier run made beside its results, here files, two are lost.
TEST(Units, WhatNoLongerStandsIsDoneAgainOnce) {
    const test::Folder root;
    const auto file = [&](const std::string& name) { return root / (name + ".txt"); };
    {
        Units units(root.path(), "", planOf(4));
        for (int i = 0; i < 3; ++i) {
            const std::string name = *units.claimNext("");
            writeFile(file(name), "made");
            units.finish(name, "first");
        }
    }
    fs::remove(file("unit 0"));
    fs::remove(file("unit 2"));
    const auto stands = [&](const std::string& name, const std::string& result) {
        return result == "first" ? fs::exists(file(name)) : true;
    };
    Units one(root.path(), "", planOf(4), std::chrono::minutes(2), stands),
        two(root.path(), "", planOf(4), std::chrono::minutes(2), stands);
    EXPECT_EQ(one.state().done, 1U);
    EXPECT_FALSE(one.isDone("unit 0"));
    EXPECT_EQ(one.claimNext(""), "unit 0");
    EXPECT_TRUE(one.finish("unit 0", "second")) << "in the place of the first result";
    EXPECT_EQ(one.result("unit 0"), "second");
    EXPECT_EQ(two.claimNext(""), "unit 2") << "unit 0 has been done again";
    EXPECT_EQ(two.result("unit 0"), "second");
    EXPECT_EQ(one.claimNext(""), "unit 3");
    EXPECT_TRUE(one.finish("unit 3", "first"));
    writeFile(file("unit 2"), "made");
    EXPECT_TRUE(two.finish("unit 2", "second"));
    EXPECT_FALSE(one.claimNext(""));
    EXPECT_FALSE(two.claimNext(""));
    EXPECT_EQ(one.costDone(), 4);
    EXPECT_EQ(unitsState(root.path()).done, 4U);
}

TEST(Units, WorkersStayInTheirGroupAndBeginWhereFewestWork) {
    const test::Folder root;
    Units a(root.path(), "", planOf(6, 3)), b(root.path(), "", planOf(6, 3));
    EXPECT_EQ(a.claimNext(""), "unit 0");
    EXPECT_EQ(b.claimNext(""), "unit 2") << "not in the first group, where another is";
    EXPECT_EQ(a.claimNext("group 0"), "unit 1");
    EXPECT_EQ(b.claimNext("group 0"), "unit 4") << "none of its group is open";
}

TEST(Units, AmongThoseThatAreAskedFor) {
    const test::Folder root;
    Units units(root.path(), "", planOf(3));
    const auto last = [](const WorkUnit& unit) { return unit.name == "unit 2"; };
    EXPECT_EQ(units.claimNext("", {}, last), "unit 2");
    units.finish("unit 2", "");
    EXPECT_FALSE(units.claimNext("", {}, last)) << "the others may stay undone";
}

TEST(Units, FirstResultCountsWhenTwoWereAtWork) {
    const test::Folder root;
    Units slow(root.path(), "", planOf(1)), quick(root.path(), "", planOf(1));
    EXPECT_EQ(slow.claimNext(""), "unit 0");
    const auto claims = filesWith(root / "units", "claim");
    ASSERT_EQ(claims.size(), 1U);
    claimElsewhere(claims[0]);
    age(claims[0]);
    EXPECT_EQ(quick.claimNext(""), "unit 0") << "its lease has run out";
    EXPECT_TRUE(quick.finish("unit 0", "of the quick"));
    EXPECT_FALSE(slow.finish("unit 0", "of the slow"));
    EXPECT_EQ(slow.result("unit 0"), "of the quick");
    EXPECT_TRUE(filesWith(root / "units", "claim").empty());
}

TEST(Units, ClaimOfAnotherMachineHoldsUntilItsLeaseEnds) {
    const test::Folder root;
    Units units(root.path(), "", planOf(1));
    EXPECT_EQ(units.claimNext(""), "unit 0");
    const fs::path claim = filesWith(root / "units", "claim").at(0);
    units.giveBack("unit 0");
    claimElsewhere(claim);
    int waited = 0;
    const auto name = units.claimNext("", [&] {
        EXPECT_EQ(unitsState(root.path()).held.size(), 1U);
        if (++waited == 2)
            age(claim);
    });
    EXPECT_EQ(name, "unit 0");
    EXPECT_EQ(waited, 2);
}

TEST(Units, HolderTouchesItsClaimWhileItWorks) {
    const test::Folder root;
    Units units(root.path(), "", planOf(1), std::chrono::milliseconds(40));
    EXPECT_EQ(units.claimNext(""), "unit 0");
    const fs::path claim = filesWith(root / "units", "claim").at(0);
    age(claim);
    const fs::file_time_type aged = fs::last_write_time(claim);
    while (fs::last_write_time(claim) == aged) // the event that is waited for
        std::this_thread::yield();
}

TEST(Units, WhatIsRequiredIsDoneOnceAndErrorsGiveItBack) {
    const test::Folder root;
    Units units(root.path(), "", planOf(2));
    int done = 0;
    const auto work = [&] { return fmt::format("done {}", ++done); };
    EXPECT_THROW(units.require("unit 1", []() -> std::string { throw Error("no"); }), Error);
    EXPECT_EQ(units.require("unit 1", work), "done 1");
    EXPECT_EQ(units.require("unit 1", work), "done 1");
    EXPECT_EQ(units.claimNext(""), "unit 0");
    Units other(root.path(), "", planOf(2));
    const auto waiting = [&] { units.finish("unit 0", "of the holder"); };
    EXPECT_EQ(other.require("unit 0", work, waiting), "of the holder");
}

TEST(Units, OtherWorkInTheFolderIsRefused) {
    const test::Folder root;
    { const Units units(root.path(), "study one", planOf(2)); }
    try {
        const Units units(root.path(), "study two", planOf(2));
        FAIL() << "expected an Error";
    } catch (const Error& error) {
        for (const char* part : {"units/about", "study one", "study two", "--out"})
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
    const Units more(root.path(), "study one", planOf(5)); // of the same study
    EXPECT_EQ(unitsState(root.path()).units, 5U);
}

TEST(Units, StateSaysWhoIsAtWorkAndHowLongItTakes) {
    const test::Folder root;
    EXPECT_THROW(unitsState(root.path()), Error);
    Units units(root.path(), "", planOf(10));
    for (int i = 0; i < 4; ++i)
        units.finish(*units.claimNext(""), "");
    EXPECT_FALSE(units.state().secondsLeft) << "nobody works";
    EXPECT_EQ(units.claimNext(""), "unit 4");
    const UnitsState state = unitsState(root.path());
    EXPECT_EQ(state.units, 10U);
    EXPECT_EQ(state.done, 4U);
    EXPECT_EQ(state.costDone, 4);
    ASSERT_EQ(state.held.size(), 1U);
    EXPECT_EQ(state.held[0].name, "unit 4");
    EXPECT_EQ(state.held[0].pid, ::getpid());
    EXPECT_EQ(state.held[0].machine, ProcessId::current().machine);
    ASSERT_TRUE(state.secondsLeft);
    EXPECT_GT(*state.secondsLeft, 0);
    age(filesWith(root / "units", "claim").at(0));
    EXPECT_EQ(unitsState(root.path()).broken, std::vector<std::string>{"unit 4"});
}

TEST(Units, PlanThatLiesIsNamed) {
    const test::Folder root;
    for (const char* text : {"", "{", "[]", R"({"units": [{"name": 3}]})", R"({"units": 3})"}) {
        writeFile(root / "units/plan-a.json", text);
        EXPECT_THROW(unitsState(root.path()), Error) << text;
    }
}

// A worker of the next test, in a process of its own: each result that it publishes first is a line
// in the folder's log.
[[noreturn]] void workUntilDone(const fs::path& folder, int units, std::uint64_t seed) {
    Units all(folder, "kill", planOf(units, 4));
    Random random(seed, "pace");
    std::string group;
    while (const auto name = all.claimNext(group)) {
        ::usleep(static_cast<useconds_t>(200 + 2000 * random.uniform()));
        all.finish(*name, *name + " is done");
    }
    ::_exit(0);
}

TEST(Units, NothingIsLostOrDoubledWhenWorkersAreKilled) {
    const test::Folder root;
    constexpr int units = 600, workers = 4, kills = 200;
    Random random(1, "kills");
    std::vector<pid_t> running;
    std::uint64_t seed = 0;
    int killed = 0, endings = 0;
    const auto start = [&] {
        const pid_t child = ::fork();
        if (child == 0)
            workUntilDone(root.path(), units, ++seed + 1000);
        ++seed;
        running.push_back(child);
    };
    for (int i = 0; i < workers; ++i)
        start();
    while (killed < kills) {
        ::usleep(static_cast<useconds_t>(4000 * random.uniform()));
        pid_t& victim = running[static_cast<std::size_t>(random.uniform() * workers)];
        ::kill(victim, SIGKILL);
        int status = 0;
        ASSERT_EQ(::waitpid(victim, &status, 0), victim);
        killed += WIFSIGNALED(status);
        endings += WIFEXITED(status); // all was done before it could be killed
        if (endings > 0)
            break;
        running.erase(running.begin() + (&victim - running.data()));
        start();
    }
    EXPECT_GE(killed, kills) << "too few units for so many kills";
    for (const pid_t child : running) {
        int status = 0;
        if (::waitpid(child, &status, 0) == child) {
            EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
        }
    }
    EXPECT_EQ(filesWith(root / "units", ".done").size(), std::size_t{units});
    const Units all(root.path(), "kill", planOf(units, 4));
    for (const WorkUnit& unit : planOf(units, 4))
        EXPECT_EQ(all.result(unit.name), unit.name + " is done");
    for (const char* left : {"claim", "unfinished"})
        EXPECT_TRUE(filesWith(root / "units", left).empty()) << left;
}

} // namespace
} // namespace obscura
