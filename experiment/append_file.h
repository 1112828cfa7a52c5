#pragma once

#include <filesystem>
#include <string_view>

namespace obscura {

// A text file that only grows, by whole lines, each of them on disk before append() returns. A
// line that cannot be written to its end is taken out again, so a full disk leaves no half line.
// When the file has been moved or removed meanwhile, all that it held is saved in the system's
// folder for temporary files, and the Error says where.
class AppendFile {
  public:
    // A new file that begins with these lines, and is never seen without them. An Error when one
    // of that name is there: nothing is ever overwritten.
    static AppendFile create(const std::filesystem::path& path, std::string_view lines = {});

    // An old file or a new one, locked against every other process until this object dies; waits
    // for the lock. A last line without its end is given one when it is `whole`; else (power was
    // cut while it was written) it is removed.
    using IsWhole = bool (*)(std::string_view line);
    static AppendFile openLocked(
        const std::filesystem::path& path, IsWhole whole = [](std::string_view) { return false; });

    AppendFile(AppendFile&& other) noexcept;
    AppendFile& operator=(AppendFile&&) = delete;
    ~AppendFile();

    void append(std::string_view lines); // ends with a line feed

  private:
    AppendFile(std::filesystem::path path, int flags, std::string_view what);
    void mendLastLine(IsWhole whole);
    bool isInPlace() const;
    const std::filesystem::path& rescued();
    [[noreturn]] void fail(std::string_view what) const;

    std::filesystem::path path_;
    std::filesystem::path rescued_; // where its content was saved; "" for nowhere
    int descriptor_ = -1;
};

} // namespace obscura
