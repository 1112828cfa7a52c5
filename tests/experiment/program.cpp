#include "tests/experiment/program.h"

#include "base/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace obscura::test {

namespace {

constexpr int mostSleepy = 1000;       // looks at a sleeping program, 10 ms apart or more, in
constexpr double leastComputing = 0.2; // which it must have computed so many seconds
constexpr double mostComputing = 180;

// How a process is, as Linux says it.
struct Pulse {
    char state = 'X';     // R running or ready, S asleep, D waiting for the disk
    double computing = 0; // seconds of all its threads so far
};

Pulse pulseOf(pid_t process) {
    std::ifstream file(fmt::format("/proc/{}/stat", process));
    std::stringstream text;
    text << file.rdbuf();
    const std::string line = text.str();
    Pulse pulse;
    if (const auto name = line.rfind(')'); name != std::string::npos) {
        std::istringstream fields(line.substr(name + 1));
        fields >> pulse.state;
        std::string skipped;
        for (int i = 0; i < 10; ++i)
            fields >> skipped;
        double user = 0, system = 0;
        fields >> user >> system;
        pulse.computing = (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
    }
    return pulse;
}

// All of its threads, that is: it can be waited for, which this leaves to others.
bool hasEnded(pid_t process) {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
           info.si_pid != 0;
}

} // namespace

Program::Program(const std::string& display, std::vector<std::string> arguments,
                 std::filesystem::path output)
    : output_(std::move(output)), process_(::fork()) {
    if (process_ != 0)
        return;
    ::setenv("DISPLAY", display.c_str(), 1);
    ::unsetenv("WAYLAND_DISPLAY");
    const int file = ::open(output_.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0666);
    ::dup2(file, STDOUT_FILENO);
    ::dup2(file, STDERR_FILENO);
    std::vector<char*> raw{const_cast<char*>(OBSCURA_BIN "/obscura-experiment")};
    for (std::string& argument : arguments)
        raw.push_back(argument.data());
    raw.push_back(nullptr);
    ::execv(raw[0], raw.data());
    ::_exit(127);
}

Program::~Program() { kill(); }

void Program::kill() {
    if (process_ <= 0)
        return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    process_ = 0;
}

void Program::signal(int number) { ::kill(process_, number); }

void Program::freeze() {
    ::kill(process_, SIGSTOP);
    int status = 0;
    ::waitpid(process_, &status, WUNTRACED); // it has stopped, or ended
    if (!WIFSTOPPED(status)) {
        process_ = 0;
        giveUp("to stop the program", "it has ended");
    }
}

void Program::thaw() { ::kill(process_, SIGCONT); }

void Program::await(const std::string& what, const std::function<bool()>& reached) {
    const double begun = pulseOf(process_).computing;
    double before = begun;
    for (int asleep = 0; !reached();) {
        const Pulse pulse = pulseOf(process_);
        if (hasEnded(process_))
            return reached() ? void() : giveUp(what, "it has ended");
        asleep += pulse.state == 'S';
        if (pulse.computing - before >= leastComputing) {
            before = pulse.computing;
            asleep = 0;
        }
        if (asleep > mostSleepy)
            giveUp(what, "it sleeps");
        if (pulse.computing - begun > mostComputing)
            giveUp(what, "it has computed for minutes");
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
}

int Program::wait() {
    int status = 0;
    bool ended = false;
    await("the program's end", [&] {
        ended = ended || ::waitpid(process_, &status, WNOHANG) == process_;
        return ended;
    });
    process_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string Program::output() const { return readFile(output_); }

void Program::giveUp(const std::string& what, const std::string& why) const {
    throw std::runtime_error(
        fmt::format("waited for {}, but {}. The program has said: {}", what, why, output()));
}

} // namespace obscura::test
