#include "base/error.h"
#include "base/files.h"
#include "experiment/ledger.h"
#include "experiment/machine.h"
#include "tests/experiment/tiny_study.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <set>

namespace obscura {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

class LedgerTest : public testing::Test {
  protected:
    test::TemporaryFolder folder;
    std::filesystem::path file = folder.path() / "sessions" / "ledger.jsonl";
    Ledger ledger{file};

    int claim(const std::string& participant) { return ledger.claim({participant, 1, false}); }
};

TEST_F(LedgerTest, GivesSlotsInOrder) {
    EXPECT_TRUE(ledger.records().empty());
    EXPECT_EQ(claim("P1"), 1);
    EXPECT_EQ(claim("P2"), 2);
    ledger.complete(1);
    EXPECT_EQ(claim("P3"), 3);

    const auto records = ledger.records();
    ASSERT_EQ(records.size(), 3u);
    EXPECT_EQ(records[0].state, SlotState::completed);
    EXPECT_EQ(records[0].session.participant, "P1");
    EXPECT_EQ(records[1].state, SlotState::reserved);
    EXPECT_EQ(records[1].machine, machineName());
    EXPECT_EQ(records[1].process, ::getpid());
    EXPECT_EQ(records[1].owner, ProcessId::current());
}

TEST_F(LedgerTest, OffersReturnedSlotsFirstTheLowestBefore) {
    for (const char* id : {"P1", "P2", "P3", "P4"})
        claim(id);
    ledger.giveBack(3);
    ledger.giveBack(2);
    EXPECT_EQ(claim("P5"), 2);
    EXPECT_EQ(claim("P6"), 3);
    EXPECT_EQ(claim("P7"), 5);
}

TEST_F(LedgerTest, KeepsTheHistory) {
    claim("P1");
    ledger.giveBack(1);
    claim("P2");
    const std::string text = readFile(file);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
    EXPECT_THAT(text, HasSubstr("\"P1\""));
}

TEST_F(LedgerTest, AClaimReturnsItsSlotUnlessCompleted) {
    {
        SlotClaim one(ledger, {"P1", 1, false});
        SlotClaim two(ledger, {"P2", 1, false});
        two.complete();
    }
    EXPECT_EQ(ledger.records()[0].state, SlotState::returned);
    EXPECT_EQ(ledger.records()[1].state, SlotState::completed);
}

TEST_F(LedgerTest, SimulatedAndRealDoNotMix) {
    claim("P1");
    EXPECT_THAT(
        [&] {
            ledger.claim({"S01", 1, true});
        },
        ThrowsMessage<Error>(HasSubstr("this folder holds real participants; simulated "
                                       "ones need a data folder of their own: --data DIR")));
    EXPECT_EQ(claim("P2"), 2) << "the refused claim left nothing behind";
}

TEST_F(LedgerTest, AnUnknownSlotCannotBeGivenBack) {
    claim("P1");
    EXPECT_THAT([&] { ledger.giveBack(2); },
                ThrowsMessage<Error>(HasSubstr("slot 2 was never claimed; slots 1 to 1 were")));
}

TEST_F(LedgerTest, ATornLastLineIsRemoved) {
    claim("P1");
    std::ofstream(file, std::ios::app) << "{\"slot\":2,\"sta";
    EXPECT_EQ(ledger.records().size(), 1u);
    EXPECT_EQ(claim("P2"), 2);
    EXPECT_EQ(ledger.records().size(), 2u);
}

// An editor may have dropped the line feed; what it ended is no torn line.
TEST_F(LedgerTest, AWholeLastLineWithoutItsLineFeedIsKept) {
    claim("P1");
    std::string text = readFile(file);
    text.pop_back();
    writeFile(file, text);
    EXPECT_EQ(ledger.records().size(), 1u);
    EXPECT_EQ(claim("P2"), 2);
    EXPECT_EQ(ledger.records().size(), 2u);
}

std::string lineOf(const std::string& slot, const std::string& more = "") {
    return fmt::format(R"({{"slot":{},"state":"reserved","participant":"P1","session":1,)"
                       R"("simulated":false,"machine":"lab","process":7,)"
                       R"("time":"2026-01-31T23:59:59Z"{}}})"
                       "\n",
                       slot, more);
}

TEST_F(LedgerTest, SlotsOutOfRangeAreErrors) {
    for (const char* slot : {"0", "-1", "1000001", "4294967297", "1e9", "1.5", "\"1\"", "null"}) {
        writeFile(file, lineOf(slot));
        EXPECT_THAT([&] { claim("P2"); },
                    ThrowsMessage<Error>(
                        AllOf(HasSubstr("ledger.jsonl:1: expected"),
                              HasSubstr("\"slot\": expected a whole number from 1 to 1000000"))))
            << slot;
    }
}

TEST_F(LedgerTest, AGapInTheSlotsIsMissingLines) {
    writeFile(file, lineOf("1") + lineOf("4"));
    EXPECT_THAT([&] { claim("P2"); },
                ThrowsMessage<Error>(HasSubstr("ledger.jsonl:2: expected slots up to 2, found 4: "
                                               "lines are missing before this one")));
}

TEST_F(LedgerTest, ReadsLinesOfVersion1AndRefusesThoseOfALaterOne) {
    writeFile(file, lineOf("1"));
    EXPECT_FALSE(ledger.records().front().owner.has_value());
    EXPECT_EQ(claim("P2"), 2);
    writeFile(file, lineOf("1", ",\"format_version\":3"));
    EXPECT_THAT([&] { ledger.records(); },
                ThrowsMessage<Error>(HasSubstr("\"format_version\": expected a whole number from 1 "
                                               "to 2, found 3")));
}

TEST_F(LedgerTest, TwoDesignsNeverShareALedger) {
    ledger.claim({"P1", 1, false}, std::string(64, 'a'));
    EXPECT_EQ(ledger.claim({"P2", 1, false}, std::string(64, 'a')), 2);
    EXPECT_THAT(
        [&] {
            ledger.claim({"P3", 1, false}, std::string(64, 'b'));
        },
        ThrowsMessage<Error>(HasSubstr("slot 1 was claimed for another design")));
    EXPECT_EQ(ledger.records().size(), 2u);
}

// A number alone would be taken for the process that has it today.
TEST_F(LedgerTest, AnOwnerIsKnownByMachineBootAndStart) {
    const auto recordOf = [&](ProcessId owner, SlotState state = SlotState::reserved) {
        return SlotRecord{1,  state,      {"P1", 1, false}, machineName(),
                          "", ::getpid(), std::move(owner), {}};
    };
    const ProcessId self = ProcessId::current();
    ProcessId earlier = self, beforeBoot = self, elsewhere = self;
    --earlier.start;
    beforeBoot.boot = std::string(32, '0');
    elsewhere.machine = "another-0";
    EXPECT_FALSE(isOrphan(recordOf(self)));
    EXPECT_TRUE(isOrphan(recordOf(earlier)));
    EXPECT_TRUE(isOrphan(recordOf(beforeBoot)));
    EXPECT_FALSE(isOrphan(recordOf(elsewhere)));

    EXPECT_EQ(doubtOf(recordOf(earlier)), "");
    EXPECT_THAT(doubtOf(recordOf(elsewhere)), HasSubstr("cannot be seen from here"));
    EXPECT_THAT(doubtOf(recordOf(earlier, SlotState::completed)), HasSubstr("has completed it"));
    EXPECT_EQ(doubtOf(recordOf(elsewhere, SlotState::returned)), "");
}

TEST_F(LedgerTest, ASlotIsVoidedOnce) {
    claim("P1");
    ledger.giveBack(1);
    EXPECT_THAT([&] { ledger.giveBack(1); },
                ThrowsMessage<Error>(HasSubstr("slot 1 is void already")));
}

TEST_F(LedgerTest, VoidingMakesNoLedger) {
    EXPECT_THAT([&] { ledger.giveBack(1); },
                ThrowsMessage<Error>(HasSubstr("slot 1 was never claimed: there is no ledger")));
    EXPECT_FALSE(std::filesystem::exists(file));
}

// Voided by a person while it ran, and given to another since.
TEST_F(LedgerTest, ASessionDoesNotCompleteAnothersSlot) {
    SlotClaim mine(ledger, {"P1", 1, false});
    ledger.giveBack(1);
    const pid_t other = ::fork();
    if (other == 0) {
        ledger.claim({"P2", 1, false});
        ::_exit(0);
    }
    ::waitpid(other, nullptr, 0);
    EXPECT_THAT([&] { mine.complete(); },
                ThrowsMessage<Error>(HasSubstr("is that of participant P2 now")));
    EXPECT_EQ(ledger.records().front().state, SlotState::reserved);
}

TEST_F(LedgerTest, ADamagedLineIsAnErrorWithItsPlace) {
    claim("P1");
    std::ofstream(file, std::ios::app) << "nonsense\n";
    EXPECT_THAT([&] { claim("P2"); }, ThrowsMessage<Error>(HasSubstr("ledger.jsonl:2: expected")));
}

// Eight processes at once, each claiming and completing: no slot is held twice, none is lost.
// OBSCURA_CLAIMS=1000 for more (docs/measurement.md).
TEST_F(LedgerTest, ProcessesNeverShareASlot) {
    const char* asked = std::getenv("OBSCURA_CLAIMS");
    const int processes = 8, claims = asked ? std::atoi(asked) : 12;
    for (int p = 0; p < processes; ++p)
        if (::fork() == 0) {
            for (int i = 0; i < claims; ++i)
                ledger.complete(ledger.claim({fmt::format("P{}x{}", p, i), 1, false}));
            ::_exit(0);
        }
    for (int status = 0; ::wait(&status) > 0;)
        EXPECT_EQ(status, 0);

    std::set<std::string> participants;
    const auto records = ledger.records();
    for (const SlotRecord& record : records) {
        EXPECT_EQ(record.state, SlotState::completed);
        participants.insert(record.session.participant);
    }
    EXPECT_EQ(records.size(), static_cast<std::size_t>(processes * claims));
    EXPECT_EQ(records.back().slot, processes * claims);
    EXPECT_EQ(participants.size(), records.size());
}

// Claims a slot in another process and waits there, holding it.
class Holder {
  public:
    explicit Holder(Ledger& ledger) {
        int ready[2];
        EXPECT_EQ(::pipe(ready), 0);
        process_ = ::fork();
        if (process_ == 0) {
            ledger.claim({"Dead", 1, false});
            EXPECT_EQ(::write(ready[1], "r", 1), 1);
            ::pause();
            ::_exit(0);
        }
        char byte;
        EXPECT_EQ(::read(ready[0], &byte, 1), 1);
    }
    ~Holder() { die(); }
    void die() {
        if (process_ <= 0)
            return;
        ::kill(process_, SIGKILL);
        ::waitpid(process_, nullptr, 0);
        process_ = 0;
    }

  private:
    pid_t process_;
};

TEST_F(LedgerTest, ASlotOfADeadProcessStaysReservedUntilAPersonVoidsIt) {
    Holder holder(ledger);
    EXPECT_FALSE(isOrphan(ledger.records().front()));
    EXPECT_THAT([&] { ledger.giveBack(1); }, ThrowsMessage<Error>(HasSubstr("slot 1 is in use")));

    holder.die();
    EXPECT_TRUE(isOrphan(ledger.records().front()));
    EXPECT_EQ(claim("P2"), 2);
    ledger.giveBack(1);
    EXPECT_FALSE(isOrphan(ledger.records().front()));
    EXPECT_EQ(claim("P3"), 1);
}

} // namespace
} // namespace obscura
