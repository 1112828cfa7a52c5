#pragma once

#include "base/error.h"
#include "renderer/scene/scene.h"
#include "tests/error_of.h"
#include "tests/folder.h"
#include "tests/renderer/scene/packed_gltf.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>

namespace obscura {

// Every value of an extension, of cameras and of nodes in turn becomes each of these.
inline void visit(nlohmann::json& value, bool inside,
                  const std::function<void(nlohmann::json&)>& change) {
    if (inside)
        change(value);
    if (value.is_structured())
        for (const auto& [key, item] : value.items())
            visit(item, inside || key == "extensions" || key == "cameras" || key == "nodes",
                  change);
}

// The file with each such value changed to each of these.
inline void forEachLie(const nlohmann::json& original,
                       const std::function<void(const nlohmann::json&)>& use) {
    const nlohmann::json lies = nlohmann::json::parse(
        R"([-1, 0, 2, 255, 2147483647, 4294967295, 0.5, 1e300, null, "x", [], {}])");
    nlohmann::json walked = original;
    std::size_t places = 0;
    visit(walked, false, [&](nlohmann::json&) { ++places; });
    for (std::size_t target = 0; target < places; ++target)
        for (const nlohmann::json& lie : lies) {
            nlohmann::json root = original;
            std::size_t at = 0;
            nlohmann::json* found = nullptr;
            visit(root, false,
                  [&](nlohmann::json& value) { found = at++ == target ? &value : found; });
            *found = lie;
            use(root);
        }
}

// A sheet in a file of its own.
class Packed : public testing::Test {
  protected:
    // Without waiting for the disk, as writeFile() does.
    void put(const std::string& name, const std::string& content) {
        std::ofstream(folder_ / name, std::ios::binary) << content;
    }
    Scene load(GltfBuilder& gltf) {
        put("t.gltf", gltf.json());
        put("t.bin", gltf.bytes);
        return loadScene(folder_ / "t.gltf");
    }
    std::string errorOf(GltfBuilder& gltf) {
        return test::errorOf([&] { load(gltf); });
    }

    // Whatever of its extensions lies, what comes is an Error or a scene.
    void expectHarmlessLies(GltfBuilder& gltf) {
        const nlohmann::json original = nlohmann::json::parse(gltf.json());
        put("t.bin", gltf.bytes);
        std::size_t errors = 0, scenes = 0;
        forEachLie(original, [&](const nlohmann::json& root) {
            put("t.gltf", root.dump());
            try {
                loadScene(folder_ / "t.gltf");
                ++scenes;
            } catch (const Error& error) {
                ++errors;
                EXPECT_THAT(error.what(), testing::HasSubstr("t.gltf")) << root.dump();
            } // all else fails the test
        });
        EXPECT_GT(errors, scenes);
        EXPECT_GT(scenes, 10U);
    }

    test::Folder folder_;
    Sheet sheet_;
};

using Corner = std::array<Vertex, 3>;

inline bool before(const Vertex& a, const Vertex& b) {
    const auto key = [](const Vertex& v) {
        return std::array{std::round(v.uv.x * 1000), std::round(v.uv.y * 1000)};
    };
    return key(a) < key(b);
}

// All triangles with an area, each turned so that its first corner is the least, in order: by
// texture coordinates, which no vertex of the sheet shares with another.
inline std::vector<Corner> trianglesOf(const Scene& scene) {
    std::vector<Corner> result;
    for (std::size_t i = 0; i < scene.indices.size(); i += 3) {
        Corner t{scene.vertices[scene.indices[i]], scene.vertices[scene.indices[i + 1]],
                 scene.vertices[scene.indices[i + 2]]};
        std::rotate(t.begin(), std::min_element(t.begin(), t.end(), before), t.end());
        if (glm::length(glm::cross(t[1].position - t[0].position, t[2].position - t[0].position)) >
            1e-6F)
            result.push_back(t);
    }
    std::sort(result.begin(), result.end(), [](const Corner& a, const Corner& b) {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), before);
    });
    return result;
}

// Every corner of every triangle has what the plain one's has, within these.
struct Within {
    float position = 0, normal = 0, uv = 0, colour = 0;
};
inline bool same(const Vertex& a, const Vertex& b, const Within& within) {
    return glm::distance(a.position, b.position) <= within.position &&
           glm::distance(a.normal, b.normal) <= within.normal &&
           glm::distance(a.uv, b.uv) <= within.uv &&
           glm::distance(a.colour, b.colour) <= within.colour;
}
inline void expectSame(const Scene& found, const Scene& plain, const Within& within) {
    const std::vector<Corner> a = trianglesOf(found), b = trianglesOf(plain);
    EXPECT_EQ(b.size(), 128U);
    EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end(),
                           [&](const Corner& x, const Corner& y) {
                               return std::equal(x.begin(), x.end(), y.begin(),
                                                 [&](const Vertex& v, const Vertex& w) {
                                                     return same(v, w, within);
                                                 });
                           }))
        << "of " << a.size() << " triangles";
}
constexpr Within exact{1e-7F, 2e-7F, 0, 0}; // normals are made unit again

} // namespace obscura
