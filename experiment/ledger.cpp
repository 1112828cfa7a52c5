#include "experiment/ledger.h"

#include "base/error.h"
#include "experiment/append_file.h"
#include "experiment/machine.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

namespace {

// The lowest that was given back, else the first never used.
int freeSlot(const std::vector<SlotRecord>& records) {
    for (const SlotRecord& record : records)
        if (record.state == SlotState::returned)
            return record.slot;
    return records.empty() ? 1 : records.back().slot + 1;
}

void checkFits(const std::vector<SlotRecord>& history, const SessionId& session,
               const std::string& design, const Place& place) {
    for (const SlotRecord& record : history) {
        if (record.session.simulated != session.simulated)
            throw Error(place, fmt::format("this folder holds {} participants; {} ones need a data "
                                           "folder of their own: --data DIR",
                                           session.simulated ? "real" : "simulated",
                                           session.simulated ? "simulated" : "real"));
        if (!record.design.empty() && !design.empty() && record.design != design)
            throw Error(place, fmt::format("slot {} was claimed for another design of the study "
                                           "({:.12}..., not {:.12}...); another design needs "
                                           "another data folder (--data DIR) or another name",
                                           record.slot, record.design, design));
    }
}

void checkPlan(const std::vector<SlotRecord>& slots, int planned, const Place& place) {
    const auto in = [&](SlotState state) {
        return std::count_if(slots.begin(), slots.end(),
                             [&](const SlotRecord& record) { return record.state == state; });
    };
    const auto completed = in(SlotState::completed), reserved = in(SlotState::reserved);
    if (completed + reserved >= planned)
        throw Error(place, fmt::format("all {} participants that the protocol plans have taken "
                                       "part ({} completed, {} running or broken off); plan more "
                                       "(participants in [ordering], which is no part of the "
                                       "design), or give back the slot of one that broke off "
                                       "(ledger --void)",
                                       planned, completed, reserved));
}

enum class Holder {
    none,    // not reserved
    gone,    // its process has ended beyond doubt
    here,    // runs on this machine
    unknown, // on another machine, or named too poorly to tell
};

Holder holderOf(const SlotRecord& record) {
    if (record.state != SlotState::reserved)
        return Holder::none;
    if (record.owner) {
        if (isGone(*record.owner))
            return Holder::gone;
        const ProcessId self = ProcessId::current();
        return record.owner->machine == self.machine && record.owner->boot == self.boot
                   ? Holder::here
                   : Holder::unknown;
    }
    const bool free = record.machine == machineName() && !processRuns(record.process);
    return free ? Holder::gone : Holder::unknown;
}

bool isOurs(const SlotRecord& record) { return record.owner == ProcessId::current(); }

void checkCompletes(const SlotRecord& record) {
    if (!isOurs(record))
        throw Error(fmt::format("slot {} was given back while this session ran, and is that of "
                                "participant {} now; the rows of this session are kept",
                                record.slot, record.session.participant));
}

void checkGivenBack(const SlotRecord& record) {
    if (record.state == SlotState::returned)
        throw Error(fmt::format("slot {} is void already", record.slot));
    if (holderOf(record) == Holder::here && !isOurs(record))
        throw Error(fmt::format("slot {} is in use: process {} is running participant {}; end that "
                                "session first",
                                record.slot, record.process, record.session.participant));
}

void checkTakenBack(const SlotRecord& record, const SessionId& session) {
    const bool same = record.session.participant == session.participant &&
                      record.session.number == session.number;
    if (!same)
        throw Error(fmt::format("slot {} was given back, and is that of participant {} now; what "
                                "{} answered is kept",
                                record.slot, record.session.participant, session.participant));
    if (record.state == SlotState::completed)
        throw Error(fmt::format("slot {} was completed", record.slot));
    if (holderOf(record) == Holder::here)
        throw Error(fmt::format("slot {} is in use: process {} is running participant {}",
                                record.slot, record.process, record.session.participant));
    if (holderOf(record) == Holder::unknown)
        throw Error(doubtOf(record) + ". Go on there, or give the slot back first (ledger --void)");
}

} // namespace

std::vector<SlotRecord> Ledger::history() const { return readSlots(file_); }

std::vector<SlotRecord> Ledger::records() const { return lastOfEach(history()); }

