// A mesh that is quantized, sparse, a strip, or packed by meshoptimizer's own encoders is the same
// triangles.
#include "renderer/scene/gltf_meshopt.h"
#include "tests/renderer/scene/packed_mesh.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <numeric>
#include <span>

namespace obscura {
namespace {

using nlohmann::json;
using testing::HasSubstr;

TEST_F(Packed, QuantizedIsTheSameMesh) {
    GltfBuilder plain = plainSheet(sheet_), gltf;
    std::vector<std::uint16_t> positions, uvs;
    std::vector<std::int8_t> normals;
    std::vector<std::uint8_t> colours;
    // Eight bytes for three shorts, four for three bytes: strides are multiples of four.
    for (std::size_t v = 0; v < sheet_.vertices(); ++v) {
        for (std::size_t c = 0; c < 3; ++c) {
            positions.push_back(
                static_cast<std::uint16_t>(std::lround(sheet_.positions[3 * v + c] * 4000)));
            normals.push_back(
                static_cast<std::int8_t>(std::lround(sheet_.normals[3 * v + c] * 127)));
        }
        positions.push_back(0);
        normals.push_back(0);
        for (std::size_t c = 0; c < 2; ++c)
            uvs.push_back(static_cast<std::uint16_t>(std::lround(sheet_.uvs[2 * v + c] * 65535)));
        for (std::size_t c = 0; c < 4; ++c)
            colours.push_back(
                static_cast<std::uint8_t>(std::lround(sheet_.colours[4 * v + c] * 255)));
    }
    auto& attributes = gltf.primitive()["attributes"];
    const std::size_t at = gltf.view(positions), up = gltf.view(normals);
    gltf.root["bufferViews"][at]["byteStride"] = 8;
    gltf.root["bufferViews"][up]["byteStride"] = 4;
    attributes["POSITION"] = gltf.accessor(at, sheet_.vertices(), "VEC3", 5123);
    attributes["NORMAL"] = gltf.accessor(up, sheet_.vertices(), "VEC3", 5120, true);
    attributes["TEXCOORD_0"] = gltf.accessor(uvs, 2, 5123, true);
    attributes["COLOR_0"] = gltf.accessor(colours, 4, 5121, true);
    gltf.primitive()["indices"] = gltf.accessor(sheet_.indices, 1, 5125);
    gltf.root["nodes"][0]["scale"] = {1.0 / 4000, 1.0 / 4000, 1.0 / 4000};
    gltf.root["extensionsRequired"] = {"KHR_mesh_quantization"};
    const Scene found = load(gltf);
    EXPECT_THAT(found.warnings, testing::IsEmpty());
    expectSame(found, load(plain), {0.0003F, 0.01F, 2e-5F, 0.004F});
}

TEST_F(Packed, SparseIsTheSameMesh) {
    GltfBuilder plain = plainSheet(sheet_), gltf = plainSheet(sheet_);
    // There is no position but the sparse ones.
    std::vector<std::uint16_t> indices;
    indices.resize(sheet_.vertices());
    std::iota(indices.begin(), indices.end(), std::uint16_t{0});
    const std::size_t which = gltf.view(indices);
    json& accessor = gltf.root["accessors"][0];
    const json right = accessor["bufferView"];
    accessor.erase("bufferView");
    accessor["sparse"] = {{"count", indices.size()},
                          {"indices", {{"bufferView", which}, {"componentType", 5123}}},
                          {"values", {{"bufferView", right}}}};
    expectSame(load(gltf), load(plain), exact);
}

TEST_F(Packed, AStripIsTheSameTriangles) {
    GltfBuilder plain = plainSheet(sheet_), gltf = plainSheet(sheet_);
    std::vector<std::uint32_t> strip(meshopt_stripifyBound(sheet_.indices.size()));
    strip.resize(meshopt_stripify(strip.data(), sheet_.indices.data(), sheet_.indices.size(),
                                  sheet_.vertices(), 0));
    gltf.primitive()["indices"] = gltf.accessor(strip, 1, 5125);
    gltf.primitive()["mode"] = 5;
    expectSame(load(gltf), load(plain), exact);
}

std::vector<unsigned char> packVertices(const void* values, std::size_t count, std::size_t stride) {
    std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(count, stride));
    packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), values, count, stride));
    return packed;
}

