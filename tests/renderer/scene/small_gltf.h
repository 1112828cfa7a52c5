#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace obscura {

// One triangle in the plane z = 0, counter-clockwise from +z, with texture coordinates.
inline std::string triangleBuffer() {
    const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, uvs[] = {0, 1, 1, 1, 0, 0};
    const std::uint16_t indices[] = {0, 1, 2, 0};
    std::string bytes(sizeof positions + sizeof uvs + sizeof indices, '\0');
    std::memcpy(bytes.data(), positions, sizeof positions);
    std::memcpy(bytes.data() + 36, uvs, sizeof uvs);
    std::memcpy(bytes.data() + 60, indices, sizeof indices);
    return bytes;
}

// A glTF file of it, with `node`, `material` and `extra` put into the node, the material and the
// root; each begins with a comma.
inline std::string triangleGltf(const std::string& node = "", const std::string& material = "",
                                const std::string& extra = "") {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0)" +
           node +
           R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},)"
           R"("indices":2,"material":0}]}],"materials":[{"name":"m")" +
           material +
           R"(}],"buffers":[{"uri":"t.bin","byteLength":68}],"bufferViews":[)"
           R"({"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24},)"
           R"({"buffer":0,"byteOffset":60,"byteLength":6}],"accessors":[)"
           R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
           R"({"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"},)"
           R"({"bufferView":2,"componentType":5123,"count":3,"type":"SCALAR"}])" +
           extra + "}";
}

// Triangles without index, flat: three floats a corner, as the file t.bin and the glTF that names
// it.
inline std::string trianglesBuffer(const std::vector<float>& positions) {
    std::string bytes(positions.size() * sizeof(float), '\0');
    std::memcpy(bytes.data(), positions.data(), bytes.size());
    return bytes;
}
inline std::string trianglesGltf(const std::vector<float>& positions) {
    const std::string length = std::to_string(positions.size() * sizeof(float)),
                      count = std::to_string(positions.size() / 3);
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
           R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],)"
           R"("materials":[{"doubleSided":true}],"buffers":[{"uri":"t.bin","byteLength":)" +
           length + R"(}],"bufferViews":[{"buffer":0,"byteLength":)" + length +
           R"(}],"accessors":[{"bufferView":0,"componentType":5126,"count":)" + count +
           R"(,"type":"VEC3"}]})";
}

} // namespace obscura
