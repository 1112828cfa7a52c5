#include "bench/measure/timing_turn.h"
#include "tests/folder.h"

#include <gtest/gtest.h>

#include <memory>

namespace obscura {
namespace {

TEST(TimingTurn, IsOneProcessAtATimeInEachFolder) {
    const test::Folder root;
    const auto neverWaits = [] { ADD_FAILURE() << "nobody else is at work"; };
    auto first = std::make_unique<TimingTurn>(root.path(), neverWaits);
    const TimingTurn elsewhere(root / "other", neverWaits);
    int waited = 0;
    const TimingTurn second(root / ".", [&] { // another name of the same folder
        if (++waited == 2)
            first.reset();
    });
    EXPECT_EQ(waited, 2);
}

} // namespace
} // namespace obscura
