#include "base/files.h"
#include "base/process.h"
#include "bench/status.h"
#include "tests/error_of.h"
#include "tests/folder.h"

#include <gmock/gmock.h>

namespace obscura {
namespace {

using testing::HasSubstr;

TEST(Status, SaysHowMuchIsDoneByHowManyAndHowLongItTakes) {
    UnitsState state;
    state.units = 600;
    state.done = 340;
    state.cost = 200;
    state.costDone = 114;
    EXPECT_EQ(progressText(state), "340 of 600 units, 57 % of the work; nobody works on it");
    EXPECT_THAT(statusText(state), HasSubstr("give the command again"));
    state.held = {{"errors of hbao", "node-1", 12, 61}, {"errors of gtao", "node-1", 13, 7300}};
    state.broken = {"fit of none"};
    state.secondsLeft = 500;
    EXPECT_EQ(statusText(state),
              "340 of 600 units, 57 % of the work; 2 processes, about 8 min 20 s left\n"
              "  errors of hbao: node-1, process 12, for 61 s\n"
              "  errors of gtao: node-1, process 13, for 2 h 01 min\n"
              "  fit of none: broken off, for its process is gone; the next one that comes does it "
              "again\n");
    state.held[1] = {"fit of gtao", "node-1", 12, 3}; // which it needs first
    EXPECT_THAT(progressText(state), HasSubstr("; 1 process, about"));
    state.done = state.units;
    state.costDone = state.cost;
    EXPECT_EQ(progressText(state), "600 of 600 units, 100 % of the work: all is done");
}

// Of a folder as processes leave it.
TEST(Status, ReadsAFolder) {
    const test::Folder root;
    EXPECT_THAT(test::errorOf([&] { unitsState(root.path()); }), HasSubstr("found none"));
    Units units(root.path(), "", {{"one", "", 1}, {"two", "", 3}, {"three", "", 4}});
    units.claimNext("");
    units.finish("one", "1");
    units.claimNext("");
    const std::string text = statusText(unitsState(root.path()));
    EXPECT_THAT(text, testing::StartsWith("1 of 3 units, 12 % of the work; 1 process"));
    EXPECT_THAT(text, HasSubstr("  two: " + ProcessId::current().machine + ", process "));
}

} // namespace
} // namespace obscura
