#pragma once

#include "bench/sweep/row.h"
#include "renderer/techniques/technique.h"

#include <type_traits>

namespace obscura {

// Every field of a sweep with its name, once for CSV, JSON and what joins sweeps. Row may be const.

template <typename Fields, typename Visit>
void eachErrorField(const std::string& prefix, Fields& errors, Visit& visit) {
    visit(prefix + "_rmse", errors.rmse);
    visit(prefix + "_bias", errors.bias);
    visit(prefix + "_ssim", errors.ssim);
    visit(prefix + "_flip", errors.flip);
}

template <typename Row, typename Visit>
void eachError(Row& row, Visit& visit) {
    eachErrorField("full_raw", row.raw, visit);
    eachErrorField("full_matched", row.matched, visit);
    eachErrorField("depth_raw", row.depthRaw, visit);
    eachErrorField("depth_matched", row.depthMatched, visit);
    eachErrorField("lit_raw", row.litRaw, visit);
    visit("lit_raw_jod", row.litRaw.jod);
    eachErrorField("lit_matched", row.litMatched, visit);
    visit("lit_matched_jod", row.litMatched.jod);
}

template <typename Row, typename Visit>
void eachTime(Row& row, Visit& visit) {
    visit("frames", row.frames);
    visit("total_median_ms", row.total.median);
    visit("total_5th_percentile_ms", row.total.low);
    visit("total_95th_percentile_ms", row.total.high);
    for (std::size_t i = 0; i < row.work.size(); ++i)
        visit(workNames()[i] + "_median_ms", row.work[i]);
    visit("gbuffer_median_ms", row.gbuffer);
    visit("ratio_to_gbuffer", row.toGbuffer);
    visit("ratio_to_starcraft_16", row.toStarcraft);
    visit("starcraft_16_odd_to_even", row.starcraftRepeat);
}

template <typename Row, typename Visit>
requires std::is_same_v<std::remove_const_t<Row>, SweepRow>
void eachField(Row& row, Visit visit) {
    visit("configuration", row.configuration);
    visit("technique", row.technique);
    visit("name", row.name);
    visit("settings", row.settings);
    visit("fitted", row.fitted);
    visit("scene", row.scene);
    visit("view", row.view);
    visit("radius", row.radius);
    visit("width", row.width);
    visit("height", row.height);
    eachTime(row, visit);
    visit("bytes_per_pixel", row.bytes);
    visit("fetches_per_pixel", row.fetches);
    eachError(row, visit);
    visit("thumbnail", row.thumbnail);
}

template <typename Row, typename Visit>
requires std::is_same_v<std::remove_const_t<Row>, GrowthRow>
void eachField(Row& row, Visit visit) {
    visit("configuration", row.configuration);
    visit("axis", row.axis);
    visit("value", row.value);
    visit("milliseconds", row.milliseconds);
}

template <typename Machine, typename Visit>
requires std::is_base_of_v<TimedOn, std::remove_const_t<Machine>>
void eachField(Machine& machine, Visit visit) {
    visit("vendor", machine.vendor);
    visit("renderer", machine.renderer);
    visit("glVersion", machine.glVersion);
    visit("processor", machine.processor);
    visit("method", machine.method);
    visit("clocks", machine.clocks);
    visit("date", machine.date);
    if constexpr (std::is_same_v<std::remove_const_t<Machine>, SweepMachine>) {
        visit("program", machine.program);
        visit("study", machine.study);
        visit("display", machine.display);
        visit("errorsBy", machine.errorsBy);
        visit("notes", machine.notes);
    }
}

} // namespace obscura
