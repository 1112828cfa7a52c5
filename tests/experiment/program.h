#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace obscura::test {

// The presenter under test: started with arguments on a display, its output in a file, killed with
// this object. What is waited for is given up by lack of progress, not by time: when the program
// has ended, when it was found asleep a thousand times and has hardly computed meanwhile, or when
// it has computed for minutes. A busy machine makes none of these happen sooner. Giving up throws,
// which ends the test.
class Program {
  public:
    Program(const std::string& display, std::vector<std::string> arguments,
            std::filesystem::path output);
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    void await(const std::string& what, const std::function<bool()>& reached);
    int wait(); // for its end: its exit status
    void kill();
    void signal(int number);
    void freeze();
    void thaw();

    std::string output() const;

  private:
    void giveUp(const std::string& what, const std::string& why) const;

    std::filesystem::path output_;
    pid_t process_;
};

} // namespace obscura::test
