#include "renderer/scene/gltf_draco.h"

#include <draco/compression/decode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>

namespace obscura {

using fmt::format;

namespace {

// No mesh is packed tighter: the best of Draco's codes spends a bit on some tens of triangles of a
// regular grid.
constexpr std::size_t mostFacesPerByte = 1000;

draco::DecoderBuffer bufferOf(std::span<const std::byte> bytes) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return buffer;
}

// What is wrong with the head of the stream (Draco bitstream 2.2, as the glTF extension demands),
// "" if nothing.
std::string faultOf(std::span<const std::byte> bytes, std::size_t mostFaces) {
    draco::DecoderBuffer buffer = bufferOf(bytes);
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok())
        return "expected a Draco stream, found none";
    if (header.version_major != 2 || header.version_minor != 2)
        return format("expected Draco's bitstream 2.2, found {}.{}", header.version_major,
                      header.version_minor);
    if (header.encoder_type != draco::TRIANGULAR_MESH)
        return "expected a Draco stream of triangles, found one of points";
    if (header.flags & METADATA_FLAG_MASK)
        return "expected a Draco stream without metadata, found some: export without";
    std::uint32_t faces = 0, vertices = 0, symbols = 0, splits = 0;
    std::uint8_t byte = 0; // traversal's kind, number of attribute decoders
    const bool read =
        header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING
            ? draco::DecodeVarint(&faces, &buffer) && draco::DecodeVarint(&vertices, &buffer)
            : buffer.Decode(&byte) && draco::DecodeVarint(&vertices, &buffer) &&
                  draco::DecodeVarint(&faces, &buffer) && buffer.Decode(&byte) &&
                  draco::DecodeVarint(&symbols, &buffer) && draco::DecodeVarint(&splits, &buffer);
    if (!read)
        return "expected a Draco stream, found one that is cut short";
    mostFaces = std::min(mostFaces, bytes.size() * mostFacesPerByte);
    if (faces > mostFaces || vertices / 3 > faces || symbols > faces || splits > symbols)
        return format("expected a Draco stream of {} bytes with at most {} triangles, found one "
                      "that claims {} of {} vertices",
                      bytes.size(), mostFaces, faces, vertices);
    return "";
}

// Whole numbers come as they are stored, unless the stream itself calls them shares.
std::string read(const draco::Mesh& mesh, const DracoAttribute& wanted,
                 std::vector<float>& values) {
    const draco::PointAttribute* from = mesh.GetAttributeByUniqueId(wanted.id);
    if (!from)
        return format("expected attribute {} in the Draco stream, found none", wanted.id);
    const bool whole =
        from->data_type() != draco::DT_FLOAT32 && from->data_type() != draco::DT_FLOAT64;
    const float most = whole && !from->normalized() ? wanted.most : 1;
    const auto components = static_cast<std::size_t>(wanted.components);
    values.resize(mesh.num_points() * components);
    for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
        const draco::AttributeValueIndex value = from->mapped_index(draco::PointIndex(i));
        float* at = &values[i * components];
        if (value.value() >= from->size() ||
            !from->ConvertValue(value, static_cast<std::int8_t>(wanted.components), at))
            return format("expected a value of attribute {} for vertex {}, found none", wanted.id,
                          i);
        if (most != 1)
            std::transform(at, at + components, at,
                           [&](float number) { return std::max(number / most, -1.0f); });
    }
    return "";
}

} // namespace

std::variant<DracoMesh, std::string>
decodeDraco(std::span<const std::byte> bytes,
            const std::map<std::string, DracoAttribute>& attributes, std::size_t mostCorners) {
    if (std::string fault = faultOf(bytes, mostCorners / 3); !fault.empty())
        return fault;
    try {
        draco::DecoderBuffer buffer = bufferOf(bytes);
        auto decoded = draco::Decoder().DecodeMeshFromBuffer(&buffer);
        if (!decoded.ok())
            return format("expected a Draco stream, found one that cannot be decoded ({})",
                          decoded.status().error_msg_string());
        const draco::Mesh& mesh = *decoded.value();
        if (mesh.num_points() == 0)
            return "expected a Draco stream of vertices, found none";
        DracoMesh result;
        result.vertices = mesh.num_points();
        for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f)
            for (const draco::PointIndex& point : mesh.face(f)) {
                if (point.value() >= mesh.num_points())
                    return format("expected corners below {}, found {}", mesh.num_points(),
                                  point.value());
                result.corners.push_back(point.value());
            }
        for (const auto& [name, wanted] : attributes)
            if (std::string fault = read(mesh, wanted, result.attributes[name]); !fault.empty())
                return fault;
        return result;
    } catch (const std::bad_alloc&) {
        return "expected a Draco stream that fits into memory, found a larger one";
    }
}

} // namespace obscura
