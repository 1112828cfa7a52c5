#include "experiment/sidecar.h"

#include "base/files.h"
#include "base/version.h"
#include "experiment/machine.h"
#include "protocols/reader/design.h"

#include <nlohmann/json.hpp>

namespace obscura {

using nlohmann::ordered_json;

namespace {

// Of all trials that have a row; empty where answers decide it.
ordered_json orderOf(const Context& context) {
    ordered_json order = ordered_json::array();
    for (const PlannedTrial& trial : planned(context.study.protocol, context.assignment.slot))
        if (trial.kind != PlannedTrial::Kind::rest)
            order.push_back(context.study.condition(trial.condition).condition);
    return order;
}

ordered_json spell(const IntervalSummary& summary) {
    return {{"count", summary.count},
            {"mean_ms", 1000 * summary.mean},
            {"deviation_ms", 1000 * summary.deviation},
            {"least_ms", 1000 * summary.least},
            {"most_ms", 1000 * summary.most},
            {"histogram_tenths_of_a_refresh", summary.histogram}};
}

} // namespace

ordered_json circumstances(const Context& context, const Observer& observer) {
    const Protocol& protocol = context.study.protocol;
    ordered_json sidecar = {
        {"format_version", 2}, // 1 had no version, rehearsal, design and texts
        {"study", protocol.name},
        {"protocol", protocol.path.string()},
        {"protocol_sha256", protocol.sha256},
        {"design_sha256", context.designSha256},
        {"texts_sha256", sha256(partsOf(protocol).texts)},
        {"stimuli", context.study.manifest.folder.string()},
        {"participant", context.session.participant},
        {"session", context.session.number},
        {"simulated", context.session.simulated},
        {"rehearsal", context.session.rehearsal},
        {"language", nullptr}, // in which participants read; null where the protocol says none
        {"slot", context.assignment.slot},
        {"square", context.assignment.square},
        {"square_row", context.assignment.row},
        {"pairs_reversed", context.assignment.exchange != 0},
        {"order", orderOf(context)},
        {"protocol_seed", protocol.seed},
        {"grey", protocol.trial.grey},
        {"mask_s", protocol.trial.mask},
        {"refresh_hz", context.refresh.hz},
        {"timestamp_source", context.refresh.source},
        {"timing_doubt", context.refresh.doubt},
        {"app_version", version()},
        {"git_commit", commit()},
        {"machine", machineName()},
        {"system", systemName()},
        {"started", utcNow()},
        {"ended", nullptr},
        {"end_reason", "running, or crashed"},
    };
    if (const std::string& language = context.study.texts().language; !language.empty())
        sidecar["language"] = language;
    observer.describe(sidecar);
    return sidecar;
}

ordered_json continued(const std::filesystem::path& file, const ordered_json& now,
                       const BrokenSession& broken) {
    // Killed before it was written, or damaged since then: the journal has what matters.
    ordered_json sidecar = std::filesystem::exists(file)
                               ? ordered_json::parse(readFile(file), nullptr, false)
                               : ordered_json();
    if (!sidecar.is_object())
        sidecar = now;
    ordered_json part = {{"trials_before", broken.trials}, {"half_seen", broken.halfSeen}};
    part.update(now);
    for (const char* key : {"ended", "end_reason"})
        part.erase(key);
    sidecar["resumed"].push_back(part);
    sidecar["ended"] = nullptr;
    sidecar["end_reason"] = now.at("end_reason");
    return sidecar;
}

void addOutcome(ordered_json& sidecar, const std::string& reason,
                const std::vector<double>& maskIntervals, double refreshHz,
                const Observer& observer) {
    sidecar["ended"] = utcNow();
    sidecar["end_reason"] = reason;
    ordered_json& part = sidecar.contains("resumed") ? sidecar["resumed"].back() : sidecar;
    part["mask_intervals"] = spell(summarise(maskIntervals, refreshHz));
    observer.describeOutcome(part);
}

} // namespace obscura
