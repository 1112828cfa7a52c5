// One mesh, packed in every way that glTF files pack it, is the same triangles: by the encoders of
// Draco and meshoptimizer themselves.
#include "base/error.h"
#include "renderer/scene/gltf_meshopt.h"
#include "renderer/scene/scene.h"
#include "tests/error_of.h"
#include "tests/folder.h"
#include "tests/renderer/scene/packed_gltf.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <span>

namespace obscura {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

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

    test::Folder folder_;
    Sheet sheet_;
};

using Corner = std::array<Vertex, 3>;

bool before(const Vertex& a, const Vertex& b) {
    const auto key = [](const Vertex& v) {
        return std::array{std::round(v.uv.x * 1000), std::round(v.uv.y * 1000)};
    };
    return key(a) < key(b);
}

// All triangles with an area, each turned so that its first corner is the least, in order: by
// texture coordinates, which no vertex of the sheet shares with another.
std::vector<Corner> trianglesOf(const Scene& scene) {
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
void expectSame(const Scene& found, const Scene& plain, Within within) {
    const std::vector<Corner> a = trianglesOf(found), b = trianglesOf(plain);
    ASSERT_EQ(a.size(), 128U);
    ASSERT_EQ(b.size(), 128U);
    for (std::size_t t = 0; t < a.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const Vertex &x = a[t][k], &y = b[t][k];
            ASSERT_LE(glm::distance(x.position, y.position), within.position) << t;
            ASSERT_LE(glm::distance(x.normal, y.normal), within.normal) << t;
            ASSERT_LE(glm::distance(x.uv, y.uv), within.uv) << t;
            ASSERT_LE(glm::distance(x.colour, y.colour), within.colour) << t;
        }
}
constexpr Within exact{1e-7F, 2e-7F, 0, 0}; // normals are made unit again

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
    for (std::uint16_t i = 0; i < sheet_.vertices(); ++i)
        indices.push_back(i);
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

// As its own encoder packs the sheet; without quantization it loses nothing.
std::vector<char> dracoOf(const Sheet& sheet, int method, int positionBits) {
    draco::TriangleSoupMeshBuilder builder;
    const std::size_t faces = sheet.indices.size() / 3;
    builder.Start(static_cast<int>(faces));
    using draco::GeometryAttribute;
    const std::array<std::pair<GeometryAttribute::Type, const std::vector<float>*>, 4> from{
        {{GeometryAttribute::POSITION, &sheet.positions},
         {GeometryAttribute::NORMAL, &sheet.normals},
         {GeometryAttribute::TEX_COORD, &sheet.uvs},
         {GeometryAttribute::COLOR, &sheet.colours}}};
    for (const auto& [type, values] : from) {
        const std::size_t size = values->size() / sheet.vertices();
        const int id =
            builder.AddAttribute(type, static_cast<std::int8_t>(size), draco::DT_FLOAT32);
        for (std::size_t f = 0; f < faces; ++f) {
            const auto at = [&, &all = *values](std::size_t k) {
                return &all[size * sheet.indices[3 * f + k]];
            };
            builder.SetAttributeValuesForFace(id, draco::FaceIndex(static_cast<std::uint32_t>(f)),
                                              at(0), at(1), at(2));
        }
    }
    const auto mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetEncodingMethod(method);
    if (positionBits > 0)
        encoder.SetAttributeQuantization(GeometryAttribute::POSITION, positionBits);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    return {buffer.data(), buffer.data() + buffer.size()};
}

GltfBuilder dracoSheet(const Sheet& sheet, const std::vector<char>& stream) {
    GltfBuilder gltf;
    const std::size_t view = gltf.view(stream);
    const auto declare = [&](const char* type, std::size_t count, int componentType) {
        gltf.root["accessors"].push_back(
            {{"count", count}, {"type", type}, {"componentType", componentType}});
        return gltf.root["accessors"].size() - 1;
    };
    auto& attributes = gltf.primitive()["attributes"];
    attributes["POSITION"] = declare("VEC3", sheet.vertices(), 5126);
    attributes["NORMAL"] = declare("VEC3", sheet.vertices(), 5126);
    attributes["TEXCOORD_0"] = declare("VEC2", sheet.vertices(), 5126);
    attributes["COLOR_0"] = declare("VEC4", sheet.vertices(), 5126);
    gltf.primitive()["indices"] = declare("SCALAR", sheet.indices.size(), 5125);
    gltf.primitive()["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", view},
        {"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}, {"COLOR_0", 3}}}};
    gltf.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return gltf;
}

TEST_F(Packed, DracoIsTheSameMesh) {
    GltfBuilder plain = plainSheet(sheet_);
    const Scene expected = load(plain);
    for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        SCOPED_TRACE(method);
        GltfBuilder gltf = dracoSheet(sheet_, dracoOf(sheet_, method, 0));
        const Scene found = load(gltf);
        EXPECT_THAT(found.warnings, testing::IsEmpty());
        expectSame(found, expected, exact);
        gltf = dracoSheet(sheet_, dracoOf(sheet_, method, 12));
        expectSame(load(gltf), expected, {1.0F / 4096, 2e-7F, 0, 0});
    }
}

// Whole numbers lie in the stream as in a plain file, and the accessor says what they mean.
TEST_F(Packed, BytesInADracoStreamAreShares) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(1);
    const float corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::uint8_t colours[3][4] = {{255, 0, 51, 255}, {102, 0, 0, 255}, {0, 0, 0, 0}};
    const int at = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32),
              as = builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8);
    builder.SetAttributeValuesForFace(at, draco::FaceIndex(0), corners[0], corners[1], corners[2]);
    builder.SetAttributeValuesForFace(as, draco::FaceIndex(0), colours[0], colours[1], colours[2]);
    draco::EncoderBuffer buffer;
    ASSERT_TRUE(draco::Encoder().EncodeMeshToBuffer(*builder.Finalize(), &buffer).ok());
    GltfBuilder gltf = dracoSheet(sheet_, {buffer.data(), buffer.data() + buffer.size()});
    gltf.primitive()["attributes"] = {{"POSITION", 0}, {"COLOR_0", 3}};
    gltf.primitive()["extensions"]["KHR_draco_mesh_compression"]["attributes"] = {{"POSITION", 0},
                                                                                  {"COLOR_0", 1}};
    gltf.root["accessors"][3].update(json{{"componentType", 5121}, {"normalized", true}});
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.vertices.size(), 3U);
    for (const Vertex& vertex : scene.vertices) {
        const glm::vec4 expected = vertex.position.x > 0   ? glm::vec4(0.4, 0, 0, 1)
                                   : vertex.position.y > 0 ? glm::vec4(0)
                                                           : glm::vec4(1, 0, 0.2, 1);
        EXPECT_LT(glm::distance(vertex.colour, expected), 1e-6F);
    }
}

