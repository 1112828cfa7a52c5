#include "protocols/files.h"

#include "protocols/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/evp.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
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

// Beside `path`, hidden.
fs::path unfinishedPath(const fs::path& path) {
    if (path.has_parent_path())
        fs::create_directories(path.parent_path());
    fs::path unfinished = path;
    unfinished.replace_filename(
        fmt::format(".{}.{}{}", path.stem().string(), ::getpid(), path.extension().string()));
    return unfinished;
}

void publish(const fs::path& unfinished, const fs::path& path) {
    flushToDisk(unfinished);
    fs::rename(unfinished, path);
    flushToDisk(path.has_parent_path() ? path.parent_path() : fs::path("."));
}

} // namespace

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
    if (!fs::exists(folder))
        return;
    std::vector<fs::path> hidden;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (entry.is_regular_file() && entry.path().filename().string().starts_with('.'))
            hidden.push_back(entry.path());
    for (const fs::path& path : hidden)
        fs::remove(path);
}

void writeFile(const fs::path& path, std::string_view content) {
    const fs::path unfinished = unfinishedPath(path);
    try {
        {
            File file = open(unfinished, "wb", "cannot be written");
            if (std::fwrite(content.data(), 1, content.size(), file.get()) != content.size() ||
                std::fflush(file.get()) != 0)
                fail(unfinished, "cannot be written to its end");
        }
        publish(unfinished, path);
    } catch (...) {
        std::error_code ignored;
        fs::remove(unfinished, ignored);
        throw;
    }
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
