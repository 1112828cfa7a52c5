#include "bench/measure/timing_turn.h"

#include "base/error.h"
#include "base/files.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <thread>

namespace obscura {

// A socket in Linux's abstract namespace (unix(7)), to which nobody ever connects: its name is one
// process's at a time, and the kernel frees it.
TimingTurn::TimingTurn(const std::filesystem::path& folder, const std::function<void()>& waiting)
    : socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string name =
        fmt::format("obscura-timing-{}",
                    sha256(std::filesystem::weakly_canonical(folder).string()).substr(0, 32));
    std::memcpy(address.sun_path + 1, name.data(), name.size()); // after a zero: abstract
    const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
    while (::bind(socket_, reinterpret_cast<const sockaddr*>(&address), length) != 0) {
        if (socket_ < 0 || errno != EADDRINUSE) {
            const std::string why = std::strerror(errno);
            ::close(socket_);
            throw Error(
                fmt::format("expected a name for this process's turn to time, found: {}", why));
        }
        waiting();
        std::this_thread::sleep_for(std::chrono::milliseconds(500));
    }
}

TimingTurn::~TimingTurn() { ::close(socket_); }

} // namespace obscura
