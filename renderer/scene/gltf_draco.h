#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace obscura {

// How an attribute lies in a Draco stream, and how a glTF accessor wants it.
struct DracoAttribute {
    std::uint32_t id = 0; // unique in the stream
    int components = 0;
    float most = 1; // what whole numbers are divided by: 1, or the greatest one if normalised
};

// A mesh that KHR_draco_mesh_compression packs.
struct DracoMesh {
    std::size_t vertices = 0;
    std::vector<std::uint32_t> corners;                   // three a triangle, all below `vertices`
    std::map<std::string, std::vector<float>> attributes; // by name, as many as were asked for
};

// The mesh, or what was expected and what was found instead. The stream's own counts are looked at
// before anything is made for them: more than `mostCorners` are a fault.
std::variant<DracoMesh, std::string>
decodeDraco(std::span<const std::byte> bytes,
            const std::map<std::string, DracoAttribute>& attributes, std::size_t mostCorners);

} // namespace obscura
