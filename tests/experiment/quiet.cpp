#include "tests/experiment/quiet.h"

#include <epoxy/gl.h>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>

#include <atomic>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <new>

namespace {

std::atomic<int> allocations = 0, files = 0, compilations = 0;

template <typename Function>
Function* next(const char* name) {
    return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

PFNGLCOMPILESHADERPROC compileShader = nullptr;
PFNGLLINKPROGRAMPROC linkProgram = nullptr;

} // namespace

// These stand before the libraries' own.
void* operator new(std::size_t size) {
    ++allocations;
    if (void* memory = std::malloc(size ? size : 1))
        return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

extern "C" {

int open(const char* path, int flags, ...) {
    ++files;
    va_list arguments;
    va_start(arguments, flags);
    const mode_t mode = (flags & O_CREAT) ? va_arg(arguments, mode_t) : 0;
    va_end(arguments);
    return next<int(const char*, int, ...)>("open")(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
    ++files;
    va_list arguments;
    va_start(arguments, flags);
    const mode_t mode = (flags & O_CREAT) ? va_arg(arguments, mode_t) : 0;
    va_end(arguments);
    return next<int(const char*, int, ...)>("open64")(path, flags, mode);
}

FILE* fopen(const char* path, const char* mode) {
    ++files;
    return next<FILE*(const char*, const char*)>("fopen")(path, mode);
}

FILE* fopen64(const char* path, const char* mode) {
    ++files;
    return next<FILE*(const char*, const char*)>("fopen64")(path, mode);
}

int mprotect(void* memory, std::size_t size, int protection) {
    compilations += (protection & PROT_EXEC) != 0;
    return next<int(void*, std::size_t, int)>("mprotect")(memory, size, protection);
}
}

namespace obscura::test {

Disturbances disturbances() { return {allocations, files, compilations}; }

Disturbances operator-(const Disturbances& later, const Disturbances& earlier) {
    return {later.allocations - earlier.allocations, later.files - earlier.files,
            later.compilations - earlier.compilations};
}

// Epoxy finds each function at its first call, and replaces what was called.
void listenToShaders() {
    glCompileShader(glCreateShader(GL_FRAGMENT_SHADER));
    glLinkProgram(glCreateProgram());
    compileShader = glCompileShader;
    glCompileShader = [](GLuint shader) {
        ++compilations;
        compileShader(shader);
    };
    linkProgram = glLinkProgram;
    glLinkProgram = [](GLuint program) {
        ++compilations;
        linkProgram(program);
    };
}

} // namespace obscura::test
