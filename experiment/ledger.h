#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace obscura {

// One person's one session: what a slot is claimed for, and what names its files.
struct SessionId {
    std::string participant; // letters and digits
    int number = 1;
    bool simulated = false;
};

enum class SlotState { reserved, completed, returned };
std::string_view nameOf(SlotState state); // "void" for returned: what experimenters call it

// What became of a slot last.
struct SlotRecord {
    int slot = 0; // from 1
    SlotState state = SlotState::reserved;
    SessionId session;
    std::string machine, time;
    int process = 0;
};

// Hands out the slots of the ordering scheme, so that the design stays balanced whatever happens.
// The ledger is a file of lines, one per change; it is locked while one is made, so any number of
// presenters may share a data folder.
//
// The rules. claim() gives the lowest returned slot, or, if there is none, the first never used.
// A session that ends in order before its last trial returns its slot. A session whose process
// died keeps it: the program cannot know what the participant has seen, so a person decides
// (obscura-experiment ledger --void N). Simulated and real participants never share a ledger.
class Ledger {
  public:
    explicit Ledger(std::filesystem::path file) : file_(std::move(file)) {}

    std::vector<SlotRecord> records() const; // by slot, each slot's last change

    int claim(const SessionId& session);
    void complete(int slot);
    void giveBack(int slot); // Error when it was never claimed, or its process still runs here

  private:
    void change(int slot, SlotState state);

    std::filesystem::path file_;
};

// Reserved on this machine by a process that is no more.
bool isOrphan(const SlotRecord& record);

// Holds a slot while a session runs; gives it back unless the session completes.
class Claim {
  public:
    Claim(Ledger& ledger, const SessionId& session)
        : ledger_(ledger), slot_(ledger.claim(session)) {}
    ~Claim();
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;

    int slot() const { return slot_; }
    void complete();

  private:
    Ledger& ledger_;
    int slot_;
    bool completed_ = false;
};

} // namespace obscura
