#include "tests/experiment/trial_bench.h"

namespace obscura {
namespace {

using gl::Key;
using test::Bench;

TEST(MinimumView, HoldsSpaceBack) {
    Bench bench(0.1, 1.5);
    bench.toFirst();
    bench.look(1), bench.tap(Key::space);
    EXPECT_EQ(bench.machine.screen(), test::firstImage);
    bench.look(0.6), bench.tap(Key::space);
    EXPECT_EQ(bench.machine.screen(), test::mask);
    bench.settle();
    bench.tap(Key::space);
    EXPECT_EQ(bench.machine.screen(), test::secondImage);
    bench.look(1.6), bench.tap(Key::space);
    EXPECT_EQ(bench.machine.screen(), test::question);
}

TEST(MinimumView, TwoTapsOfSpaceLoseNoPicture) {
    const double minimum = Trial().minimumView;
    EXPECT_EQ(minimum, 0.5);
    Bench bench(0.1, minimum);
    bench.settle();
    for (int i = 0; i < 8; ++i) { // one starts the pair, the others come too soon
        bench.tap(Key::space);
        bench.settle();
        bench.look(0.05);
    }
    EXPECT_EQ(bench.machine.screen(), test::firstImage);
    EXPECT_EQ(bench.hastyPresses(), 7);
    bench.look(0.2), bench.tap(Key::space), bench.settle();
    for (int i = 0; i < 4; ++i)
        bench.tap(Key::space), bench.look(0.1);
    EXPECT_EQ(bench.machine.screen(), test::secondImage);
    EXPECT_EQ(bench.hastyPresses(), 11);
    bench.look(0.2), bench.tap(Key::space), bench.settle();
    EXPECT_EQ(bench.machine.screen(), test::question);
    EXPECT_GE(bench.phase(test::firstImage).view, minimum);
    EXPECT_GE(bench.phase(test::secondImage).view, minimum);
    EXPECT_EQ(bench.phase(test::mask).earlyPresses, 0);
    EXPECT_FALSE(bench.record().interrupted);
}

TEST(MinimumView, HeldSpaceEndsNoImageHoweverLong) {
    Bench bench(0.1, 0.5);
    bench.settle();
    for (int i = 0; i < 100; ++i) // auto-repeat, should a system send it
        bench.down(Key::space), bench.settle(), bench.look(0.03);
    EXPECT_EQ(bench.machine.screen(), test::firstImage);
    EXPECT_EQ(bench.hastyPresses(), 0) << "one press, and it started the pair";
}

// Looking at the page that asks whether to leave is not looking at the image.
TEST(MinimumView, OnlyTimeInSightCountsTowardsTheMinimumView) {
    Bench bench(0.1, 0.5);
    bench.toFirst();
    bench.look(0.2);
    bench.tap(Key::escape), bench.settle(), bench.look(60), bench.tap(Key::one), bench.settle();
    bench.look(0.2), bench.tap(Key::space);
    EXPECT_EQ(bench.machine.screen(), test::firstImage);
    bench.look(0.2), bench.tap(Key::space);
    EXPECT_EQ(bench.machine.screen(), test::mask);
}

} // namespace
} // namespace obscura
