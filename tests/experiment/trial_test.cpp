#include "tests/experiment/trial_bench.h"

namespace obscura {
namespace {

using Next = TrialMachine::Next;
using gl::Key;
using test::Bench;
using test::frame;

TEST(Trial, GoesThroughItsScreensInOrder) {
    Bench bench;
    EXPECT_EQ(bench.machine.next(), Next::present);
    bench.settle();
    EXPECT_EQ(bench.machine.screen(), test::startPage);
    EXPECT_EQ(bench.machine.next(), Next::wait);
    bench.tap(Key::space);
    bench.settle();
    EXPECT_EQ(bench.machine.screen(), test::firstImage);
    bench.tap(Key::space);
    EXPECT_EQ(bench.machine.screen(), test::mask);
    bench.settle();
    EXPECT_EQ(bench.machine.screen(), test::secondImage);
    bench.tap(Key::space);
    bench.settle();
    EXPECT_EQ(bench.machine.screen(), test::question);
    bench.tap(Key::two);
    EXPECT_EQ(bench.machine.next(), Next::finished);
    EXPECT_EQ(bench.answer(), "2");
    EXPECT_FALSE(bench.record().interrupted);
}

TEST(Trial, JournalsBeforeImageOneAndOnlyThere) {
    Bench bench;
    bench.settle();
    EXPECT_EQ(bench.machine.next(), Next::wait);
    bench.tap(Key::space);
    EXPECT_EQ(bench.machine.next(), Next::journal);
    EXPECT_EQ(bench.machine.next(), Next::journal) << "until it has been done";
    bench.machine.journalled();
    EXPECT_EQ(bench.machine.next(), Next::present);
    bench.settle();
    bench.tap(Key::escape), bench.settle(), bench.tap(Key::one);
    EXPECT_EQ(bench.machine.next(), Next::present) << "image 1 again, journalled already";
}

// A blank ends by the clock: what is written after it would hold up the image.
TEST(Trial, JournalsBeforeTheBlankThatLeadsToTheImage) {
    Phase page, blank, image;
    page.text = "start";
    blank.grey = 128, blank.seconds = 0.1, blank.key = false;
    image.images = {"1"};
    Bench bench({page, blank, image}, 1);
    EXPECT_EQ(bench.machine.next(), Next::present) << "the page, which has no end of its own";
    bench.machine.shown(10);
    bench.tap(gl::Key::space);
    EXPECT_EQ(bench.machine.next(), Next::journal);
    bench.machine.journalled();
    while (bench.machine.next() == Next::present)
        bench.step();
    EXPECT_EQ(bench.machine.screen(), 2) << "without another";
}

TEST(Trial, RecordsTimes) {
    Bench bench;
    bench.settle();
    bench.look(1);
    bench.tap(Key::space);
    bench.settle();
    const double onset1 = bench.now;
    bench.look(3);
    bench.tap(Key::space);
    bench.settle();
    const double onset2 = bench.now;
    bench.look(2);
    bench.tap(Key::space);
    bench.settle();
    const double question = bench.now;
    bench.look(0.7);
    bench.tap(Key::one);

    EXPECT_NEAR(bench.phase(test::firstImage).onset, onset1, 1e-9);
    EXPECT_NEAR(bench.phase(test::firstImage).view, 3 + frame, 1e-9)
        << "until the mask replaced it";
    EXPECT_NEAR(bench.phase(test::mask).view, 2, 1e-9);
    EXPECT_NEAR(bench.phase(test::secondImage).onset, onset2, 1e-9);
    EXPECT_NEAR(bench.phase(test::secondImage).onset,
                bench.phase(test::firstImage).onset + bench.phase(test::firstImage).view +
                    bench.phase(test::mask).view,
                1e-9);
    EXPECT_NEAR(bench.phase(test::secondImage).view, 2 + frame, 1e-9);
    EXPECT_NEAR(bench.phase(test::question).onset, question, 1e-9);
    EXPECT_NEAR(bench.record().answers[0].seconds, 0.7, 1e-9);
}

TEST(Trial, MaskLastsExactlyItsRefreshes) {
    for (const double mask : {0.1, 0.5, 2.0}) {
        Bench bench(mask);
        bench.toSecond();
        const int planned = static_cast<int>(mask * 60 + 0.5);
        EXPECT_EQ(bench.phase(test::mask).framesPlanned, planned);
        EXPECT_EQ(bench.phase(test::mask).framesShown, planned);
        EXPECT_EQ(bench.maskShown, planned);
        EXPECT_EQ(bench.phase(test::mask).missedFrames, 0);
        EXPECT_EQ(bench.phase(test::mask).intervals.size(), static_cast<std::size_t>(planned));
    }
}

TEST(Trial, AMissedRefreshIsCountedAndMadeUpFor) {
    Bench bench(0.5);
    bench.toMask();
    for (int i = 0; i < 10; ++i)
        bench.step();
    bench.step(3 * frame); // two refreshes missed
    bench.settle();
    EXPECT_EQ(bench.phase(test::mask).missedFrames, 1) << "intervals, not refreshes";
    EXPECT_EQ(bench.maskShown, 28);
    EXPECT_EQ(bench.phase(test::mask).framesShown, 30);
    EXPECT_NEAR(bench.phase(test::mask).view, 0.5, 1e-9);
}

// Bridges et al. 2020: above 1.2 refreshes.
TEST(Trial, AnIntervalOfMoreThanOnePointTwoRefreshesIsMissed) {
    for (const auto& [refreshes, missed] : {std::pair(1.19, 0), std::pair(1.21, 1)}) {
        Bench bench(0.5);
        bench.toMask();
        for (int i = 0; i < 10; ++i)
            bench.step();
        bench.step(refreshes * frame);
        bench.settle();
        EXPECT_EQ(bench.phase(test::mask).missedFrames, missed) << refreshes;
    }
}

TEST(Trial, AStallAtTheVeryEndShowsInTheCount) {
    Bench bench(0.5);
    bench.toMask();
    while (bench.machine.screen() == test::mask)
        bench.step();
    bench.step(2 * frame); // image 2 comes one refresh late
    EXPECT_EQ(bench.phase(test::mask).framesPlanned, 30);
    EXPECT_EQ(bench.phase(test::mask).framesShown, 31);
    EXPECT_EQ(bench.phase(test::mask).missedFrames, 1);
    EXPECT_NEAR(bench.phase(test::mask).view, 31 * frame, 1e-9);
}

TEST(Trial, ALateStampIsNoMissedRefresh) {
    Bench bench(0.5);
    bench.toMask();
    for (int i = 0; i < 10; ++i)
        bench.step();
    bench.step(1.6 * frame);
    bench.step(0.4 * frame);
    bench.settle();
    EXPECT_EQ(bench.maskShown, 30);
    EXPECT_EQ(bench.phase(test::mask).framesShown, 30);
    EXPECT_EQ(bench.phase(test::mask).missedFrames, 1)
        << "above 1.2 frames it is marked all the same";
}

// Wherever in the mask: a short interval before a long one is no refresh that was not.
TEST(Trial, AShortIntervalBeforeALongOneEndsNoMaskEarly) {
    for (int at = 1; at < 30; ++at) { // the first interval is that before its onset
        Bench bench(0.5);
        bench.toMask();
        for (int swaps = 0; bench.machine.screen() == test::mask; ++swaps)
            bench.step(swaps == at ? 0.2 * frame : swaps == at + 1 ? 1.8 * frame : frame);
        EXPECT_EQ(bench.maskShown, 30) << at;
    }
}

// Drivers may queue the first swaps after a still picture.
TEST(Trial, SwapsThatReturnEarlyStillCountAsOneRefreshEach) {
    Bench bench(0.5);
    bench.toMask();
    bench.step(frame);
    bench.step(0.01 * frame);
    bench.step(0.7 * frame);
    bench.settle();
    EXPECT_EQ(bench.maskShown, 30);
    EXPECT_EQ(bench.phase(test::mask).framesShown, 30);
    EXPECT_EQ(bench.phase(test::mask).missedFrames, 0);
}

TEST(Trial, SpaceInTheMaskChangesNothingButIsCounted) {
    Bench bench(0.5);
    bench.toMask();
    bench.tap(Key::space); // before the grey is even on the screen
    for (int i = 0; i < 4; ++i) {
        bench.step();
        bench.tap(Key::space);
    }
    bench.tap(Key::one);
    bench.settle();
    EXPECT_EQ(bench.machine.screen(), test::secondImage);
    EXPECT_EQ(bench.machine.next(), Next::wait);
    EXPECT_EQ(bench.maskShown, 30);
    EXPECT_EQ(bench.phase(test::mask).earlyPresses, 6);
    EXPECT_EQ(bench.answer(), "");
}

TEST(Trial, APressQueuedWhileImageTwoComesOnIsDrained) {
    Bench bench(0.5);
    bench.toMask();
    while (bench.machine.screen() == test::mask)
        bench.step();
    const double pressed = bench.now + 0.5 * frame;
    bench.machine.handle({Event::Kind::press, pressed, Key::space}); // image 2 is not on yet
    bench.machine.handle({Event::Kind::release, pressed, Key::space});
    bench.settle();
    EXPECT_EQ(bench.machine.screen(), test::secondImage);
    EXPECT_EQ(bench.phase(test::mask).earlyPresses, 1);

    // Delivered after the onset, but stamped before it: the same.
    bench.machine.handle({Event::Kind::press, pressed, Key::space});
    EXPECT_EQ(bench.machine.screen(), test::secondImage);
    EXPECT_EQ(bench.phase(test::mask).earlyPresses, 2);
}

TEST(Trial, AKeyHeldThroughTheMaskMustBeReleasedFirst) {
    Bench bench(0.5);
    bench.toFirst();
    bench.down(Key::space); // ends image 1, and stays down
    bench.settle();
    EXPECT_EQ(bench.machine.screen(), test::secondImage);
    EXPECT_EQ(bench.phase(test::mask).earlyPresses, 0);
    bench.look(1);
    bench.down(Key::space); // auto-repeat
    EXPECT_EQ(bench.machine.screen(), test::secondImage);
    bench.up(Key::space);
    EXPECT_EQ(bench.machine.screen(), test::secondImage);
    bench.down(Key::space);
    EXPECT_EQ(bench.machine.screen(), test::question);
}

TEST(Trial, AKeyPressedInTheMaskAndHeldIsCountedOnceAndDoesNotArm) {
    Bench bench(0.5);
    bench.toMask();
    bench.step();
    for (int i = 0; i < 5; ++i)
        bench.down(Key::space); // auto-repeat
    bench.settle();
    bench.down(Key::space);
    EXPECT_EQ(bench.machine.screen(), test::secondImage);
    EXPECT_EQ(bench.phase(test::mask).earlyPresses, 1);
    bench.up(Key::space), bench.down(Key::space);
    EXPECT_EQ(bench.machine.screen(), test::question);
}

TEST(Trial, TheSpaceThatStartsThePairDoesNotEndImageOne) {
    Bench bench;
    bench.settle();
    bench.down(Key::space);
    bench.settle();
    bench.down(Key::space);
    bench.settle();
    EXPECT_EQ(bench.machine.screen(), test::firstImage);
}

TEST(Trial, KeysBeforeAPictureIsOnTheScreenDoNothing) {
    Bench bench;
    bench.tap(Key::space); // start page not yet shown
    bench.settle();
    EXPECT_EQ(bench.machine.screen(), test::startPage);
    bench.tap(Key::space);
    bench.tap(Key::space); // image 1 not yet shown
    bench.settle();
    EXPECT_EQ(bench.machine.screen(), test::firstImage);
    bench.toSecond();
}

// Told of only after the onset, but stamped before it.
TEST(Trial, APressOfBeforeTheOnsetIsNoAnswerToAnyScreen) {
    const auto late = [](Bench& bench, Key key) {
        const double before = bench.now - 0.001;
        bench.machine.handle({Event::Kind::press, before, key});
        bench.machine.handle({Event::Kind::release, before, key});
        bench.machine.handle({Event::Kind::option, before, {}, 1});
    };
    Bench bench(0.1);
    bench.settle(), late(bench, Key::space);
    EXPECT_EQ(bench.machine.screen(), test::startPage);
    bench.tap(Key::space), bench.settle(), late(bench, Key::space), late(bench, Key::escape);
    EXPECT_EQ(bench.machine.screen(), test::firstImage);
    bench.tap(Key::space), bench.settle(), late(bench, Key::space), late(bench, Key::escape);
    EXPECT_EQ(bench.machine.screen(), test::secondImage);
    bench.tap(Key::space), bench.settle(), late(bench, Key::two), late(bench, Key::escape);
    EXPECT_EQ(bench.machine.screen(), test::question);
    bench.tap(Key::escape), bench.settle(), late(bench, Key::two);
    EXPECT_EQ(bench.machine.screen(), leaveScreen);
    EXPECT_EQ(bench.answer(), "");
}

TEST(Trial, OnlySpaceEndsAnImage) {
    Bench bench;
    bench.toFirst();
    for (const Key key : {Key::one, Key::two, Key::left, Key::right, Key::enter, Key::backspace,
                          static_cast<Key>(65)})
        bench.tap(key);
    bench.click(1);
    bench.click(2);
    EXPECT_EQ(bench.machine.screen(), test::firstImage);
    EXPECT_EQ(bench.machine.next(), Next::wait);
}

TEST(Trial, AnswersByKeyArrowKeypadAndMouse) {
    const std::vector<std::pair<Key, int>> keys = {{Key::one, 1},       {Key::left, 1},
                                                   {Key::keypadOne, 1}, {Key::two, 2},
                                                   {Key::right, 2},     {Key::keypadTwo, 2}};
    for (const auto& [key, chosen] : keys) {
        Bench bench(0.1);
        bench.toQuestion();
        bench.tap(key);
        EXPECT_EQ(bench.answer(), std::to_string(chosen));
    }
    for (const int option : {1, 2}) {
        Bench bench(0.1);
        bench.settle();
        bench.click(1); // the start page's only option
        bench.settle();
        EXPECT_EQ(bench.machine.screen(), test::firstImage);
        bench.tap(Key::space), bench.settle(), bench.tap(Key::space), bench.settle();
        bench.click(option);
        EXPECT_EQ(bench.answer(), std::to_string(option));
    }
}

TEST(Trial, TheQuestionTakesNoOtherKeyAndNoSecondAnswer) {
    Bench bench(0.1);
    bench.toQuestion();
    for (const Key key : {Key::space, Key::enter, Key::backspace, static_cast<Key>(51)})
        bench.tap(key);
    EXPECT_EQ(bench.machine.next(), Next::wait);
    bench.tap(Key::one);
    bench.tap(Key::two);
    bench.click(2);
    bench.tap(Key::escape);
    EXPECT_EQ(bench.machine.next(), Next::finished);
    EXPECT_EQ(bench.answer(), "1");
}

TEST(Trial, NothingLeadsBack) {
    Bench bench(0.1);
    bench.toSecond();
    for (const Key key : {Key::backspace, Key::left, Key::one, static_cast<Key>(266)}) // page up
        bench.tap(key);
    EXPECT_EQ(bench.machine.screen(), test::secondImage);
    bench.tap(Key::space), bench.settle();
    for (const Key key : {Key::backspace, Key::space})
        bench.tap(key);
    EXPECT_EQ(bench.machine.screen(), test::question);
}

TEST(Trial, LostFocusMarksAnExposureAsInterrupted) {
    for (const bool inMask : {false, true}) {
        Bench bench(0.5);
        inMask ? bench.toMask() : bench.toFirst();
        bench.loseFocus();
        EXPECT_TRUE(bench.record().interrupted);
    }
    Bench second(0.1);
    second.toSecond();
    second.loseFocus();
    EXPECT_TRUE(second.record().interrupted);
}

TEST(Trial, LostFocusOnAPageOfTextBreaksNothing) {
    Bench bench(0.1);
    bench.settle();
    bench.loseFocus();
    bench.toQuestion();
    bench.loseFocus();
    bench.tap(Key::one);
    EXPECT_FALSE(bench.record().interrupted);
}

TEST(Trial, EscapeAsksAndContinueGoesBack) {
    for (const Key answer : {Key::one, Key::left, Key::escape}) {
        Bench bench(0.1);
        bench.toQuestion();
        bench.tap(Key::escape);
        EXPECT_EQ(bench.machine.screen(), leaveScreen);
        bench.settle();
        bench.tap(Key::space); // not an answer to that
        EXPECT_EQ(bench.machine.screen(), leaveScreen);
        bench.tap(answer);
        bench.settle();
        EXPECT_EQ(bench.machine.screen(), test::question);
        EXPECT_EQ(bench.answer(), "");
        EXPECT_FALSE(bench.record().interrupted);
    }
}

TEST(Trial, EscapeInAnImageInterruptsItAndPausesItsTime) {
    Bench bench(0.1);
    bench.toFirst();
    const double onset = bench.now;
    bench.look(2);
    bench.tap(Key::escape);
    bench.settle();
    bench.look(60);
    bench.tap(Key::one);
    bench.settle();
    EXPECT_EQ(bench.machine.screen(), test::firstImage);
    bench.look(1);
    bench.tap(Key::space);
    bench.settle();
    EXPECT_TRUE(bench.record().interrupted);
    EXPECT_NEAR(bench.phase(test::firstImage).onset, onset, 1e-9);
    EXPECT_NEAR(bench.phase(test::firstImage).view, 3 + 2 * frame, 1e-9);
    EXPECT_EQ(bench.machine.screen(), test::secondImage);
    EXPECT_EQ(bench.phase(test::mask).framesShown, 6);
}

TEST(Trial, APauseInTheQuestionDoesNotCountAsDeciding) {
    Bench bench(0.1);
    bench.toQuestion();
    bench.look(0.5);
    bench.tap(Key::escape), bench.settle(), bench.look(60), bench.tap(Key::one), bench.settle();
    bench.look(0.25);
    bench.tap(Key::two);
    EXPECT_NEAR(bench.record().answers[0].seconds, 0.75 + frame, 1e-9);
}

TEST(Trial, EscapeInTheMaskIsDrainedLikeAnyKey) {
    Bench bench(0.5);
    bench.toMask();
    bench.step();
    bench.tap(Key::escape);
    bench.settle();
    EXPECT_EQ(bench.machine.screen(), test::secondImage);
    EXPECT_EQ(bench.phase(test::mask).earlyPresses, 1);
    EXPECT_EQ(bench.maskShown, 30);
    EXPECT_FALSE(bench.record().interrupted);
}

TEST(Trial, LeavingEndsWithoutAnAnswer) {
    for (const bool byMouse : {false, true}) {
        Bench bench(0.1);
        bench.toSecond();
        bench.tap(Key::escape);
        bench.settle();
        byMouse ? bench.click(2) : bench.tap(Key::two);
        EXPECT_EQ(bench.machine.next(), Next::left);
        EXPECT_EQ(bench.answer(), "");
        bench.tap(Key::one);
        EXPECT_EQ(bench.machine.next(), Next::left);
    }
}

TEST(Trial, TheAnswerThatContinuesIsNoAnswerToTheQuestion) {
    Bench bench(0.1);
    bench.toQuestion();
    bench.tap(Key::escape), bench.settle();
    bench.down(Key::one); // continue; still held when the question is back
    bench.settle();
    bench.down(Key::one);
    EXPECT_EQ(bench.machine.next(), Next::wait);
    bench.up(Key::one), bench.down(Key::one);
    EXPECT_EQ(bench.answer(), "1");
}

} // namespace
} // namespace obscura
