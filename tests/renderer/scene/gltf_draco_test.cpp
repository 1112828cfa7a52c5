// A mesh that Draco's own encoder packs is the same triangles, and a stream that lies an error.
#include "tests/renderer/scene/packed_mesh.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>

namespace obscura {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using Draco = Packed;

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

TEST_F(Draco, DracoIsTheSameMesh) {
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
TEST_F(Draco, BytesInADracoStreamAreShares) {
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

TEST_F(Draco, ADracoStreamThatLiesIsAnError) {
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
TEST_F(Draco, ADamagedDracoStreamIsAnErrorOrAScene) {
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

TEST_F(Draco, EveryLieInTheExtensionIsAnErrorOrHarmless) {
    GltfBuilder gltf = dracoSheet(sheet_, dracoOf(sheet_, draco::MESH_EDGEBREAKER_ENCODING, 8));
    expectHarmlessLies(gltf);
}

} // namespace
} // namespace obscura