int Ledger::claim(const SessionId& session, const std::string& design, int planned) {
    AppendFile file = AppendFile::openLocked(file_, isWholeSlotLine);
    const std::vector<SlotRecord> lines = history();
    checkFits(lines, session, design, {file_.string(), 0, 0, {}});
    const std::vector<SlotRecord> slots = lastOfEach(lines);
    checkPlan(slots, planned, {file_.string(), 0, 0, {}});
    const int slot = freeSlot(slots);
    file.append(slotLine({slot, SlotState::reserved, session, machineName(), utcNow(), processId(),
                          ProcessId::current(), design}));
    return slot;
}

void Ledger::takeBack(int slot, const SessionId& session, const std::string& design) {
    AppendFile file = AppendFile::openLocked(file_, isWholeSlotLine);
    const std::vector<SlotRecord> lines = history();
    const Place place{file_.string(), 0, 0, {}};
    checkFits(lines, session, design, place);
    const std::vector<SlotRecord> slots = lastOfEach(lines);
    const auto found = std::find_if(slots.begin(), slots.end(),
                                    [&](const SlotRecord& record) { return record.slot == slot; });
    if (found == slots.end())
        throw Error(place, fmt::format("slot {} was never claimed", slot));
    try {
        checkTakenBack(*found, session);
    } catch (const Error& error) {
        throw Error(place, error.what());
    }
    file.append(slotLine({slot, SlotState::reserved, session, machineName(), utcNow(), processId(),
                          ProcessId::current(), design}));
}

void Ledger::complete(int slot) { change(slot, SlotState::completed, checkCompletes); }

void Ledger::giveBack(int slot) { change(slot, SlotState::returned, checkGivenBack); }

void Ledger::restore(const std::vector<SlotRecord>& lost) {
    AppendFile file = AppendFile::openLocked(file_, isWholeSlotLine);
    std::string lines;
    for (const SlotRecord& record : lost)
        lines += slotLine(record);
    if (!lines.empty())
        file.append(lines);
}

void Ledger::change(int slot, SlotState state, void (*check)(const SlotRecord&)) {
    const Place place{file_.string(), 0, 0, {}};
    if (!std::filesystem::exists(file_))
        throw Error(place, fmt::format("slot {} was never claimed: there is no ledger", slot));
    AppendFile file = AppendFile::openLocked(file_, isWholeSlotLine);
    const std::vector<SlotRecord> slots = records();
    const auto found = std::find_if(slots.begin(), slots.end(),
                                    [&](const SlotRecord& record) { return record.slot == slot; });
    if (found == slots.end())
        throw Error(place, fmt::format("slot {} was never claimed; {}", slot,
                                       slots.empty()
                                           ? std::string("the ledger is empty")
                                           : fmt::format("slots 1 to {} were", slots.back().slot)));
    SlotRecord record = *found;
    try {
        check(record);
    } catch (const Error& error) {
        throw Error(place, error.what());
    }
    record.state = state;
    record.time = utcNow();
    file.append(slotLine(record));
}

bool isOrphan(const SlotRecord& record) { return holderOf(record) == Holder::gone; }

std::string doubtOf(const SlotRecord& record) {
    const std::string whose =
        fmt::format("slot {} is that of participant {}, session {}", record.slot,
                    record.session.participant, record.session.number);
    if (record.state == SlotState::completed)
        return whose + ", who has completed it: the rows stay, and another participant will be "
                       "given the same order";
    if (holderOf(record) == Holder::unknown)
        return fmt::format("{}, on {}: whether that session still runs cannot be seen from here",
                           whose, record.machine);
    return {};
}

SlotClaim::~SlotClaim() {
    if (completed_)
        return;
    try {
        // A person may have given it back, and another may have it.
        for (const SlotRecord& record : ledger_.records())
            if (record.slot == slot_ && record.state == SlotState::reserved && isOurs(record))
                ledger_.giveBack(slot_);
    } catch (const std::exception& error) { // a destructor must not throw; the slot stays reserved
        fmt::print(stderr, "slot {} could not be given back: {}\n", slot_, error.what());
    }
}

void SlotClaim::complete() {
    ledger_.complete(slot_);
    completed_ = true;
}

} // namespace obscura
