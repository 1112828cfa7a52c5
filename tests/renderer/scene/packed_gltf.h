#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include <cstring>
#include <string>
#include <vector>

namespace obscura {

// glTF files made piece by piece, for tests: the JSON, and the buffer t.bin that it names.
class GltfBuilder {
  public:
    GltfBuilder() {
        root = nlohmann::json::parse(
            R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
            R"("meshes":[{"primitives":[{"attributes":{}}]}],"bufferViews":[],"accessors":[]})");
    }

    nlohmann::json root;
    std::string bytes;

    nlohmann::json& primitive() { return root["meshes"][0]["primitives"][0]; }

    // A view of these bytes; returns its index.
    template <typename T>
    std::size_t view(const std::vector<T>& values) {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        root["bufferViews"].push_back({{"buffer", 0},
                                       {"byteOffset", bytes.size()},
                                       {"byteLength", values.size() * sizeof(T)}});
        bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        return root["bufferViews"].size() - 1;
    }
    // A view that only meshoptimizer can read: `packed` of elements of `stride` bytes.
    std::size_t packedView(const std::vector<unsigned char>& packed, std::size_t count,
                           std::size_t stride, const std::string& mode,
                           const std::string& filter = "NONE") {
        const std::size_t index = view(packed);
        nlohmann::json& made = root["bufferViews"][index];
        nlohmann::json extension = made;
        extension.update(nlohmann::json{
            {"byteStride", stride}, {"count", count}, {"mode", mode}, {"filter", filter}});
        made = {{"buffer", 1}, {"byteLength", count * stride}};
        if (mode == "ATTRIBUTES")
            made["byteStride"] = stride;
        made["extensions"]["EXT_meshopt_compression"] = extension;
        fallback_ += count * stride;
        return index;
    }
    std::size_t accessor(std::size_t view, std::size_t count, const std::string& type,
                         int componentType, bool normalised = false) {
        root["accessors"].push_back({{"bufferView", view},
                                     {"count", count},
                                     {"type", type},
                                     {"componentType", componentType},
                                     {"normalized", normalised}});
        return root["accessors"].size() - 1;
    }
    template <typename T>
    std::size_t accessor(const std::vector<T>& values, int components, int componentType,
                         bool normalised = false) {
        static const char* types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
        return accessor(view(values), values.size() / static_cast<std::size_t>(components),
                        types[components], componentType, normalised);
    }
    std::size_t floats(const std::vector<float>& values, int components) {
        return accessor(values, components, 5126);
    }

    // The finished JSON.
    std::string json() {
        root["buffers"] = {{{"uri", "t.bin"}, {"byteLength", bytes.size()}}};
        if (fallback_ > 0)
            root["buffers"].push_back(nlohmann::json::parse(
                R"({"extensions":{"EXT_meshopt_compression":{"fallback":true}},"byteLength":)" +
                std::to_string(fallback_) + "}"));
        return root.dump();
    }

  private:
    std::size_t fallback_ = 0;
};

// A hilly sheet of 9 x 9 vertices with all attributes: large enough that encoders reorder it.
struct Sheet {
    static constexpr std::uint32_t side = 9;
    std::vector<float> positions, normals, uvs, colours;
    std::vector<std::uint32_t> indices;

    Sheet() {
        for (std::uint32_t y = 0; y < side; ++y)
            for (std::uint32_t x = 0; x < side; ++x) {
                const float u = static_cast<float>(x) / (side - 1),
                            v = static_cast<float>(y) / (side - 1);
                const float height = 0.3F * u * u + 0.2F * v * (1 - u);
                const glm::vec3 n =
                    glm::normalize(glm::vec3(-(0.6F * u - 0.2F * v), -0.2F * (1 - u), 1));
                positions.insert(positions.end(), {u, v, height});
                normals.insert(normals.end(), {n.x, n.y, n.z});
                uvs.insert(uvs.end(), {u, 1 - v});
                colours.insert(colours.end(), {u, v, 1 - u, 1});
            }
        for (std::uint32_t y = 0; y + 1 < side; ++y)
            for (std::uint32_t x = 0; x + 1 < side; ++x) {
                const std::uint32_t a = y * side + x, b = a + 1, c = a + side, d = c + 1;
                indices.insert(indices.end(), {a, b, c, c, b, d});
            }
    }
    std::size_t vertices() const { return positions.size() / 3; }
};

// The sheet as a plain file.
inline GltfBuilder plainSheet(const Sheet& sheet) {
    GltfBuilder gltf;
    auto& attributes = gltf.primitive()["attributes"];
    attributes["POSITION"] = gltf.floats(sheet.positions, 3);
    attributes["NORMAL"] = gltf.floats(sheet.normals, 3);
    attributes["TEXCOORD_0"] = gltf.floats(sheet.uvs, 2);
    attributes["COLOR_0"] = gltf.floats(sheet.colours, 4);
    gltf.primitive()["indices"] = gltf.accessor(sheet.indices, 1, 5125);
    return gltf;
}

} // namespace obscura
