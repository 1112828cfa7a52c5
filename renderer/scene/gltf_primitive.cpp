#include "renderer/scene/gltf_primitive.h"

#include "renderer/scene/gltf_check.h"

#include <fmt/format.h>

#include <limits>

namespace obscura {

using fmt::format;

namespace {

// What glTF 2.0, section 3.7.2.1, and KHR_mesh_quantization allow; a morph target's tangent has no
// sign.
std::pair<int, int> componentsOf(const std::string& name, bool target) {
    if (name.starts_with("TEXCOORD"))
        return {2, 2};
    if (name.starts_with("COLOR"))
        return {3, 4};
    if (name == "POSITION" || name == "NORMAL" || target)
        return {3, 3};
    return {4, 4};
}

// What a normalised whole number of the type is divided by.
float mostOf(int componentType) {
    switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return std::numeric_limits<std::int8_t>::max();
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return std::numeric_limits<std::uint8_t>::max();
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return std::numeric_limits<std::int16_t>::max();
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return std::numeric_limits<std::uint16_t>::max();
    default:
        return 1;
    }
}

} // namespace

GltfPrimitive::GltfPrimitive(const GltfFile& file, const tinygltf::Model& model, int mesh,
                             std::size_t index, std::size_t mostCorners)
    : file_(&file), model_(&model),
      from_(&model.meshes[static_cast<std::size_t>(mesh)].primitives[index]),
      at_(format("meshes[{}].primitives[{}]", mesh, index)) {
    if (!isTriangles())
        return;
    if (!has("POSITION"))
        failGltf(file.path(), at_ + ".attributes", "expected POSITION, found none");
    vertices_ = model.accessors[static_cast<std::size_t>(from_->attributes.at("POSITION"))].count;
    unpack(file.root().at("meshes")[static_cast<std::size_t>(mesh)].at("primitives")[index],
           mostCorners);
}

bool GltfPrimitive::isTriangles() const {
    return from_->mode < 0 || from_->mode >= TINYGLTF_MODE_TRIANGLES;
}

void GltfPrimitive::unpack(const nlohmann::json& primitive, std::size_t mostCorners) {
    if (!primitive.contains("extensions") ||
        !primitive.at("extensions").contains("KHR_draco_mesh_compression"))
        return;
    const nlohmann::json& packed = primitive.at("extensions").at("KHR_draco_mesh_compression");
    const std::string where = at_ + ".extensions.KHR_draco_mesh_compression";
    std::map<std::string, DracoAttribute> wanted;
    for (const auto& [name, id] : packed.at("attributes").items()) {
        const auto& accessor =
            model_->accessors[static_cast<std::size_t>(from_->attributes.at(name))];
        const bool share = accessor.normalized || name.starts_with("COLOR");
        wanted[name] = {static_cast<std::uint32_t>(id.get<double>()),
                        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)),
                        share ? mostOf(accessor.componentType) : 1.0f};
    }
    if (from_->indices >= 0)
        mostCorners = std::min(mostCorners,
                               model_->accessors[static_cast<std::size_t>(from_->indices)].count);
    auto result =
        decodeDraco(file_->view(packed.at("bufferView").get<std::size_t>()), wanted, mostCorners);
    if (const auto* fault = std::get_if<std::string>(&result))
        failGltf(file_->path(), where, *fault);
    draco_ = std::make_shared<const DracoMesh>(std::move(std::get<DracoMesh>(result)));
    vertices_ = draco_->vertices;
}

GltfAccessor GltfPrimitive::checked(GltfAccessor accessor, int index, const std::string& name,
                                    const std::string& at) const {
    const auto [least, most] = componentsOf(name, at.find(".targets[") != std::string::npos);
    const bool whole = accessor.componentType() == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (accessor.components() < least || accessor.components() > most || whole)
        failGltf(
            file_->path(), at,
            format("expected an accessor of {} floats, bytes or shorts each, found accessors[{}] "
                   "with {}{}",
                   least == most ? format("{}", least) : format("{} or {}", least, most), index,
                   accessor.components(), whole ? " of 32 bits" : ""));
    if (accessor.count() != vertices_)
        failGltf(
            file_->path(), at,
            format("expected the {} elements of POSITION, found {}", vertices_, accessor.count()));
    return accessor;
}

