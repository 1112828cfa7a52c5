#include "tests/experiment/quiet.h"

#include <epoxy/gl.h>

#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>

namespace obscura::test {

namespace {

using Kind = Disturbance::Kind;

// Noted in memory of its own, for what is noted is allocations.
struct Note {
    Kind kind{};
    std::array<void*, 24> frames{};
    int depth = 0;
};
std::array<Note, 20000> notes;
std::atomic<int> noted = 0;
std::atomic<bool> listening = false;
thread_local bool noting = false; // what notes is not noted

void note(Kind kind) {
    if (!listening || noting)
        return;
    const int index = noted++;
    if (index >= static_cast<int>(notes.size()))
        return;
    noting = true;
    Note& mine = notes[static_cast<std::size_t>(index)];
    mine.kind = kind;
    mine.depth = ::backtrace(mine.frames.data(), static_cast<int>(mine.frames.size()));
    noting = false;
}

template <typename Function>
Function* next(const char* name) {
    return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

bool isFile(int descriptor) {
    struct stat status {};
    const int before = errno;
    const bool is = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
    errno = before;
    return is;
}

} // namespace

} // namespace obscura::test

using obscura::test::isFile;
using obscura::test::next;
using obscura::test::note;
using Kind = obscura::test::Disturbance::Kind;

// These stand before the libraries' own.
extern "C" {

#if defined(__SANITIZE_ADDRESS__) // as gcc says that it has functions of its own
#define OBSCURA_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) // as clang does
#define OBSCURA_SANITIZED
#endif
#endif
#if !defined(OBSCURA_SANITIZED)

void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
    note(Kind::allocation);
    return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) {
    note(Kind::allocation);
    return __libc_calloc(count, size);
}

void* realloc(void* memory, std::size_t size) {
    note(Kind::allocation);
    return __libc_realloc(memory, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
    note(Kind::allocation);
    return __libc_memalign(alignment, size);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
    note(Kind::allocation);
    *memory = __libc_memalign(alignment, size);
    return *memory ? 0 : ENOMEM;
}

#endif

#define OBSCURA_OPEN(name)                                                                         \
    int name(const char* path, int flags, ...) {                                                   \
        note(Kind::file);                                                                          \
        va_list arguments;                                                                         \
        va_start(arguments, flags);                                                                \
        const mode_t mode = (flags & O_CREAT) ? va_arg(arguments, mode_t) : 0;                     \
        va_end(arguments);                                                                         \
        return next<int(const char*, int, ...)>(#name)(path, flags, mode);                         \
    }
OBSCURA_OPEN(open)
OBSCURA_OPEN(open64)

#define OBSCURA_OPENAT(name)                                                                       \
    int name(int folder, const char* path, int flags, ...) {                                       \
        note(Kind::file);                                                                          \
        va_list arguments;                                                                         \
        va_start(arguments, flags);                                                                \
        const mode_t mode = (flags & O_CREAT) ? va_arg(arguments, mode_t) : 0;                     \
        va_end(arguments);                                                                         \
        return next<int(int, const char*, int, ...)>(#name)(folder, path, flags, mode);            \
    }
OBSCURA_OPENAT(openat)
OBSCURA_OPENAT(openat64)

FILE* fopen(const char* path, const char* mode) {
    note(Kind::file);
    return next<FILE*(const char*, const char*)>("fopen")(path, mode);
}

FILE* fopen64(const char* path, const char* mode) {
    note(Kind::file);
    return next<FILE*(const char*, const char*)>("fopen64")(path, mode);
}

ssize_t read(int descriptor, void* memory, std::size_t size) {
    if (isFile(descriptor))
        note(Kind::file);
    return next<ssize_t(int, void*, std::size_t)>("read")(descriptor, memory, size);
}

ssize_t write(int descriptor, const void* memory, std::size_t size) {
    if (isFile(descriptor))
        note(Kind::file);
    return next<ssize_t(int, const void*, std::size_t)>("write")(descriptor, memory, size);
}

int fsync(int descriptor) {
    note(Kind::file);
    return next<int(int)>("fsync")(descriptor);
}

int fdatasync(int descriptor) {
    note(Kind::file);
    return next<int(int)>("fdatasync")(descriptor);
}

int mprotect(void* memory, std::size_t size, int protection) {
    if (protection & PROT_EXEC)
        note(Kind::compilation);
    return next<int(void*, std::size_t, int)>("mprotect")(memory, size, protection);
}
}

namespace obscura::test {

void listen(bool on) {
    std::array<void*, 1> frames;
    ::backtrace(frames.data(), 1); // loads a library when it is first called
    listening = on;
}

namespace {

std::string moduleOf(const Dl_info& place) {
    static const void* const self = [] {
        Dl_info own{};
        ::dladdr(reinterpret_cast<void*>(&listen), &own);
        return own.dli_fbase;
    }();
    return place.dli_fbase == self ? "ours"
                                   : std::filesystem::path(place.dli_fname).filename().string();
}

// Its first frames are those of note() and of what stands before the library's own.
Disturbance attributed(const Note& note) {
    constexpr int own = 2;
    Disturbance result{note.kind, "", ""};
    for (int i = own; i < note.depth; ++i) {
        void* const address = note.frames[static_cast<std::size_t>(i)];
        Dl_info place{};
        const bool known = ::dladdr(address, &place) != 0;
        const std::string module = known ? moduleOf(place) : "no module";
        const auto offset = static_cast<char*>(address) - static_cast<char*>(place.dli_fbase);
        result.how += fmt::format("  {} {:#x} {}\n", module, known ? offset : 0,
                                  known && place.dli_sname ? place.dli_sname : "");
        if (result.by.empty() && !module.starts_with("libc.") && !module.starts_with("libstdc++"))
            result.by = module;
    }
    return result;
}

} // namespace

std::vector<Disturbance> heard() {
    listening = false;
    std::vector<Disturbance> all;
    const int kept = std::min(noted.exchange(0), static_cast<int>(notes.size()));
    for (int i = 0; i < kept; ++i)
        all.push_back(attributed(notes[static_cast<std::size_t>(i)]));
    return all;
}

std::string summary(const std::vector<Disturbance>& all) {
    constexpr std::array kinds = {"allocation", "file", "compilation", "upload"};
    std::map<std::string, int> counts;
    for (const Disturbance& one : all)
        ++counts[fmt::format("{} by {}", kinds[static_cast<std::size_t>(one.kind)], one.by)];
    std::string text;
    for (const auto& [what, count] : counts)
        text += fmt::format("{} times {}; ", count, what);
    return text.empty() ? "nothing" : text;
}

namespace {

// Stands before a function of OpenGL. Epoxy finds each at its first call, and replaces what was
// called; then this takes its place again.
template <auto* pointer, Kind kind, typename Function = std::remove_pointer_t<decltype(pointer)>>
struct Before;
template <auto* pointer, Kind kind, typename... Arguments>
struct Before<pointer, kind, void (*)(Arguments...)> {
    static inline void (*original)(Arguments...) = nullptr;

    static void call(Arguments... arguments) {
        note(kind);
        *pointer = original;
        original(arguments...);
        take();
    }
    static void take() {
        if (*pointer == call)
            return;
        original = *pointer;
        *pointer = call;
    }
};

} // namespace

void listenToOpenGl() {
    Before<&epoxy_glShaderSource, Kind::compilation>::take();
    Before<&epoxy_glCompileShader, Kind::compilation>::take();
    Before<&epoxy_glLinkProgram, Kind::compilation>::take();
    Before<&epoxy_glTextureStorage2D, Kind::upload>::take();
    Before<&epoxy_glTextureSubImage2D, Kind::upload>::take();
    Before<&epoxy_glNamedBufferStorage, Kind::upload>::take();
    Before<&epoxy_glGenerateTextureMipmap, Kind::upload>::take();
}

} // namespace obscura::test
