#include "experiment/append_file.h"

#include "base/error.h"
#include "base/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

namespace obscura {

namespace fs = std::filesystem;

namespace {

// A new file survives a power cut only when its folder's entry is on disk, too.
void flushFolder(const fs::path& folder) {
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0)
        return;
    ::fsync(descriptor);
    ::close(descriptor);
}

bool writeAll(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t count = ::write(descriptor, text.data(), text.size());
        if (count < 0 && errno != EINTR)
            return false;
        text.remove_prefix(count > 0 ? static_cast<std::size_t>(count) : 0);
    }
    return true;
}

} // namespace

// With its first lines at once, for a program may be killed between making a file and writing it.
AppendFile AppendFile::create(const fs::path& path, std::string_view lines) {
    if (!writeNewFile(path, lines))
        throw Error({path.string(), 0, 0, {}},
                    "expected to create a new file, found one of this name");
    return {path, 0, "cannot be opened"};
}

AppendFile AppendFile::openLocked(const fs::path& path, IsWhole whole) {
    AppendFile file(path, O_CREAT, "cannot be opened");
    while (::flock(file.descriptor_, LOCK_EX) != 0)
        if (errno != EINTR)
            file.fail("cannot be locked");
    file.mendLastLine(whole);
    return file;
}

AppendFile::AppendFile(fs::path path, int flags, std::string_view what) : path_(std::move(path)) {
    makeFolders(path_.parent_path());
    descriptor_ = ::open(path_.c_str(), flags | O_RDWR | O_APPEND | O_CLOEXEC, 0666);
    if (descriptor_ < 0)
        fail(what);
    flushFolder(path_.parent_path());
}

AppendFile::AppendFile(AppendFile&& other) noexcept
    : path_(std::move(other.path_)), rescued_(std::move(other.rescued_)),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

AppendFile::~AppendFile() {
    if (descriptor_ >= 0)
        ::close(descriptor_); // and with it the lock
}

void AppendFile::append(std::string_view lines) {
    assert(lines.ends_with('\n'));
    const off_t before = ::lseek(descriptor_, 0, SEEK_END);
    if (writeAll(descriptor_, lines) && ::fsync(descriptor_) == 0) {
        if (!isInPlace())
            throw Error({path_.string(), 0, 0, {}},
                        fmt::format("was moved or removed while it was in use; all that it held "
                                    "is in {}",
                                    rescued().string()));
        return;
    }
    const int reason = errno;
    if (::ftruncate(descriptor_, before) == 0)
        ::fsync(descriptor_);
    errno = reason;
    fail(fmt::format("cannot be written; what was to be added: {}",
                     lines.substr(0, lines.size() - 1)));
}

bool AppendFile::isInPlace() const {
    struct stat here {
    }, there{};
    return ::fstat(descriptor_, &here) == 0 && ::stat(path_.c_str(), &there) == 0 &&
           here.st_dev == there.st_dev && here.st_ino == there.st_ino;
}

// One copy, which grows with the file.
const fs::path& AppendFile::rescued() {
    const auto size =
        static_cast<std::size_t>(std::max<off_t>(0, ::lseek(descriptor_, 0, SEEK_END)));
    std::string content(size, '\0');
    const ssize_t count = ::pread(descriptor_, content.data(), size, 0);
    content.resize(static_cast<std::size_t>(std::max<ssize_t>(0, count)));
    if (!rescued_.empty())
        writeFile(rescued_, content);
    for (int number = 1; rescued_.empty(); ++number) {
        const fs::path path =
            fs::temp_directory_path() /
            fmt::format("obscura-rescued-{}-{}", number, path_.filename().string());
        if (writeNewFile(path, content))
            rescued_ = path;
    }
    return rescued_;
}

void AppendFile::mendLastLine(IsWhole whole) {
    const std::string content = readFile(path_);
    const std::size_t end = content.rfind('\n') + 1; // npos + 1 is 0: no line at all
    if (end == content.size())
        return;
    if (whole(std::string_view(content).substr(end)))
        append("\n");
    else if (::ftruncate(descriptor_, static_cast<off_t>(end)) != 0)
        fail("cannot be mended");
}

void AppendFile::fail(std::string_view what) const {
    throw Error({path_.string(), 0, 0, {}}, fmt::format("{}: {}", what, std::strerror(errno)));
}

} // namespace obscura
