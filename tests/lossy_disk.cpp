#include "tests/lossy_disk.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

namespace obscura::test {

namespace fs = std::filesystem;

namespace {

LossyDisk* current = nullptr; // fsync() knows nothing but its descriptor

ino_t numberOf(const fs::path& path) {
    struct stat status {};
    return ::lstat(path.c_str(), &status) == 0 ? status.st_ino : 0;
}

int syncOn(int descriptor, long call) {
    const int failed = static_cast<int>(::syscall(call, descriptor));
    std::error_code unknown;
    const fs::path path = fs::read_symlink(fmt::format("/proc/self/fd/{}", descriptor), unknown);
    if (failed == 0 && !unknown && current)
        current->sync(path);
    return failed;
}

} // namespace

LossyDisk::LossyDisk(fs::path root) : root_(fs::canonical(root)) {
    sync(root_);
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root_))
        sync(entry.path());
    current = this;
}

LossyDisk::~LossyDisk() {
    current = nullptr;
    for (const int descriptor : held_)
        ::close(descriptor);
}

void LossyDisk::sync(const fs::path& path) {
    const ino_t number = numberOf(path);
    held_.push_back(::open(path.c_str(), O_PATH | O_CLOEXEC));
    if (fs::is_directory(path)) {
        std::map<std::string, ino_t>& names = names_[number];
        names.clear();
        for (const fs::directory_entry& entry : fs::directory_iterator(path))
            names[entry.path().filename().string()] = numberOf(entry.path());
        return;
    }
    std::ifstream file(path, std::ios::binary);
    contents_[number].assign(std::istreambuf_iterator<char>(file), {});
}

void LossyDisk::addLeft(ino_t folder, const std::string& prefix,
                        std::map<std::string, std::string>& all) const {
    const auto names = names_.find(folder);
    if (names == names_.end())
        return;
    for (const auto& [name, number] : names->second) {
        if (const auto content = contents_.find(number); content != contents_.end())
            all[prefix + name] = content->second;
        else if (names_.contains(number))
            addLeft(number, prefix + name + "/", all);
        else
            all[prefix + name] = ""; // a name whose bytes never arrived, or an empty folder's
    }
}

std::map<std::string, std::string> LossyDisk::left() const {
    std::map<std::string, std::string> all;
    addLeft(numberOf(root_), "", all);
    return all;
}

} // namespace obscura::test

extern "C" int fsync(int descriptor) { return obscura::test::syncOn(descriptor, SYS_fsync); }
extern "C" int fdatasync(int descriptor) {
    return obscura::test::syncOn(descriptor, SYS_fdatasync);
}
