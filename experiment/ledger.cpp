#include "experiment/ledger.h"

#include "experiment/append_file.h"
#include "experiment/machine.h"
#include "protocols/error.h"
#include "protocols/files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <sstream>

namespace obscura {

namespace {

constexpr std::array<std::string_view, 3> stateNames = {"reserved", "completed", "void"};

std::string line(const SlotRecord& record) {
    const nlohmann::ordered_json json = {
        {"slot", record.slot},
        {"state", nameOf(record.state)},
        {"participant", record.session.participant},
        {"session", record.session.number},
        {"simulated", record.session.simulated},
        {"machine", record.machine},
        {"process", record.process},
        {"time", record.time},
    };
    return json.dump() + "\n";
}

SlotRecord parse(const std::string& text) {
    const nlohmann::json json = nlohmann::json::parse(text);
    SlotRecord record;
    record.slot = json.at("slot");
    const auto name =
        std::find(stateNames.begin(), stateNames.end(), json.at("state").get<std::string>());
    record.state = static_cast<SlotState>(name - stateNames.begin());
    record.session = {json.at("participant"), json.at("session"), json.at("simulated")};
    record.machine = json.at("machine");
    record.process = json.at("process");
    record.time = json.at("time");
    if (record.slot < 1 || name == stateNames.end())
        throw std::out_of_range("no such slot or state");
    return record;
}

std::vector<SlotRecord> read(const std::filesystem::path& file) {
    std::map<int, SlotRecord> slots;
    std::istringstream lines(std::filesystem::exists(file) ? readFile(file) : "");
    int number = 0;
    for (std::string text;
         std::getline(lines, text) && !lines.eof();) { // eof: a line being written
        ++number;
        try {
            const SlotRecord record = parse(text);
            slots[record.slot] = record;
        } catch (const std::exception& error) {
            throw Error({file.string(), number, 0, {}},
                        fmt::format("expected a slot's state as this program writes it ({}); "
                                    "restore the line before running a participant",
                                    error.what()));
        }
    }
    std::vector<SlotRecord> records;
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

} // namespace

std::string_view nameOf(SlotState state) { return stateNames[static_cast<std::size_t>(state)]; }

std::vector<SlotRecord> Ledger::records() const { return read(file_); }

int Ledger::claim(const SessionId& session) {
    AppendFile file = AppendFile::openLocked(file_);
    const std::vector<SlotRecord> records = read(file_);
    if (!records.empty() && records.front().session.simulated != session.simulated)
        throw Error({file_.string(), 0, 0, {}},
                    fmt::format("this folder holds {} participants; {} ones need a data folder of "
                                "their own: --data DIR",
                                session.simulated ? "real" : "simulated",
                                session.simulated ? "simulated" : "real"));
    const int slot = freeSlot(records);
    file.append(line({slot, SlotState::reserved, session, machineName(), utcNow(), processId()}));
    return slot;
}

void Ledger::complete(int slot) { change(slot, SlotState::completed); }

void Ledger::giveBack(int slot) { change(slot, SlotState::returned); }

void Ledger::change(int slot, SlotState state) {
    AppendFile file = AppendFile::openLocked(file_);
    const std::vector<SlotRecord> records = read(file_);
    const auto found = std::find_if(records.begin(), records.end(),
                                    [&](const SlotRecord& record) { return record.slot == slot; });
    if (found == records.end())
        throw Error({file_.string(), 0, 0, {}}, fmt::format("slot {} was never claimed", slot));
    SlotRecord record = *found;
    if (record.state == SlotState::reserved && record.process != processId() &&
        record.machine == machineName() && !isOrphan(record))
        throw Error({file_.string(), 0, 0, {}},
                    fmt::format("slot {} is in use: process {} is running participant {}; end that "
                                "session first",
                                slot, record.process, record.session.participant));
    record.state = state;
    record.time = utcNow();
    file.append(line(record));
}

bool isOrphan(const SlotRecord& record) {
    return record.state == SlotState::reserved && record.machine == machineName() &&
           !processRuns(record.process);
}

Claim::~Claim() {
    if (completed_)
        return;
    try {
        ledger_.giveBack(slot_);
    } catch (const std::exception& error) { // a destructor must not throw; the slot stays reserved
        fmt::print(stderr, "slot {} could not be given back: {}\n", slot_, error.what());
    }
}

void Claim::complete() {
    ledger_.complete(slot_);
    completed_ = true;
}

} // namespace obscura
