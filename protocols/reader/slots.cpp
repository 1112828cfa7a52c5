#include "protocols/reader/slots.h"

#include "base/error.h"
#include "base/files.h"

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

// Slots are given out one after the other, so each is first mentioned after all lower ones.
void checkSequence(int slot, int highest, const Place& place) {
    if (slot > highest + 1)
        throw Error(place,
                    fmt::format("expected slots up to {}, found {}: lines are missing before "
                                "this one; restore them before running a participant",
                                highest + 1, slot));
}

} // namespace

std::string_view nameOf(SlotState state) { return stateNames[static_cast<std::size_t>(state)]; }

std::string slotLine(const SlotRecord& record) {
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

// Whether a last line without line feed is complete. The beginning of a line is never JSON by
// itself; so where such a line is JSON, it was written whole, and an editor removed its line feed.
bool isWholeSlotLine(std::string_view text) { return json::accept(text); }

std::vector<SlotRecord> readSlots(const std::filesystem::path& file) {
    std::vector<SlotRecord> records;
    std::istringstream lines(std::filesystem::exists(file) ? readFile(file) : "");
    int number = 0, highest = 0;
    for (std::string text; std::getline(lines, text);) {
        ++number;
        if (lines.eof() && !isWholeSlotLine(text))
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

} // namespace obscura
