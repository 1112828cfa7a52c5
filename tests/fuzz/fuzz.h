#pragma once

#include "base/error.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>

namespace obscura {

// The fuzzer's input as a file without a disk, for readers that open a path.
class FuzzFile {
  public:
    explicit FuzzFile(std::string_view content) : descriptor_(::memfd_create("fuzz", 0)) {
        if (descriptor_ < 0 || ::write(descriptor_, content.data(), content.size()) !=
                                   static_cast<ssize_t>(content.size()))
            std::abort();
    }
    ~FuzzFile() { ::close(descriptor_); }
    FuzzFile(const FuzzFile&) = delete;
    FuzzFile& operator=(const FuzzFile&) = delete;

    std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

  private:
    int descriptor_;
};

// What a reader owes to any input: a value, or an Error that says something in one line. Any other
// exception leaves the fuzz target, which is a finding.
template <typename Read>
void readsOrRefuses(Read read) {
    try {
        read();
    } catch (const Error& error) {
        if (std::string_view(error.what()).empty())
            std::abort();
    }
}

} // namespace obscura
