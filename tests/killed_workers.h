#pragma once

#include "base/random.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace obscura::test {

// `work` in a process of its own, which ends with it: 0 unless it throws.
inline pid_t startWorker(const std::function<void()>& work) {
    const pid_t child = ::fork();
    if (child != 0)
        return child;
    try {
        work();
        ::_exit(0);
    } catch (const std::exception& error) {
        fmt::print(stderr, "worker: {}\n", error.what());
    }
    ::_exit(1);
}

// A program in place of this process; what it says goes to the end of a log.
[[noreturn]] inline void become(const std::vector<std::string>& command,
                                const std::filesystem::path& log) {
    const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    ::dup2(file, 1);
    ::dup2(file, 2);
    std::vector<char*> arguments;
    for (const std::string& each : command)
        arguments.push_back(const_cast<char*>(each.c_str()));
    arguments.push_back(nullptr);
    ::execv(arguments.front(), arguments.data());
    ::_exit(127);
}

// Starts `workers` of them, and kills one after the other at random moments, each at most
// `longest` seconds after the last, and starts another in its place, until so many `kills` are done
// or one has come to its end. Then waits for all. Returns how many were killed.
inline int killWorkers(int workers, int kills, double longest, std::uint64_t seed,
                       const std::function<void()>& work) {
    Random random(seed, "kills");
    std::vector<pid_t> running;
    for (int i = 0; i < workers; ++i)
        running.push_back(startWorker(work));
    const auto ended = [](pid_t worker) {
        int status = 0;
        EXPECT_EQ(::waitpid(worker, &status, 0), worker);
        EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0) << "a worker failed";
        return WIFEXITED(status);
    };
    int killed = 0;
    while (killed < kills) {
        ::usleep(static_cast<useconds_t>(1e6 * longest * random.uniform()));
        const std::size_t at = static_cast<std::size_t>(random.uniform() * workers);
        ::kill(running[at], SIGKILL);
        if (ended(running[at])) {
            running.erase(running.begin() + static_cast<std::ptrdiff_t>(at));
            break;
        }
        running[at] = startWorker(work);
        ++killed;
    }
    for (const pid_t worker : running)
        ended(worker);
    return killed;
}

} // namespace obscura::test
