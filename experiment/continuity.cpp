#include "experiment/continuity.h"

#include "base/error.h"
#include "base/files.h"
#include "protocols/reader/design.h"
#include "protocols/reader/responses.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace obscura {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

std::string firstLine(const fs::path& path) {
    const std::string text = readFile(path);
    return text.substr(0, text.find('\n'));
}

SlotState stateAfter(const std::string& reason) {
    if (reason == "completed")
        return SlotState::completed;
    return reason.starts_with("running") ? SlotState::reserved : SlotState::returned;
}

// A sidecar says all that a record needs; a journal's first line says who it was and with which
// slot. A damaged file says nothing.
void addFromJson(const std::string& text, SlotRecord& trace) {
    const json object = json::parse(text, nullptr, false);
    if (!object.is_object())
        return;
    try {
        SlotRecord record;
        record.slot = object.at("slot");
        record.session = {object.at("participant"), object.at("session"), object.at("simulated")};
        record.state = stateAfter(object.value("end_reason", "running"));
        record.machine = object.value("machine", "unknown");
        record.time = object.value("started", object.value("time", "unknown"));
        record.design = object.value("design_sha256", "");
        trace = record;
    } catch (const json::exception&) {
    }
}

void addFromRows(const fs::path& path, SlotRecord& trace) {
    try {
        const auto rows = readResponses(path, true).rows;
        if (rows.empty())
            return;
        const Response& row = rows.front();
        trace.slot = row.slotId;
        trace.session = {row.participantId, std::stoi(row.sessionId), row.simulated};
        trace.machine = row.machineId;
        trace.time = row.wallTimeUtc;
        trace.design = row.designSha256;
    } catch (const std::exception&) { // not rows of ours; the analysis will tell
    }
}

constexpr std::string_view sidecarEnd = "_session.json", journalEnd = "_journal.jsonl",
                           rowsEnd = "_data.csv";

void addFromFile(const fs::path& path, std::string_view end, SlotRecord& trace) {
    if (trace.slot > 0)
        return; // another file has told
    if (end == rowsEnd)
        addFromRows(path, trace);
    else
        addFromJson(end == sidecarEnd ? readFile(path) : firstLine(path), trace);
}

// By the stem that a session's files share. Of each session the file that knows most.
std::vector<SlotRecord> tracesIn(const DataFolder& folder) {
    std::map<std::string, SlotRecord> traces;
    for (const std::string_view end : {sidecarEnd, journalEnd, rowsEnd}) {
        const fs::path inner = folder.path() / (end == rowsEnd ? "data" : "sessions");
        if (!fs::exists(inner))
            continue;
        for (const fs::directory_entry& entry : fs::directory_iterator(inner)) {
            const std::string name = entry.path().filename().string();
            if (name.ends_with(end) && !name.starts_with('.') && entry.is_regular_file())
                addFromFile(entry.path(), end, traces[name.substr(0, name.size() - end.size())]);
        }
    }
    std::vector<SlotRecord> result;
    for (const auto& [stem, trace] : traces)
        if (trace.slot >= 1 && trace.slot <= highestSlot)
            result.push_back(trace);
    return result;
}

bool knows(const std::vector<SlotRecord>& history, const SlotRecord& session) {
    return std::any_of(history.begin(), history.end(), [&](const SlotRecord& record) {
        return record.slot == session.slot &&
               record.session.participant == session.session.participant &&
               record.session.number == session.session.number;
    });
}

// The first few of what there is.
std::string listOf(std::vector<std::string> items, std::string_view separator) {
    constexpr std::size_t most = 8;
    const std::size_t more = items.size() > most ? items.size() - most : 0;
    items.resize(items.size() - more);
    if (more > 0)
        items.push_back(fmt::format("{} more", more));
    return fmt::format("{}", fmt::join(items, separator));
}

std::string listOf(const std::vector<SlotRecord>& records) {
    std::vector<std::string> items;
    for (const SlotRecord& record : records)
        if (!record.session.participant.empty())
            items.push_back(fmt::format("slot {} ({}, session {})", record.slot,
                                        record.session.participant, record.session.number));
    return listOf(std::move(items), ", ");
}

