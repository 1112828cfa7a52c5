#include "experiment/trigger.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>

namespace obscura {

namespace {

using Seconds = std::chrono::duration<double>;

// Names of phases are cut to what fits.
using Line = std::array<char, 512>;
constexpr int longestName = 300;

// In UTC. Unlike the system's function, this one needs no file of time zones.
void appendWall(char*& end, std::chrono::system_clock::time_point time) {
    using namespace std::chrono;
    const auto micros = floor<microseconds>(time);
    const auto day = floor<days>(micros);
    const year_month_day date(day);
    const hh_mm_ss clock(micros - day);
    end = fmt::format_to(end, "{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:06}Z",
                         static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                         static_cast<unsigned>(date.day()), clock.hours().count(),
                         clock.minutes().count(), clock.seconds().count(),
                         clock.subseconds().count());
}

std::string_view spell(const Mark& mark, Line& line) {
    const auto age =
        std::chrono::duration_cast<std::chrono::system_clock::duration>(Seconds(mark.age));
    char* end = fmt::format_to(line.data(), "{{\"onset\": {:.6f}, \"wall\": \"", mark.onset);
    appendWall(end, std::chrono::system_clock::now() - age);
    end = fmt::format_to(end, "\", \"trial\": {}, \"number\": {}, \"phase\": \"{:.{}}\"}}\n",
                         mark.trial, mark.phase, mark.name, longestName);
    *end = 0;
    return {line.data(), static_cast<std::size_t>(end - line.data())};
}

} // namespace

void Trigger::send(const Mark& mark) {
    const auto start = std::chrono::steady_clock::now();
    Line line;
    if (!deliver(spell(mark, line), mark)) {
        ++counts_.dropped;
        return;
    }
    const double delay = mark.age + Seconds(std::chrono::steady_clock::now() - start).count();
    ++counts_.sent;
    ++counts_.delays;
    counts_.delay += delay;
    counts_.longest = std::max(counts_.longest, delay);
}

void Trigger::lost() {
    if (counts_.sent == 0)
        return; // it was of the session before
    --counts_.sent;
    ++counts_.dropped;
}

nlohmann::ordered_json Trigger::counts() const {
    nlohmann::ordered_json json = {{"sent", counts_.sent},
                                   {"dropped", counts_.dropped},
                                   {"delay_mean_ms", nullptr},
                                   {"delay_max_ms", nullptr}};
    if (counts_.delays > 0) {
        json["delay_mean_ms"] = 1000 * counts_.delay / counts_.delays;
        json["delay_max_ms"] = 1000 * counts_.longest;
    }
    return json;
}

} // namespace obscura
