#include "experiment/trigger_receivers.h"

#include "base/error.h"
#include "experiment/signals.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <utility>

namespace obscura {

namespace {

constexpr int patience = 5000;   // milliseconds until a receiver must have answered
constexpr int udpPatience = 300; // and one that may be silent must have been found missing

// A file descriptor of ours.
class Descriptor {
  public:
    explicit Descriptor(int number) : number_(number) {}
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&&) = delete;
    ~Descriptor() {
        if (number_ >= 0)
            ::close(number_);
    }
    int number() const { return number_; }

  private:
    int number_;
};

// Until something has happened there, or for so long. A signal that ends the program is thrown.
bool happens(const Descriptor& descriptor, short events, int milliseconds) {
    constexpr int step = 100;
    pollfd waited{descriptor.number(), events, 0};
    for (int left = milliseconds; left > 0; left -= step) {
        throwIfEnded();
        if (::poll(&waited, 1, std::min(step, left)) > 0)
            return true;
    }
    return false;
}

int errorOf(const Descriptor& socket) {
    int error = 0;
    socklen_t size = sizeof error;
    ::getsockopt(socket.number(), SOL_SOCKET, SO_ERROR, &error, &size);
    return error;
}

// A connected socket that never waits; throws the system's reason.
Descriptor connected(const addrinfo& address) {
    Descriptor socket(::socket(address.ai_family,
                               address.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC,
                               address.ai_protocol));
    if (socket.number() < 0)
        throw Error(std::strerror(errno));
    if (::connect(socket.number(), address.ai_addr, address.ai_addrlen) != 0) {
        if (errno != EINPROGRESS)
            throw Error(std::strerror(errno));
        if (!happens(socket, POLLOUT, patience))
            throw Error(fmt::format("no answer for {} seconds", patience / 1000));
        if (const int error = errorOf(socket))
            throw Error(std::strerror(error));
    }
    return socket;
}

class Stream : public Trigger {
  public:
    explicit Stream(Descriptor socket) : socket_(std::move(socket)) {
        const int on = 1;
        ::setsockopt(socket_.number(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    }

  private:
    // A line of which only a part was taken must be finished before the next: the receiver gets
    // whole lines or none.
    bool deliver(std::string_view line, const Mark&) override {
        rest_ += write({unfinished_.data() + rest_, left_ - rest_});
        if (rest_ < left_)
            return false;
        rest_ = left_ = 0;
        const std::size_t taken = write(line);
        if (taken == 0)
            return false;
        left_ = line.copy(unfinished_.data(), unfinished_.size(), taken);
        return true;
    }
    std::size_t write(std::string_view text) {
        const ssize_t taken = text.empty() ? 0
                                           : ::send(socket_.number(), text.data(), text.size(),
                                                    MSG_DONTWAIT | MSG_NOSIGNAL);
        return static_cast<std::size_t>(std::max<ssize_t>(0, taken));
    }

    Descriptor socket_;
    std::array<char, 512> unfinished_{}; // from rest_ to left_ of it is still to be sent
    std::size_t rest_ = 0, left_ = 0;
};

// The system tells that nobody listened when the next is sent.
class Datagrams : public Trigger {
  public:
    // An empty one finds out whether somebody listens, where the receiver's system says so.
    explicit Datagrams(Descriptor socket) : socket_(std::move(socket)) {
        send({});
        if (happens(socket_, POLLERR, udpPatience) && errorOf(socket_) != 0)
            throw Error("nobody listens there");
    }

  private:
    bool deliver(std::string_view line, const Mark&) override {
        if (send(line))
            return true;
        if (errno != ECONNREFUSED)
            return false;
        lost();
        return send(line);
    }
    bool send(std::string_view text) {
        return ::send(socket_.number(), text.data(), text.size(), MSG_DONTWAIT | MSG_NOSIGNAL) >= 0;
    }

    Descriptor socket_;
};

class Serial : public Trigger {
  public:
    explicit Serial(Descriptor port) : port_(std::move(port)) {}
    ~Serial() override { ::tcflush(port_.number(), TCOFLUSH); } // or closing it may wait
    Serial(const Serial&) = delete;
    Serial& operator=(const Serial&) = delete;

  private:
    bool deliver(std::string_view, const Mark& mark) override {
        const auto byte = static_cast<unsigned char>(std::min(mark.phase, 255));
        return ::write(port_.number(), &byte, 1) == 1;
    }

    Descriptor port_;
};

// The functions of liblsl that it takes, as its header lsl_c.h declares them.
struct Liblsl {
    void* library = nullptr;
    void* (*createInfo)(const char* name, const char* type, std::int32_t channels, double rate,
                        int format, const char* source) = nullptr;
    void (*destroyInfo)(void* info) = nullptr;
    void* (*createOutlet)(void* info, std::int32_t chunk, std::int32_t buffered) = nullptr;
    void (*destroyOutlet)(void* outlet) = nullptr;
    std::int32_t (*waitForConsumers)(void* outlet, double seconds) = nullptr;
    std::int32_t (*haveConsumers)(void* outlet) = nullptr;
    double (*localClock)() = nullptr;
    std::int32_t (*push)(void* outlet, const char** sample, double time) = nullptr;

    Liblsl() {
        for (const char* name : {"liblsl.so", "liblsl.so.2", "liblsl.so.1", "liblsl64.so"})
            if (!library)
                library = ::dlopen(name, RTLD_NOW);
        if (!library)
            throw Error("liblsl.so was not found; install liblsl (github.com/sccn/liblsl), or say "
                        "where it is in LD_LIBRARY_PATH");
        find(createInfo, "lsl_create_streaminfo");
        find(destroyInfo, "lsl_destroy_streaminfo");
        find(createOutlet, "lsl_create_outlet");
        find(destroyOutlet, "lsl_destroy_outlet");
        find(waitForConsumers, "lsl_wait_for_consumers");
        find(haveConsumers, "lsl_have_consumers");
        find(localClock, "lsl_local_clock");
        find(push, "lsl_push_sample_strtp");
    }
    template <typename Function>
    void find(Function& function, const char* name) {
        function = reinterpret_cast<Function>(::dlsym(library, name));
        if (!function)
            throw Error(fmt::format("the liblsl that was found has no {}", name));
    }
};

class Lsl : public Trigger {
  public:
    Lsl() {
        constexpr int text = 3;                // cft_string
        constexpr double irregular = 0;        // rate
        constexpr int chunk = 0, buffer = 360; // as each comes; seconds, liblsl's default
        void* info = lsl_.createInfo("Obscura", "Markers", 1, irregular, text, "obscura");
        outlet_ = info ? lsl_.createOutlet(info, chunk, buffer) : nullptr;
        if (info)
            lsl_.destroyInfo(info);
        if (!outlet_)
            throw Error("liblsl made no outlet");
    }
    ~Lsl() override { lsl_.destroyOutlet(outlet_); }
    Lsl(const Lsl&) = delete;
    Lsl& operator=(const Lsl&) = delete;

    // A recorder finds the stream only once it is there.
    void await() {
        constexpr int steps = 300;
        constexpr double step = 0.2; // seconds
        std::fprintf(stderr, "obscura-experiment: waits for a recorder of the stream Obscura\n");
        for (int i = 0; i < steps; ++i) {
            throwIfEnded();
            if (lsl_.waitForConsumers(outlet_, step))
                return;
        }
        throw Error("no recorder has opened the stream Obscura within a minute");
    }

  private:
    bool deliver(std::string_view line, const Mark& mark) override {
        const double onset = lsl_.localClock() - mark.age;
        const char* sample = line.data();
        return lsl_.haveConsumers(outlet_) && lsl_.push(outlet_, &sample, onset) == 0;
    }

    Liblsl lsl_; // never unloaded: threads of its own may be in it
    void* outlet_ = nullptr;
};

void setUp(const Descriptor& port) {
    termios settings{};
    if (::tcgetattr(port.number(), &settings) != 0)
        throw Error("it is no serial port");
    ::cfmakeraw(&settings);
    settings.c_cflag |= CLOCAL;
    settings.c_cflag &= ~static_cast<tcflag_t>(CRTSCTS | CSTOPB);
    ::cfsetspeed(&settings, B115200);
    if (::tcsetattr(port.number(), TCSANOW, &settings) != 0)
        throw Error(fmt::format("it does not do 115,200 baud: {}", std::strerror(errno)));
}

} // namespace

std::unique_ptr<Trigger> openSocket(bool stream, const std::string& host, const std::string& port) {
    addrinfo wanted{};
    wanted.ai_socktype = stream ? SOCK_STREAM : SOCK_DGRAM;
    addrinfo* found = nullptr;
    if (const int error = ::getaddrinfo(host.c_str(), port.c_str(), &wanted, &found))
        throw Error(fmt::format("{}: {}", host, ::gai_strerror(error)));
    const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> addresses(found, ::freeaddrinfo);
    std::string why;
    for (const addrinfo* address = found; address; address = address->ai_next)
        try {
            Descriptor socket = connected(*address);
            if (stream)
                return std::make_unique<Stream>(std::move(socket));
            return std::make_unique<Datagrams>(std::move(socket));
        } catch (const Error& error) {
            why = error.what();
        }
    throw Error(fmt::format("no receiver could be reached ({}); start it before the session", why));
}

std::unique_ptr<Trigger> openSerial(const std::string& device) {
    Descriptor port(::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (port.number() < 0)
        throw Error(std::strerror(errno));
    setUp(port);
    return std::make_unique<Serial>(std::move(port));
}

std::unique_ptr<Trigger> openLsl() {
    auto outlet = std::make_unique<Lsl>();
    outlet->await();
    return outlet;
}

} // namespace obscura