void checkLedgerIsWhole(const DataFolder& folder) {
    if (const auto lost = lostFromLedger(folder); !lost.empty())
        throw Error({folder.ledger().string(), 0, 0, {}},
                    fmt::format("{}; it should have {}. Put back a copy of it, or have it mended "
                                "from the sessions: obscura-experiment ledger --restore",
                                fs::exists(folder.ledger())
                                    ? "the ledger does not know all sessions that lie beside it"
                                    : "the ledger is lost, yet sessions lie where it was",
                                listOf(lost)));
}

// What has changed since the design that was kept, if it is the one with that hash.
std::string changes(const DataFolder& folder, const std::string& hash, const std::string& design) {
    const json kept = fs::exists(folder.design())
                          ? json::parse(readFile(folder.design()), nullptr, false)
                          : json();
    if (!kept.is_object() || !kept.contains("design") || sha256(kept["design"].dump()) != hash)
        return fmt::format("its hash was {:.12}..., is now {:.12}...", hash, sha256(design));
    return listOf(differences(kept["design"].dump(), design), "; ");
}

} // namespace

std::string checkContinues(const DataFolder& folder, const Study& study) {
    const std::vector<SlotRecord> history = Ledger(folder.ledger()).history();
    checkLedgerIsWhole(folder);
    std::vector<SlotRecord> sessions = history;
    for (const SlotRecord& trace : tracesIn(folder))
        sessions.push_back(trace);
    const std::string design = study.design(), hash = sha256(design);
    const auto other =
        std::find_if(sessions.begin(), sessions.end(), [&](const SlotRecord& record) {
            return !record.design.empty() && record.design != hash;
        });
    if (other != sessions.end())
        throw Error(
            {study.protocol.path.string(), 0, 0, {}},
            fmt::format("the study's design has changed since {} took part: {}. Data of two "
                        "designs are no study: undo the change, or give the new design "
                        "another data folder (--data DIR) or another name. Texts may change",
                        other->session.participant, changes(folder, other->design, design)));
    const auto unknown = std::count_if(sessions.begin(), sessions.end(),
                                       [](const auto& record) { return record.design.empty(); });
    return unknown == 0 ? std::string()
                        : fmt::format("{}: sessions of an earlier version, which kept no design: "
                                      "whether it has changed since then cannot be checked",
                                      folder.path().string());
}

void keepDesign(const DataFolder& folder, const Study& study) {
    const json design = json::parse(study.design());
    const std::string content = json{{"format_version", 1}, {"design", design}}.dump(2) + "\n";
    if (!fs::exists(folder.design()) || readFile(folder.design()) != content)
        writeFile(folder.design(), content);
}

std::vector<SlotRecord> lostFromLedger(const DataFolder& folder) {
    // The files are read before the ledger, because another presenter writes the ledger first.
    const std::vector<SlotRecord> traces = tracesIn(folder);
    const std::vector<SlotRecord> history = Ledger(folder.ledger()).history();
    std::vector<SlotRecord> lost;
    for (const SlotRecord& trace : traces)
        if (!knows(history, trace))
            lost.push_back(trace);
    // Where two sessions had the same slot, the first must have given it back.
    std::stable_sort(lost.begin(), lost.end(), [](const SlotRecord& x, const SlotRecord& y) {
        return std::pair(x.slot, x.state != SlotState::returned) <
               std::pair(y.slot, y.state != SlotState::returned);
    });
    int highest = 0;
    for (const SlotRecord& record : history)
        highest = std::max(highest, record.slot);
    std::vector<SlotRecord> filled;
    for (const SlotRecord& record : lost) {
        while (++highest < record.slot) { // claimed by somebody who left no file
            SlotRecord gap = record;
            gap.slot = highest;
            gap.state = SlotState::returned;
            gap.session.participant.clear();
            filled.push_back(gap);
        }
        highest = std::max(highest - 1, record.slot);
        filled.push_back(record);
    }
    return filled;
}

} // namespace obscura
