#include "base/process.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <climits>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>

namespace obscura {

namespace {

std::string textOf(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string hostName() {
    std::array<char, HOST_NAME_MAX + 1> name{};
    ::gethostname(name.data(), name.size() - 1);
    std::string result = name.data();
    std::replace_if(
        result.begin(), result.end(),
        [](unsigned char c) { return c > 127 || !(std::isalnum(c) || c == '-'); }, '-');
    return result;
}

// Process numbers mean something within one namespace: containers of one machine count apart.
std::string processNamespace() {
    std::array<char, 64> name{};
    const ssize_t length = ::readlink("/proc/self/ns/pid", name.data(), name.size());
    return {name.data(), length > 0 ? static_cast<std::size_t>(length) : 0};
}

// FNV-1a, for /etc/machine-id is not to be published as it is (machine-id(5)).
std::uint64_t digest(std::string_view text) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const unsigned char byte : text)
        hash = (hash ^ byte) * 0x100000001b3u;
    return hash;
}

std::string machineName() {
    return fmt::format("{}-{:016x}", hostName(),
                       digest(textOf("/etc/machine-id") + processNamespace()));
}

std::string bootName() {
    std::string id = textOf("/proc/sys/kernel/random/boot_id");
    std::erase_if(id, [](unsigned char c) { return !std::isxdigit(c); });
    return id;
}

struct Running {
    char state = 0;
    long long start = -1;
};

// Fields 3 and 22 of /proc/PID/stat (proc(5)). Field 2 is the program's name, which may hold blanks
// and brackets.
Running running(long pid) {
    const std::string text = textOf(fmt::format("/proc/{}/stat", pid));
    const std::size_t name = text.rfind(") ");
    if (name == std::string::npos)
        return {};
    Running result{text[name + 2], -1};
    std::size_t at = name + 2;
    for (int field = 3; field < 22; ++field)
        if (at = text.find(' ', at); at++ == std::string::npos)
            return {};
    std::from_chars(text.data() + at, text.data() + text.size(), result.start);
    return result;
}

// The text up to the next dot, which goes with it.
std::string_view cutPart(std::string_view& text) {
    const std::size_t dot = std::min(text.find('.'), text.size());
    const std::string_view part = text.substr(0, dot);
    text.remove_prefix(std::min(dot + 1, text.size()));
    return part;
}

template <typename T>
bool readPart(std::string_view text, T& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
}

} // namespace

ProcessId ProcessId::current() {
    const long pid = ::getpid();
    return {machineName(), bootName(), pid, running(pid).start};
}

std::string ProcessId::text() const {
    return fmt::format("{}.{}.{}.{}", pid, start, boot, machine);
}

std::optional<ProcessId> ProcessId::parse(std::string_view text) {
    ProcessId result;
    if (!readPart(cutPart(text), result.pid) || !readPart(cutPart(text), result.start))
        return {};
    result.boot = cutPart(text);
    result.machine = text;
    const auto fits = [](const std::string& part, auto&& allowed) {
        return std::all_of(part.begin(), part.end(),
                           [&](unsigned char c) { return c < 128 && allowed(c); });
    };
    const bool well = result.pid > 0 && (result.boot.empty() || result.boot.size() == 32) &&
                      !result.machine.empty() &&
                      fits(result.boot, [](int c) { return std::isxdigit(c); }) &&
                      fits(result.machine, [](int c) { return std::isalnum(c) || c == '-'; });
    return well ? std::optional(result) : std::nullopt;
}

bool isGone(const ProcessId& process) {
    const ProcessId self = ProcessId::current();
    if (process.machine != self.machine || process.boot.empty() || self.boot.empty())
        return false;
    if (process.boot != self.boot)
        return true;
    // The system tells of processes that /proc hides from us, too.
    if (::kill(static_cast<pid_t>(process.pid), 0) != 0 && errno == ESRCH)
        return true;
    const Running now = running(process.pid);
    if (now.start < 0 || process.start < 0)
        return false;
    return now.start != process.start || now.state == 'Z' || now.state == 'X';
}

} // namespace obscura
