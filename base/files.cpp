#include "base/files.h"

#include "base/error.h"
#include "base/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/evp.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <vector>

namespace obscura {

namespace fs = std::filesystem;

namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

[[noreturn]] void fail(const fs::path& path, std::string_view what) {
    throw Error({path.string(), 0, 0, {}}, fmt::format("{}: {}", what, std::strerror(errno)));
}

File open(const fs::path& path, const char* mode, std::string_view what) {
    File file(std::fopen(path.c_str(), mode));
    if (!file)
        fail(path, what);
    return file;
}

// A rename is only safe from a power cut once the file's bytes, and then the folder's entry, are
// on disk.
void flushToDisk(const fs::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
        fail(path, "cannot be opened to flush it to disk");
    const int failed = ::fsync(descriptor);
    ::close(descriptor);
    if (failed)
        fail(path, "cannot be flushed to disk");
}

fs::path folderOf(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

// ".obscura-unfinished.PROCESS.NUMBER": hidden, and beyond doubt ours and of whom. It does not hold
// the target's name, which may be as long as a name can be.
constexpr std::string_view unfinishedPrefix = ".obscura-unfinished.";

fs::path unfinishedPath(const fs::path& path) {
    static std::atomic<int> files = 0; // threads write at the same time
    return folderOf(path) /
           fmt::format("{}{}.{}", unfinishedPrefix, ProcessId::current().text(), ++files);
}

// Whose unfinished file has this name.
std::optional<ProcessId> writerOf(std::string_view name) {
    const std::size_t number = name.rfind('.') + 1;
    if (!name.starts_with(unfinishedPrefix) || number <= unfinishedPrefix.size() ||
        number == name.size() || name.find_first_not_of("0123456789", number) != name.npos)
        return std::nullopt;
    name.remove_suffix(name.size() - number + 1);
    name.remove_prefix(unfinishedPrefix.size());
    return ProcessId::parse(name);
}

// Whether a link failed for `reason` because there is something: sshfs gives EPERM for that, and
// NFS may remember for a while that there was nothing.
bool isTaken(const fs::path& path, int reason) {
    std::error_code ignored;
    const bool taken = reason == EEXIST || fs::exists(fs::symlink_status(path, ignored));
    errno = reason;
    return taken;
}

// Gives what was written its name; false where `mayReplace` is not and something has that name.
bool publish(const fs::path& unfinished, const fs::path& path, bool mayReplace) {
    flushToDisk(unfinished);
    // A hard link, unlike a rename, is never made over what is there.
    bool failed = mayReplace ? ::rename(unfinished.c_str(), path.c_str()) != 0
                             : ::link(unfinished.c_str(), path.c_str()) != 0;
    if (failed && !mayReplace && isTaken(path, errno)) {
        std::error_code ignored;
        // Over a network the answer to a link can be lost: asked again, the name is taken, by us
        // (open(2)).
        failed = false;
        if (!fs::equivalent(unfinished, path, ignored))
            return false;
    }
    if (failed)
        fail(path, mayReplace ? "cannot be replaced" : "cannot be created");
    flushToDisk(folderOf(path));
    return true;
}

bool write(const fs::path& path, std::string_view content, bool mayReplace) {
    makeFolders(path.parent_path());
    const fs::path unfinished = unfinishedPath(path);
    // "x": never into what is there, be it a link.
    File file = open(unfinished, "wbx", "cannot be written");
    std::error_code ignored;
    try {
        if (std::fwrite(content.data(), 1, content.size(), file.get()) != content.size() ||
            std::fflush(file.get()) != 0)
            fail(path, "cannot be written to its end");
        file.reset();
        const bool done = publish(unfinished, path, mayReplace);
        if (!mayReplace)
            fs::remove(unfinished, ignored);
        return done;
    } catch (...) {
        fs::remove(unfinished, ignored);
        throw;
    }
}

} // namespace

void makeFolders(const fs::path& folder) {
    if (folder.empty() || fs::is_directory(folder))
        return;
    makeFolders(folder.parent_path());
    std::error_code failed;
    fs::create_directory(folder, failed);
    if (failed)
        throw Error({folder.string(), 0, 0, {}},
                    fmt::format("expected a folder, or room for one: {}", failed.message()));
    flushToDisk(folderOf(folder));
}

std::string readFile(const fs::path& path) {
    if (fs::is_directory(path))
        throw Error({path.string(), 0, 0, {}}, "expected a file, found a folder");
    const File file = open(path, "rb", "cannot be read");
    std::string content;
    char buffer[65536];
    while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, file.get()))
        content.append(buffer, count);
    if (std::ferror(file.get()))
        fail(path, "cannot be read to its end");
    return content;
}

std::string plainName(std::string text) {
    std::replace_if(
        text.begin(), text.end(),
        [](unsigned char c) {
            return !(c < 128 && (std::isalnum(c) || c == '-' || c == '_' || c == '.'));
        },
        '-');
    return text;
}

void removeUnfinishedFiles(const fs::path& folder) {
    if (!fs::is_directory(folder))
        return;
    std::vector<fs::path> abandoned;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const auto writer = writerOf(entry.path().filename().string());
        if (writer && fs::is_regular_file(entry.symlink_status()) && isGone(*writer))
            abandoned.push_back(entry.path());
    }
    for (const fs::path& path : abandoned) {
        std::error_code gone; // another run, tidying as well, was quicker
        fs::remove(path, gone);
    }
}

void writeFile(const fs::path& path, std::string_view content) { write(path, content, true); }

bool writeNewFile(const fs::path& path, std::string_view content) {
    return write(path, content, false);
}

struct Sha256::State {
    std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context{EVP_MD_CTX_new(),
                                                                    &EVP_MD_CTX_free};
};

Sha256::Sha256() : state_(std::make_unique<State>()) {
    EVP_DigestInit_ex(state_->context.get(), EVP_sha256(), nullptr);
}
Sha256::~Sha256() = default;
Sha256::Sha256(Sha256&&) noexcept = default;
Sha256& Sha256::operator=(Sha256&&) noexcept = default;

void Sha256::add(std::span<const std::byte> bytes) {
    EVP_DigestUpdate(state_->context.get(), bytes.data(), bytes.size());
}

std::string Sha256::hex() {
    unsigned char digest[32];
    EVP_DigestFinal_ex(state_->context.get(), digest, nullptr);
    std::string text;
    for (const unsigned char byte : digest)
        text += fmt::format("{:02x}", byte);
    return text;
}

std::string sha256(std::string_view content) {
    Sha256 hash;
    hash.add(content);
    return hash.hex();
}

std::string sha256File(const fs::path& path) {
    const File file = open(path, "rb", "cannot be read");
    Sha256 hash;
    char buffer[65536];
    while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, file.get()))
        hash.add(std::string_view(buffer, count));
    if (std::ferror(file.get()))
        fail(path, "cannot be read to its end");
    return hash.hex();
}

} // namespace obscura
