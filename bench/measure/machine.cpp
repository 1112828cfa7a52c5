#include "bench/measure/machine.h"

#include "base/files.h"
#include "base/version.h"
#include "matching/anchor.h"
#include "matching/match.h"
#include "renderer/reference/reference_cache.h"
#include "renderer/render.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>

namespace obscura {

namespace {

// The values of a key of /proc/cpuinfo, one per core; none where there is no such file.
std::vector<std::string> processorInfo(const std::string& key) {
    std::vector<std::string> values;
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (const auto colon = line.find(": "); line.starts_with(key) && colon != std::string::npos)
            values.push_back(line.substr(colon + 2));
    return values;
}

// What a command prints first; "" when it fails.
std::string firstLine(const char* command) {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command, "r"), pclose);
    char line[256] = "";
    if (!pipe || !std::fgets(line, sizeof line, pipe.get()))
        return "";
    const std::string text(line);
    return text.substr(0, text.find('\n'));
}

std::string clocksOf(const gl::Driver& driver) {
    if (!driver.software) {
        const std::string gpu = firstLine("nvidia-smi --query-gpu=clocks.sm,clocks.mem "
                                          "--format=csv,noheader 2>/dev/null");
        return gpu.empty() ? "" : "GPU and its memory: " + gpu;
    }
    const auto megahertz = processorInfo("cpu MHz");
    return megahertz.empty() ? "" : "processor: " + megahertz.front() + " MHz";
}

} // namespace

std::string programName() {
    const std::string code = sha256(
        fmt::format("{} {} {} {}", imageCode(), referenceCode(), matchingCode(), measuringCode()));
    return fmt::format("obscura {} ({}, code {:.12})", version(), commit(), code);
}

SweepMachine machineOf(const gl::Driver& driver, const gl::TimingChoice& timing,
                       const std::string& study) {
    SweepMachine machine;
    machine.vendor = driver.vendor;
    machine.renderer = driver.renderer;
    machine.glVersion = driver.version;
    machine.processor = processorName();
    machine.clocks = clocksOf(driver);
    machine.method = timing.reason;
    machine.program = programName();
    machine.study = study;
    machine.date = fmt::format("{:%Y-%m-%d %H:%M}", fmt::localtime(std::time(nullptr)));
    return machine;
}

} // namespace obscura
