#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace obscura {

// Names one process for good, which its number alone does not: numbers are used again, and folders
// are shared between machines.
struct ProcessId {
    std::string machine; // host name, and a digest that tells apart hosts and containers of the
                         // same name; letters, digits and "-"
    std::string boot;    // of this start of the machine, 32 hexadecimal digits; "" if unknown
    long pid = 0;
    long long start = -1; // when the process began, clock ticks since the boot; -1 if unknown

    static ProcessId current();

    // "PID.START.BOOT.MACHINE", fit to be part of a file name, and back; nothing when the text is
    // no such name.
    std::string text() const;
    static std::optional<ProcessId> parse(std::string_view text);

    bool operator==(const ProcessId&) const = default;
};

// Whether the process has ended beyond doubt: it ran on this machine, and either before the last
// boot or under a number that is free, or another's, today. In doubt it has not.
bool isGone(const ProcessId& process);

} // namespace obscura
