#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace obscura {

// A place in a text file that a person can open: line and column count from 1, 0 means "the whole
// file"; `key` is a dotted path within it ("conditions[2].pair"), or a CSV column's name.
struct Place {
    std::string file;
    int line = 0;
    int column = 0;
    std::string key;

    // "demo.toml:12:5: conditions[2].pair: ", with the parts that are known; "" for an empty place.
    std::string prefix() const;
};

// The one exception of Obscura: wrong input, which a person must mend. The message says what was
// expected, what was found and what to do; the place says where. Each main() has the only catch.
class Error : public std::runtime_error {
  public:
    explicit Error(const std::string& message) : std::runtime_error(message) {}
    Error(const Place& place, const std::string& message)
        : std::runtime_error(place.prefix() + message), place_(place) {}

    const Place& place() const { return place_; }

  private:
    Place place_;
};

// The candidate with the smallest edit distance to `given`, or "" when none is near enough to be a
// likely misspelling (more than a third of the longer word differs).
std::string nearest(std::string_view given, std::span<const std::string> candidates);

// `; did you mean "x"?` for the nearest candidate, else `; one of: a, b, c`.
std::string suggestion(std::string_view given, std::span<const std::string> candidates);

// Runs a program's body and turns an Error (or any other exception) into one line on stderr and
// exit status 1. `program` is the name the line begins with.
int runProgram(std::string_view program, int (*body)(int, char**), int argc, char** argv);

} // namespace obscura