std::vector<unsigned char> packIndices(const Sheet& sheet, bool sequence) {
    const std::size_t count = sheet.indices.size();
    std::vector<unsigned char> packed(
        std::max(meshopt_encodeIndexBufferBound(count, sheet.vertices()),
                 meshopt_encodeIndexSequenceBound(count, sheet.vertices())));
    packed.resize(
        sequence
            ? meshopt_encodeIndexSequence(packed.data(), packed.size(), sheet.indices.data(), count)
            : meshopt_encodeIndexBuffer(packed.data(), packed.size(), sheet.indices.data(), count));
    return packed;
}

std::vector<float> padded(const std::vector<float>& threes) {
    std::vector<float> fours;
    for (std::size_t i = 0; i < threes.size(); ++i) {
        fours.push_back(threes[i]);
        if (i % 3 == 2)
            fours.push_back(0);
    }
    return fours;
}

// With the exponential filter for positions, the octahedral one for normals of `normalBytes` each.
GltfBuilder meshoptSheet(const Sheet& sheet, bool sequence, int normalBytes) {
    GltfBuilder gltf;
    const std::size_t count = sheet.vertices();
    auto& attributes = gltf.primitive()["attributes"];
    std::vector<std::uint32_t> positions(3 * count);
    meshopt_encodeFilterExp(positions.data(), count, 12, 20, sheet.positions.data());
    attributes["POSITION"] =
        gltf.accessor(gltf.packedView(packVertices(positions.data(), count, 12), count, 12,
                                      "ATTRIBUTES", "EXPONENTIAL"),
                      count, "VEC3", 5126);
    const std::size_t stride = 4 * static_cast<std::size_t>(normalBytes);
    std::vector<std::uint8_t> normals(stride * count);
    meshopt_encodeFilterOct(normals.data(), count, stride, 8 * normalBytes,
                            padded(sheet.normals).data());
    attributes["NORMAL"] =
        gltf.accessor(gltf.packedView(packVertices(normals.data(), count, stride), count, stride,
                                      "ATTRIBUTES", "OCTAHEDRAL"),
                      count, "VEC3", normalBytes == 1 ? 5120 : 5122, true);
    attributes["TEXCOORD_0"] = gltf.accessor(
        gltf.packedView(packVertices(sheet.uvs.data(), count, 8), count, 8, "ATTRIBUTES"), count,
        "VEC2", 5126);
    attributes["COLOR_0"] = gltf.accessor(
        gltf.packedView(packVertices(sheet.colours.data(), count, 16), count, 16, "ATTRIBUTES"),
        count, "VEC4", 5126);
    const std::size_t corners = sheet.indices.size();
    gltf.primitive()["indices"] =
        gltf.accessor(gltf.packedView(packIndices(sheet, sequence), corners, 2,
                                      sequence ? "INDICES" : "TRIANGLES"),
                      corners, "SCALAR", 5123);
    gltf.root["extensionsRequired"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
    return gltf;
}

TEST_F(Packed, MeshoptIsTheSameMesh) {
    GltfBuilder plain = plainSheet(sheet_);
    const Scene expected = load(plain);
    for (const bool sequence : {false, true})
        for (const int normalBytes : {1, 2}) {
            GltfBuilder gltf = meshoptSheet(sheet_, sequence, normalBytes);
            const Scene found = load(gltf);
            EXPECT_THAT(found.warnings, testing::IsEmpty());
            expectSame(found, expected, {2e-6F, normalBytes == 1 ? 0.02F : 1e-4F, 0, 0});
        }
}

// The third filter serves rotations, of which none is shown.
TEST_F(Packed, MeshoptsQuaternionFilterGivesRotations) {
    const std::vector<float> rotations{0, 0, 0, 1, 0.5F, 0.5F, -0.5F, 0.5F, 0.6F, 0, 0.8F, 0};
    std::vector<std::int16_t> filtered(12);
    meshopt_encodeFilterQuat(filtered.data(), 3, 8, 16, rotations.data());
    const std::vector<unsigned char> packed = packVertices(filtered.data(), 3, 8);
    const auto bytes = decodeMeshopt(
        json{{"count", 3}, {"byteStride", 8}, {"mode", "ATTRIBUTES"}, {"filter", "QUATERNION"}},
        std::as_bytes(std::span(packed)));
    ASSERT_TRUE(bytes && bytes->size() == 24);
    std::vector<std::int16_t> found(12);
    std::memcpy(found.data(), bytes->data(), 24);
    for (std::size_t q = 0; q < 3; ++q) {
        double product = 0; // q and -q are one rotation
        for (std::size_t c = 0; c < 4; ++c)
            product += static_cast<double>(rotations[4 * q + c]) * found[4 * q + c] / 32767;
        EXPECT_NEAR(std::abs(product), 1, 1e-4);
    }
}

TEST_F(Packed, AMeshoptViewThatLiesIsAnError) {
    struct Lie {
        std::size_t view;
        const char* key;
        json value;
        const char* error;
    };
    const Lie lies[] = {
        {0, "count", 80, ".count: expected the 972 bytes of its buffer view, found 80 elements of"},
        {0, "count", 100'000'000, ".count: expected at most the"},
        {0, "byteStride", 10, ".byteStride: expected a multiple of 4"},
        {1, "byteStride", 12, ".byteStride: expected 4 or 8 of an octahedral filter, found 12"},
        {0, "byteLength", 100'000, ": expected a view within the"},
        {0, "mode", "POINTS", ".mode: expected one of ATTRIBUTES, TRIANGLES, INDICES"},
        {0, "buffer", 1, ".buffer: expected a buffer with bytes, found buffers[1]"}};
    for (const Lie& lie : lies) {
        GltfBuilder gltf = meshoptSheet(sheet_, false, 1);
        gltf.root["bufferViews"][lie.view]["extensions"]["EXT_meshopt_compression"][lie.key] =
            lie.value;
        EXPECT_THAT(
            errorOf(gltf),
            HasSubstr(fmt::format("t.gltf: bufferViews[{}].extensions.EXT_meshopt_compression{}",
                                  lie.view, lie.error)));
    }
}

TEST_F(Packed, AMeshoptStreamOfAnotherKindOrNoneIsAnError) {
    GltfBuilder gltf = meshoptSheet(sheet_, true, 1);
    gltf.root["bufferViews"][4]["extensions"]["EXT_meshopt_compression"]["mode"] = "TRIANGLES";
    EXPECT_THAT(errorOf(gltf), HasSubstr("bufferViews[4].extensions.EXT_meshopt_compression: "
                                         "expected a stream of TRIANGLES"));
    gltf = meshoptSheet(sheet_, false, 1);
    gltf.root["bufferViews"][0].erase("extensions");
    EXPECT_THAT(errorOf(gltf), HasSubstr("bufferViews[0].buffer: expected a buffer with bytes"));
}

TEST_F(Packed, EveryLieInAnExtensionIsAnErrorOrHarmless) {
    GltfBuilder gltf = meshoptSheet(sheet_, false, 1);
    gltf.root.update(json::parse(
        R"({"cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":1}}],"nodes":[{"mesh":0,)"
        R"("camera":0,"extensions":{"KHR_lights_punctual":{"light":0}}}],"extensions":{)"
        R"("KHR_lights_punctual":{"lights":[{"type":"spot","color":[1,1,1],"intensity":2,"range":3,)"
        R"("spot":{"innerConeAngle":0.1,"outerConeAngle":0.2}}]}}})"));
    expectHarmlessLies(gltf);
}

} // namespace
} // namespace obscura
