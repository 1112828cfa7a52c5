#include "renderer/scene/gltf_meshopt.h"

#include <meshoptimizer.h>
#include <nlohmann/json.hpp>

namespace obscura {

std::optional<std::string> decodeMeshopt(const nlohmann::json& packed,
                                         std::span<const std::byte> bytes) {
    const auto count = static_cast<std::size_t>(packed.at("count").get<double>()),
               stride = static_cast<std::size_t>(packed.at("byteStride").get<double>());
    const auto mode = packed.at("mode").get<std::string>(), filter = packed.value("filter", "NONE");
    std::string result(count * stride, '\0');
    const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
    const int fault =
        mode == "ATTRIBUTES"
            ? meshopt_decodeVertexBuffer(result.data(), count, stride, data, bytes.size())
        : mode == "TRIANGLES"
            ? meshopt_decodeIndexBuffer(result.data(), count, stride, data, bytes.size())
            : meshopt_decodeIndexSequence(result.data(), count, stride, data, bytes.size());
    if (fault != 0)
        return std::nullopt;
    if (filter == "OCTAHEDRAL")
        meshopt_decodeFilterOct(result.data(), count, stride);
    if (filter == "QUATERNION")
        meshopt_decodeFilterQuat(result.data(), count, stride);
    if (filter == "EXPONENTIAL")
        meshopt_decodeFilterExp(result.data(), count, stride);
    return result;
}

} // namespace obscura