TEST_F(Packed, ADracoStreamThatLiesIsAnError) {
    const std::vector<char> stream = dracoOf(sheet_, draco::MESH_SEQUENTIAL_ENCODING, 0);
    // Header of 11 bytes, then the number of triangles as a varint: 128 is 0x80 0x01.
    ASSERT_EQ(static_cast<unsigned char>(stream[11]), 0x80);
    std::vector<char> lie = stream;
    lie.erase(lie.begin() + 11, lie.begin() + 13);
    const auto billion = {'\xff', '\xff', '\xff', '\xff', '\x03'};
    lie.insert(lie.begin() + 11, billion.begin(), billion.end());
    GltfBuilder gltf = dracoSheet(sheet_, lie);
    const std::string where = "meshes[0].primitives[0].extensions.KHR_draco_mesh_compression: ";
    EXPECT_THAT(errorOf(gltf),
                AllOf(HasSubstr("t.gltf: " + where + "expected a Draco stream of"),
                      HasSubstr("at most 128 triangles"), HasSubstr("claims 1073741823")));
    gltf = dracoSheet(sheet_, stream);
    gltf.root["accessors"][4]["count"] = 30; // of indices: fewer than the stream has
    EXPECT_THAT(errorOf(gltf), HasSubstr("at most 10 triangles, found one that claims 128"));
    gltf = dracoSheet(sheet_, {stream.begin(), stream.begin() + 200});
    EXPECT_THAT(errorOf(gltf), HasSubstr(where + "expected a Draco stream, found one that cannot"));
    gltf = dracoSheet(sheet_, {'n', 'o', 'n', 'e'});
    EXPECT_THAT(errorOf(gltf), HasSubstr(where + "expected a Draco stream, found none"));
    gltf = dracoSheet(sheet_, stream);
    auto& ids = gltf.primitive()["extensions"]["KHR_draco_mesh_compression"]["attributes"];
    ids["NORMAL"] = 7;
    EXPECT_THAT(errorOf(gltf), HasSubstr("expected attribute 7 in the Draco stream, found none"));
    ids["TANGENT"] = 1;
    EXPECT_THAT(errorOf(gltf), HasSubstr("attributes.TANGENT: expected an attribute of the "
                                         "primitive, found one that it lacks"));
}

