#include "experiment/ledger.h"

#include "base/error.h"
#include "base/files.h"
#include "experiment/append_file.h"
#include "experiment/machine.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <sstream>

namespace obscura {

namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 3> stateNames = {"reserved", "completed", "void"};
constexpr int formatVersion = 2; // 1 had no owner, no design and no version

std::string line(const SlotRecord& record) {
    nlohmann::ordered_json entry = {
        {"format_version", formatVersion},
        {"slot", record.slot},
        {"state", nameOf(record.state)},
        {"participant", record.session.participant},
        {"session", record.session.number},
        {"simulated", record.session.simulated},
        {"machine", record.machine},
        {"process", record.process},
        {"time", record.time},
    };
    if (record.owner)
        entry["owner"] = record.owner->text();
    if (!record.design.empty())
        entry["design_sha256"] = record.design;
    return entry.dump() + "\n";
}

int wholeNumber(const json& object, const char* key, int low, int high) {
    const json& value = object.at(key);
    if (!value.is_number_integer() || value < low || value > high)
        throw Error(fmt::format("\"{}\": expected a whole number from {} to {}, found {}", key, low,
                                high, value.dump()));
    return value;
}

SlotState stateOf(const std::string& name) {
    const auto found = std::find(stateNames.begin(), stateNames.end(), name);
    if (found == stateNames.end())
        throw Error(fmt::format("\"state\": expected one of {}, found \"{}\"",
                                fmt::join(stateNames, ", "), name));
    return static_cast<SlotState>(found - stateNames.begin());
}

SlotRecord parse(const std::string& text) {
    constexpr int large = 2147483647;
    const json object = json::parse(text);
    if (object.contains("format_version"))
        wholeNumber(object, "format_version", 1, formatVersion);
    SlotRecord record;
    record.slot = wholeNumber(object, "slot", 1, highestSlot);
    record.state = stateOf(object.at("state"));
    record.session = {object.at("participant"), wholeNumber(object, "session", 1, large),
                      object.at("simulated")};
    record.machine = object.at("machine");
    record.process = wholeNumber(object, "process", 0, large);
    record.time = object.at("time");
    if (object.contains("owner"))
        record.owner = ProcessId::parse(object["owner"].get<std::string>());
    record.design = object.value("design_sha256", "");
    return record;
}

// Whether a last line without line feed is complete. The beginning of a line is never JSON by
// itself; so where such a line is JSON, it was written whole, and an editor removed its line feed.
bool isWhole(std::string_view text) { return json::accept(text); }

// Slots are given out one after the other, so each is first mentioned after all lower ones.
void checkSequence(int slot, int highest, const Place& place) {
    if (slot > highest + 1)
        throw Error(place,
                    fmt::format("expected slots up to {}, found {}: lines are missing before "
                                "this one; restore them before running a participant",
                                highest + 1, slot));
}

std::vector<SlotRecord> read(const std::filesystem::path& file) {
    std::vector<SlotRecord> records;
    std::istringstream lines(std::filesystem::exists(file) ? readFile(file) : "");
    int number = 0, highest = 0;
    for (std::string text; std::getline(lines, text);) {
        ++number;
        if (lines.eof() && !isWhole(text))
            break; // a line being written, or torn
        try {
            records.push_back(parse(text));
        } catch (const std::exception& error) {
            throw Error({file.string(), number, 0, {}},
                        fmt::format("expected a slot's state as this program writes it ({}); "
                                    "restore the line before running a participant",
                                    error.what()));
        }
        checkSequence(records.back().slot, highest, {file.string(), number, 0, {}});
        highest = std::max(highest, records.back().slot);
    }
    return records;
}

std::vector<SlotRecord> lastOfEach(const std::vector<SlotRecord>& history) {
    std::map<int, SlotRecord> slots;
    for (const SlotRecord& record : history)
        slots[record.slot] = record;
    std::vector<SlotRecord> records;
    records.reserve(slots.size());
    for (const auto& [slot, record] : slots)
        records.push_back(record);
    return records;
}

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

std::string_view nameOf(SlotState state) { return stateNames[static_cast<std::size_t>(state)]; }

std::vector<SlotRecord> Ledger::history() const { return read(file_); }

std::vector<SlotRecord> Ledger::records() const { return lastOfEach(history()); }

int Ledger::claim(const SessionId& session, const std::string& design, int planned) {
    AppendFile file = AppendFile::openLocked(file_, isWhole);
    const std::vector<SlotRecord> lines = history();
    checkFits(lines, session, design, {file_.string(), 0, 0, {}});
    const std::vector<SlotRecord> slots = lastOfEach(lines);
    checkPlan(slots, planned, {file_.string(), 0, 0, {}});
    const int slot = freeSlot(slots);
    file.append(line({slot, SlotState::reserved, session, machineName(), utcNow(), processId(),
                      ProcessId::current(), design}));
    return slot;
}

void Ledger::takeBack(int slot, const SessionId& session, const std::string& design) {
    AppendFile file = AppendFile::openLocked(file_, isWhole);
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
    file.append(line({slot, SlotState::reserved, session, machineName(), utcNow(), processId(),
                      ProcessId::current(), design}));
}

void Ledger::complete(int slot) { change(slot, SlotState::completed, checkCompletes); }

void Ledger::giveBack(int slot) { change(slot, SlotState::returned, checkGivenBack); }

void Ledger::restore(const std::vector<SlotRecord>& lost) {
    AppendFile file = AppendFile::openLocked(file_, isWhole);
    std::string lines;
    for (const SlotRecord& record : lost)
        lines += line(record);
    if (!lines.empty())
        file.append(lines);
}

void Ledger::change(int slot, SlotState state, void (*check)(const SlotRecord&)) {
    const Place place{file_.string(), 0, 0, {}};
    if (!std::filesystem::exists(file_))
        throw Error(place, fmt::format("slot {} was never claimed: there is no ledger", slot));
    AppendFile file = AppendFile::openLocked(file_, isWhole);
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
    file.append(line(record));
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
