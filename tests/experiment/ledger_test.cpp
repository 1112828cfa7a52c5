#include "experiment/ledger.h"
#include "experiment/machine.h"
#include "protocols/error.h"
#include "protocols/files.h"
#include "tests/experiment/tiny_study.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
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
        Claim one(ledger, {"P1", 1, false});
        Claim two(ledger, {"P2", 1, false});
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
                ThrowsMessage<Error>(HasSubstr("slot 2 was never claimed")));
}

TEST_F(LedgerTest, ATornLastLineIsRemoved) {
    claim("P1");
    std::ofstream(file, std::ios::app) << "{\"slot\":2,\"sta";
    EXPECT_EQ(ledger.records().size(), 1u);
    EXPECT_EQ(claim("P2"), 2);
    EXPECT_EQ(ledger.records().size(), 2u);
}

TEST_F(LedgerTest, ADamagedLineIsAnErrorWithItsPlace) {
    claim("P1");
    std::ofstream(file, std::ios::app) << "nonsense\n";
    EXPECT_THAT([&] { claim("P2"); }, ThrowsMessage<Error>(HasSubstr("ledger.jsonl:2: expected")));
}

// Sixteen processes at once, each claiming and completing or giving back: no slot is held twice,
// none is lost.
TEST_F(LedgerTest, ProcessesNeverShareASlot) {
    constexpr int processes = 16, claims = 6;
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