// Any byte of the stream may be any other: what comes is an Error or a scene.
TEST_F(Packed, ADamagedDracoStreamIsAnErrorOrAScene) {
    for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        const std::vector<char> stream = dracoOf(sheet_, method, 12);
        std::size_t errors = 0;
        for (std::size_t at = 0; at < stream.size(); at += at < 40 ? 1 : 29) {
            std::vector<char> damaged = stream;
            damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
            GltfBuilder gltf = dracoSheet(sheet_, damaged);
            try {
                load(gltf);
            } catch (const Error&) {
                ++errors;
            }
        }
        EXPECT_GT(errors, 10U);
    }
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
    const auto stride = static_cast<std::size_t>(4 * normalBytes);
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
    const auto errorWith = [&](std::size_t view, const std::function<void(json&)>& change) {
        GltfBuilder gltf = meshoptSheet(sheet_, false, 1);
        change(gltf.root["bufferViews"][view]["extensions"]["EXT_meshopt_compression"]);
        return errorOf(gltf);
    };
    const auto at = [](std::size_t view) {
        return fmt::format("t.gltf: bufferViews[{}].extensions.EXT_meshopt_compression", view);
    };
    EXPECT_THAT(errorWith(0, [](json& o) { o["count"] = 80; }),
                HasSubstr(at(0) + ".count: expected the 972 bytes of its buffer view, found 80 "
                                  "elements of 12 bytes"));
    EXPECT_THAT(
        errorWith(0, [](json& o) { o["count"] = 100'000'000; }),
        AllOf(HasSubstr(at(0) + ".count: expected at most the"), HasSubstr("found 100000000")));
    EXPECT_THAT(errorWith(0, [](json& o) { o["byteStride"] = 10; }),
                HasSubstr(at(0) + ".byteStride: expected a multiple of 4"));
    EXPECT_THAT(
        errorWith(1, [](json& o) { o["byteStride"] = 12; }),
        HasSubstr(at(1) + ".byteStride: expected 4 or 8 of an octahedral filter, found 12"));
    EXPECT_THAT(errorWith(0, [](json& o) { o["byteLength"] = 100'000; }),
                HasSubstr(at(0) + ": expected a view within the"));
    EXPECT_THAT(errorWith(0, [](json& o) { o["mode"] = "POINTS"; }),
                HasSubstr(at(0) + ".mode: expected one of ATTRIBUTES, TRIANGLES, INDICES"));
    EXPECT_THAT(errorWith(0, [](json& o) { o["buffer"] = 1; }), // the one that is not there
                HasSubstr(at(0) + ".buffer: expected a buffer with bytes, found buffers[1]"));
    GltfBuilder gltf = meshoptSheet(sheet_, true, 1); // another codec's stream
    gltf.root["bufferViews"][4]["extensions"]["EXT_meshopt_compression"]["mode"] = "TRIANGLES";
    EXPECT_THAT(errorOf(gltf), HasSubstr(at(4) + ": expected a stream of TRIANGLES"));
    gltf = meshoptSheet(sheet_, false, 1);
    gltf.root["bufferViews"][0].erase("extensions");
    EXPECT_THAT(errorOf(gltf), HasSubstr("bufferViews[0].buffer: expected a buffer with bytes"));
}

// Every value of an extension, of cameras and of nodes in turn becomes each of these.
void visit(json& value, bool inside, const std::function<void(json&)>& change) {
    if (inside)
        change(value);
    if (value.is_structured())
        for (const auto& [key, item] : value.items())
            visit(item, inside || key == "extensions" || key == "cameras" || key == "nodes",
                  change);
}

TEST_F(Packed, EveryLieInAnExtensionIsAnErrorOrHarmless) {
    const json lies =
        json::parse(R"([-1, 0, 2, 255, 2147483647, 4294967295, 0.5, 1e300, null, "x", [], {}])");
    GltfBuilder files[] = {dracoSheet(sheet_, dracoOf(sheet_, draco::MESH_EDGEBREAKER_ENCODING, 8)),
                           meshoptSheet(sheet_, false, 1)};
    files[1].root.update(json::parse(
        R"({"cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":1}}],"nodes":[{"mesh":0,)"
        R"("camera":0,"extensions":{"KHR_lights_punctual":{"light":0}}}],"extensions":{)"
        R"("KHR_lights_punctual":{"lights":[{"type":"spot","color":[1,1,1],"intensity":2,"range":3,)"
        R"("spot":{"innerConeAngle":0.1,"outerConeAngle":0.2}}]}}})"));
    std::size_t errors = 0, scenes = 0;
    for (GltfBuilder& file : files) {
        const json original = json::parse(file.json());
        put("t.bin", file.bytes);
        json walked = original;
        std::size_t places = 0;
        visit(walked, false, [&](json&) { ++places; });
        for (std::size_t target = 0; target < places; ++target)
            for (const json& lie : lies) {
                json root = original;
                std::size_t at = 0;
                json* found = nullptr;
                visit(root, false, [&](json& value) {
                    if (at++ == target)
                        found = &value;
                });
                *found = lie;
                put("t.gltf", root.dump());
                try {
                    loadScene(folder_ / "t.gltf");
                    ++scenes;
                } catch (const Error& error) {
                    ++errors;
                    EXPECT_THAT(error.what(), HasSubstr("t.gltf")) << root.dump();
                } catch (const std::exception& error) {
                    ADD_FAILURE() << error.what() << " of " << root.dump();
                }
            }
    }
    EXPECT_GT(errors, scenes);
    EXPECT_GT(scenes, 20U);
}

} // namespace
} // namespace obscura
