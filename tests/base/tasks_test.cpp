#include "base/error.h"
#include "base/tasks.h"
#include "tests/error_of.h"
#include "tests/folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <string>
#include <vector>

namespace obscura {
namespace {

using testing::ElementsAre;
using testing::Pair;

// In the order of the plan, which is not that of the stages.
std::vector<Task> threeTasks(std::vector<std::string>& done) {
    const auto task = [&](const std::string& name, int stage) {
        return Task{{name, "", 2},
                    [&done, name] {
                        done.push_back(name);
                        return name + " is done";
                    },
                    stage};
    };
    return {task("last", 7), task("first", 0), task("second", 0)};
}

TEST(Tasks, AreDoneStageByStageAndTold) {
    const test::Folder root;
    std::vector<std::string> done;
    const std::vector<Task> tasks = threeTasks(done);
    Units units(root.path(), "", unitsOf(tasks));
    std::vector<std::pair<double, std::string>> told;
    doTasks(units, tasks,
            [&](double share, const std::string& note) { told.emplace_back(share, note); });
    EXPECT_THAT(done, ElementsAre("first", "second", "last"));
    EXPECT_THAT(told,
                ElementsAre(Pair(0, "first"), Pair(1 / 3.0, "second"), Pair(2 / 3.0, "last")));
    EXPECT_EQ(units.result("last"), "last is done");
    doTasks(units, tasks);
    EXPECT_EQ(done.size(), 3U) << "nothing is left to do";
}

// A stage waits for the one before it, whoever does that.
TEST(Tasks, AStageWaitsForWhatOthersDo) {
    const test::Folder root;
    std::vector<std::string> done;
    const std::vector<Task> tasks = threeTasks(done);
    Units units(root.path(), "", unitsOf(tasks)), other(root.path(), "", unitsOf(tasks));
    EXPECT_EQ(other.claimNext("", {}, [](const WorkUnit& unit) { return unit.name == "second"; }),
              "second");
    doTasks(units, tasks, [&](double share, const std::string& note) {
        if (note != "waiting for other workers")
            return;
        EXPECT_THAT(done, ElementsAre("first"));
        EXPECT_DOUBLE_EQ(share, 1 / 3.0);
        other.finish("second", "by the other");
    });
    EXPECT_THAT(done, ElementsAre("first", "last"));
    EXPECT_EQ(units.result("second"), "by the other");
}

// Such as stimuli of another protocol, which may have pictures of the same names.
TEST(Tasks, OtherWorkInTheFolderIsRefusedWhileItGoesOn) {
    const test::Folder root;
    std::vector<std::string> done;
    const std::vector<Task> tasks = threeTasks(done);
    Units units(root.path(), "", unitsOf(tasks)), other(root.path(), "", {{"of others", "", 1}});
    EXPECT_EQ(other.claimNext(""), "of others");
    EXPECT_THAT(test::errorOf([&] { doTasks(units, tasks); }),
                testing::AllOf(testing::HasSubstr("\"of others\""),
                               testing::HasSubstr(std::to_string(::getpid()))));
    EXPECT_THAT(done, testing::IsEmpty());
    other.finish("of others", "");
    units.giveBack("first");
    doTasks(units, tasks);
    EXPECT_EQ(done.size(), 3U);
}

TEST(Tasks, WhatFailsIsGivenBack) {
    const test::Folder root;
    std::vector<std::string> done;
    std::vector<Task> tasks = threeTasks(done);
    {
        Units units(root.path(), "", unitsOf(tasks));
        tasks[2].work = []() -> std::string { throw Error("no"); };
        EXPECT_THROW(doTasks(units, tasks), Error);
    }
    EXPECT_EQ(unitsState(root.path()).held.size(), 0U);
    EXPECT_EQ(unitsState(root.path()).done, 1U);
}

} // namespace
} // namespace obscura
