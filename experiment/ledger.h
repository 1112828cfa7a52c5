#pragma once

#include "protocols/reader/slots.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace obscura {

// Hands out the slots of the ordering scheme, so that the design stays balanced whatever happens.
// The ledger is a file of lines, one per change; it is locked while one is made, so any number of
// presenters may share a data folder.
//
// The rules. claim() gives the lowest returned slot, or, if there is none, the first never used.
// A session that ends in order before its last trial returns its slot. A session whose process
// died keeps it: the program cannot know what the participant has seen, so a person decides
// (obscura-experiment ledger --void N), or the same session goes on. Simulated and real
// participants never share a ledger, nor do two designs.
class Ledger {
  public:
    explicit Ledger(std::filesystem::path file) : file_(std::move(file)) {}

    std::vector<SlotRecord> history() const; // every line; an Error at the first damaged one
    std::vector<SlotRecord> records() const; // by slot, each slot's last change

    // Where `planned` sessions are completed or reserved already, an Error says so.
    int claim(const SessionId& session, const std::string& design = {}, int planned = highestSlot);
    // The slot of a session that broke off, for the same session to go on. An Error when another
    // has it by now, when it was completed, or when its session may still be running.
    void takeBack(int slot, const SessionId& session, const std::string& design = {});
    void complete(int slot); // Error when it is another's by now
    void giveBack(int slot); // Error when it was never claimed, or its process still runs here
    // Lines of sessions that it has lost, in the order in which they are to stand.
    void restore(const std::vector<SlotRecord>& lost);

  private:
    void change(int slot, SlotState state, void (*check)(const SlotRecord&));

    std::filesystem::path file_;
};

// Reserved on this machine by a process that is no more.
bool isOrphan(const SlotRecord& record);

// Why only a person can say that the slot may be given back: it was completed, or nobody here can
// know whether its session still runs. "" when there is no doubt.
std::string doubtOf(const SlotRecord& record);

// Holds a slot while a session runs; gives it back unless the session completes.
class SlotClaim {
  public:
    SlotClaim(Ledger& ledger, const SessionId& session, const std::string& design = {},
              int planned = highestSlot)
        : ledger_(ledger), slot_(ledger.claim(session, design, planned)) {}
    // Takes it back.
    SlotClaim(Ledger& ledger, int slot, const SessionId& session, const std::string& design = {})
        : ledger_(ledger), slot_(slot) {
        ledger.takeBack(slot, session, design);
    }
    ~SlotClaim();
    SlotClaim(const SlotClaim&) = delete;
    SlotClaim& operator=(const SlotClaim&) = delete;

    int slot() const { return slot_; }
    void complete();

  private:
    Ledger& ledger_;
    int slot_;
    bool completed_ = false;
};

} // namespace obscura
