// libFuzzer: any bytes as a glTF file, binary where they begin as one. An Error is right, and so is
// a scene; all else is a finding.
#include "base/error.h"
#include "base/files.h"
#include "renderer/scene/scene.h"

#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace obscura;
    static const std::filesystem::path folder = std::filesystem::temp_directory_path() /
                                                ("obscura-fuzz-gltf-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    const bool binary = size >= 4 && std::memcmp(data, "glTF", 4) == 0;
    const std::filesystem::path path = folder / (binary ? "t.glb" : "t.gltf");
    std::FILE* file = std::fopen(path.c_str(), "wb");
    std::fwrite(data, 1, size, file);
    std::fclose(file);
    try {
        loadScene(path);
    } catch (const Error&) {
    }
    return 0;
}