std::optional<GltfAccessor> GltfPrimitive::attribute(const std::string& name) const {
    const auto found = from_->attributes.find(name);
    if (found == from_->attributes.end())
        return std::nullopt;
    const std::string at = at_ + ".attributes." + name;
    if (draco_)
        if (const auto packed = draco_->attributes.find(name); packed != draco_->attributes.end())
            return checked(
                GltfAccessor(packed->second, static_cast<int>(packed->second.size() / vertices_)),
                found->second, name, at);
    return checked(GltfAccessor(*file_, *model_, found->second), found->second, name, at);
}

std::optional<GltfAccessor> GltfPrimitive::targetAttribute(std::size_t target,
                                                           const std::string& name) const {
    const auto& attributes = from_->targets[target];
    const auto found = attributes.find(name);
    if (found == attributes.end())
        return std::nullopt;
    return checked(GltfAccessor(*file_, *model_, found->second), found->second, name,
                   format("{}.targets[{}].{}", at_, target, name));
}

void GltfPrimitive::limit(std::size_t corners, std::size_t most) const {
    if (corners > most)
        failGltf(file_->path(), at_,
                 format("expected a scene of fewer triangles, all instances counted: found {} "
                        "here where {} are left",
                        corners / 3, most / 3));
}

std::vector<std::uint32_t> GltfPrimitive::order(std::size_t most) const {
    std::vector<std::uint32_t> result;
    if (from_->indices < 0) {
        limit(vertices_, most);
        for (std::size_t i = 0; i < vertices_; ++i)
            result.push_back(static_cast<std::uint32_t>(i));
        return result;
    }
    const GltfAccessor indices(*file_, *model_, from_->indices);
    const int type = indices.componentType();
    if (indices.components() != 1 || (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
                                      type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
                                      type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT))
        failGltf(file_->path(), at_ + ".indices",
                 format("expected an accessor of unsigned whole numbers, found accessors[{}] of "
                        "another kind",
                        from_->indices));
    limit(indices.count(), most);
    for (std::size_t i = 0; i < indices.count(); ++i) {
        result.push_back(indices.whole(i));
        if (result.back() >= vertices_)
            failGltf(file_->path(), at_ + ".indices",
                     format("index {} points past the {} vertices of its mesh", result.back(),
                            vertices_));
    }
    return result;
}

std::vector<std::uint32_t> GltfPrimitive::triangles(std::vector<std::uint32_t> order,
                                                    std::size_t most) const {
    if (from_->mode == TINYGLTF_MODE_TRIANGLES || from_->mode == -1) {
        if (order.size() % 3 != 0)
            failGltf(file_->path(), at_,
                     format("expected three vertices a triangle, found {} vertices", order.size()));
        return order;
    }
    limit(3 * order.size(), most);
    std::vector<std::uint32_t> result;
    for (std::size_t i = 2; i < order.size(); ++i) {
        const bool fan = from_->mode == TINYGLTF_MODE_TRIANGLE_FAN;
        const std::size_t odd = fan ? 0 : i % 2;
        result.insert(result.end(), {fan ? order[0] : order[i - 2 + odd],
                                     fan ? order[i - 1] : order[i - 1 - odd], order[i]});
    }
    return result;
}

std::vector<std::uint32_t> GltfPrimitive::corners(std::size_t most) const {
    if (!draco_)
        return triangles(order(most), most);
    limit(draco_->corners.size(), most); // a Draco stream holds triangles, whatever the mode says
    return draco_->corners;
}

} // namespace obscura
