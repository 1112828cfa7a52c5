#pragma once

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace obscura::test {

// A disk that loses at a power cut all that was not synced: of a file stays what it held at its
// last fsync, of a folder the names that it held at its own. It stands in place of the C library's
// fsync and fdatasync in the programs that link it. One at a time; `root` on one file system.
class LossyDisk {
  public:
    explicit LossyDisk(std::filesystem::path root); // what lies there now is on the disk
    ~LossyDisk();
    LossyDisk(const LossyDisk&) = delete;
    LossyDisk& operator=(const LossyDisk&) = delete;

    // The files that a power cut would leave now, by path within the root, and their contents.
    std::map<std::string, std::string> left() const;

    void sync(const std::filesystem::path& path);

  private:
    void addLeft(ino_t folder, const std::string& prefix,
                 std::map<std::string, std::string>& all) const;

    std::filesystem::path root_;
    std::vector<int> held_;                 // descriptors, so that no number is used again
    std::map<ino_t, std::string> contents_; // of files
    std::map<ino_t, std::map<std::string, ino_t>> names_; // in folders
};

} // namespace obscura::test
