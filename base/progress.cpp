#include "base/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace obscura {

Progress::Progress(std::string label, double total)
    : label_(std::move(label)), total_(std::max(total, 1e-9)), terminal_(::isatty(STDERR_FILENO)) {}

Progress::~Progress() { print(done_, {}, true); }

void Progress::update(double done, const std::string& note) {
    done_ = std::min(done, total_);
    if (!found_)
        found_ = done_;
    const auto interval = terminal_ ? std::chrono::milliseconds(100) : std::chrono::seconds(5);
    if (done_ < total_ && Clock::now() - printed_ >= interval)
        print(done_, note, false);
}

void Progress::print(double done, const std::string& note, bool last) {
    printed_ = Clock::now();
    const double elapsed = std::chrono::duration<double>(printed_ - start_).count();
    const double share = done / total_;
    std::string time = fmt::format("{} so far", durationText(elapsed));
    if (last)
        time = fmt::format("in {}", durationText(elapsed));
    else if (const double own = share - found_.value_or(0) / total_;
             own >= 0.01) // earlier, rates are of starting up
        time = fmt::format("{} left", durationText(elapsed * (1 - share) / own));

    constexpr int width = 24;
    const int filled = static_cast<int>(share * width);
    const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                            std::string(static_cast<std::size_t>(width - filled), '.');
    fmt::print(stderr, "{}{:<22} [{}] {:3.0f} %  {}  {}{}", terminal_ ? "\r\x1b[K" : "", label_,
               bar, share * 100, time, note, terminal_ && !last ? "" : "\n");
    std::fflush(stderr);
}

std::string durationText(double seconds) {
    const auto whole = static_cast<long>(seconds + 0.5);
    if (whole < 100)
        return fmt::format("{} s", whole);
    return whole < 2 * 3600 ? fmt::format("{} min {:02} s", whole / 60, whole % 60)
                            : fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

double peakMemory() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmHWM:"))
            return std::strtod(line.c_str() + 6, nullptr) / 1024;
    return 0;
}

} // namespace obscura
