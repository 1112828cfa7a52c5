#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace obscura {

// The whole file; an Error naming the path and the system's reason when it cannot be read.
std::string readFile(const std::filesystem::path& path);

// Makes a folder, and the folders above it that are missing, so that they survive a power cut.
void makeFolders(const std::filesystem::path& folder);

// Writes beside the target, flushes to disk, then renames: a reader sees the old file or the new
// one, never half of one, also after a power cut. Creates missing parent folders.
void writeFile(const std::filesystem::path& path, std::string_view content);

// Writes a new file in the same way. Where there is a file already, it changes nothing and returns
// false.
bool writeNewFile(const std::filesystem::path& path, std::string_view content);

// The text as a file name that every system and every page takes: what is no letter, digit, "-",
// "_" or "." becomes "-".
std::string plainName(std::string text);

// Removes from a folder, not from those within it, what writeFile() was writing when its process
// was killed. Anything else stays: only a regular file of the very name that writeFile() makes up,
// of a process that is gone beyond doubt, is removed. No other file of ours may be removed by a
// pattern.
void removeUnfinishedFiles(const std::filesystem::path& folder);

// SHA-256 in parts. hex() ends it: 64 lower-case digits.
class Sha256 {
  public:
    Sha256();
    ~Sha256();
    Sha256(Sha256&&) noexcept;
    Sha256& operator=(Sha256&&) noexcept;

    void add(std::span<const std::byte> bytes);
    void add(std::string_view text) { add(std::as_bytes(std::span(text))); }
    std::string hex();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

std::string sha256(std::string_view content);
std::string sha256File(const std::filesystem::path& path);

} // namespace obscura
