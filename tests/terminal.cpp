#include "tests/terminal.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>

namespace obscura::test {

namespace {

std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> all;
    for (std::string& text : texts)
        all.push_back(text.data());
    all.push_back(nullptr);
    return all;
}

} // namespace

Terminal::Terminal(std::vector<std::string> program, std::vector<std::string> environment) {
    winsize size{50, 200, 0, 0};
    process_ = ::forkpty(&terminal_, nullptr, nullptr, &size);
    if (process_ == 0) {
        ::execvpe(program.front().c_str(), pointers(program).data(), pointers(environment).data());
        ::_exit(127);
    }
    EXPECT_GT(process_, 0);
}

Terminal::~Terminal() {
    if (process_ <= 0)
        return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    ::close(terminal_);
}

void Terminal::type(const std::string& keys) {
    EXPECT_EQ(::write(terminal_, keys.data(), keys.size()), static_cast<ssize_t>(keys.size()));
}

std::string Terminal::readUntil(const std::string& text) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    std::size_t found;
    while ((found = read_.find(text)) == read_.npos && std::chrono::steady_clock::now() < end) {
        pollfd ready{terminal_, POLLIN, 0};
        char buffer[4096];
        if (::poll(&ready, 1, 1000) <= 0)
            continue;
        const ssize_t count = ::read(terminal_, buffer, sizeof buffer);
        if (count <= 0)
            break;
        read_.append(buffer, static_cast<std::size_t>(count));
    }
    const std::size_t length = found == read_.npos ? read_.size() : found + text.size();
    const std::string before = read_.substr(0, length);
    read_.erase(0, length);
    return before;
}

} // namespace obscura::test
