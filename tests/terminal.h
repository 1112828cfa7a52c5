#pragma once

#include <string>
#include <vector>

namespace obscura::test {

// A program on a terminal of its own, at which somebody types.
class Terminal {
  public:
    // A program of PATH with its arguments, in an environment of PATH and `environment` alone.
    Terminal(std::vector<std::string> program, std::vector<std::string> environment);
    ~Terminal();
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    void type(const std::string& keys);
    // What was written until `text` came, after what earlier calls have given; all that there is
    // where it has not come within a minute.
    std::string readUntil(const std::string& text);

  private:
    int terminal_ = -1, process_ = -1;
    std::string read_;
};

} // namespace obscura::test
