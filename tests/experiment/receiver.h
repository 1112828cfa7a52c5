#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>
#include <vector>

namespace obscura::test {

// One who is told of onsets, at a port of this machine that the system has chosen. Of a TCP
// receiver, the first that connects.
class Receiver {
  public:
    explicit Receiver(int type) : type_(type), socket_(::socket(AF_INET, type | SOCK_CLOEXEC, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        EXPECT_EQ(::bind(socket_, reinterpret_cast<sockaddr*>(&address), size), 0);
        if (type == SOCK_STREAM) {
            EXPECT_EQ(::listen(socket_, 1), 0);
        }
        ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
        port_ = ntohs(address.sin_port);
    }
    ~Receiver() { vanish(); }
    Receiver(const Receiver&) = delete;
    Receiver& operator=(const Receiver&) = delete;

    std::string url() const {
        return (type_ == SOCK_STREAM ? "tcp://127.0.0.1:" : "udp://127.0.0.1:") +
               std::to_string(port_);
    }
    // Whole lines that have arrived; until `atLeast` have, or the sender is gone, it waits.
    std::vector<std::string> lines(std::size_t atLeast) {
        if (type_ == SOCK_STREAM && connection_ < 0)
            connection_ = ::accept(socket_, nullptr, nullptr);
        std::vector<std::string> all = split();
        std::vector<char> part(65536);
        while (all.size() < atLeast) {
            const ssize_t size =
                ::recv(type_ == SOCK_STREAM ? connection_ : socket_, part.data(), part.size(), 0);
            if (size < 0 || (size == 0 && type_ == SOCK_STREAM))
                break;
            text_.append(part.data(), static_cast<std::size_t>(size));
            const std::vector<std::string> more = split();
            all.insert(all.end(), more.begin(), more.end());
        }
        return all;
    }
    void vanish() {
        for (int* descriptor : {&connection_, &socket_})
            if (*descriptor >= 0) {
                ::close(*descriptor);
                *descriptor = -1;
            }
    }

  private:
    std::vector<std::string> split() {
        std::vector<std::string> all;
        std::size_t begin = 0;
        for (std::size_t end; (end = text_.find('\n', begin)) != text_.npos; begin = end + 1)
            all.push_back(text_.substr(begin, end - begin));
        text_.erase(0, begin);
        return all;
    }

    int type_, socket_, connection_ = -1;
    int port_ = 0;
    std::string text_;
};

} // namespace obscura::test
