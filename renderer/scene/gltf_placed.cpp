#include "renderer/scene/gltf_placed.h"

#include "renderer/scene/gltf_accessor.h"
#include "renderer/scene/gltf_json.h"
#include "renderer/scene/gltf_piece.h"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace obscura {

using fmt::format;
using nlohmann::json;

namespace {

constexpr std::size_t mostInstances = 1'000'000; // of one node

glm::dmat4 transform(const glm::dvec3& translation, const glm::dvec4& rotation,
                     const glm::dvec3& scale) {
    glm::dmat4 result =
        glm::mat4_cast(glm::normalize(glm::dquat(rotation.w, rotation.x, rotation.y, rotation.z)));
    for (int i = 0; i < 3; ++i)
        result[i] *= scale[i];
    result[3] = glm::dvec4(translation, 1);
    return result;
}

// One of the attributes of a node's instances, where it has it.
class Instances {
  public:
    Instances(const GltfFile& file, const tinygltf::Model& model, std::size_t node,
              const json& attributes)
        : file_(file), model_(model), attributes_(attributes),
          at_(format("nodes[{}].extensions.EXT_mesh_gpu_instancing.attributes", node)) {}

    std::size_t count() const { return count_.value_or(0); }
    std::optional<GltfAccessor> read(const char* name, int components) {
        if (!attributes_.contains(name))
            return std::nullopt;
        GltfAccessor accessor(file_, model_, attributes_.at(name).get<int>());
        const std::size_t expected = count_.value_or(accessor.count());
        if (accessor.components() != components || accessor.count() != expected ||
            expected > mostInstances)
            failGltf(file_.path(), at_ + "." + name,
                     format("expected at most {} elements of {}, as many as the other attributes "
                            "have, found {} of {}",
                            mostInstances, components, accessor.count(), accessor.components()));
        count_ = expected;
        return accessor;
    }

  private:
    const GltfFile& file_;
    const tinygltf::Model& model_;
    const json& attributes_;
    std::string at_;
    std::optional<std::size_t> count_;
};

template <typename Vec>
Vec vec(const std::optional<GltfAccessor>& from, std::size_t element, Vec value) {
    for (int c = 0; from && c < Vec::length(); ++c)
        value[c] = from->value(element, c);
    return value;
}

Vec3 array(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

std::string nameOf(const json& node, const json& camera, std::size_t index) {
    for (const json* each : {&node, &camera})
        if (std::string name = each->value("name", ""); !name.empty())
            return name;
    return format("nodes[{}]", index);
}

} // namespace

glm::dmat4 transformOf(const tinygltf::Node& node) {
    if (!node.matrix.empty())
        return glm::make_mat4(node.matrix.data());
    const auto or3 = [](const std::vector<double>& found, double otherwise) {
        return found.empty() ? glm::dvec3(otherwise) : glm::make_vec3(found.data());
    };
    return transform(or3(node.translation, 0),
                     node.rotation.empty() ? glm::dvec4(0, 0, 0, 1)
                                           : glm::make_vec4(node.rotation.data()),
                     or3(node.scale, 1));
}

std::vector<glm::dmat4> instancesOf(const GltfFile& file, const tinygltf::Model& model,
                                    std::size_t node, const glm::dmat4& worldFromNode) {
    const json* extension = extensionOf(file.root().at("nodes")[node], "EXT_mesh_gpu_instancing");
    if (!extension)
        return {worldFromNode};
    Instances instances(file, model, node, extension->at("attributes"));
    const auto translation = instances.read("TRANSLATION", 3),
               rotation = instances.read("ROTATION", 4), scale = instances.read("SCALE", 3);
    std::vector<glm::dmat4> result;
    for (std::size_t i = 0; i < instances.count(); ++i)
        result.push_back(worldFromNode * transform(vec(translation, i, glm::dvec3(0)),
                                                   vec(rotation, i, glm::dvec4(0, 0, 0, 1)),
                                                   vec(scale, i, glm::dvec3(1))));
    return result;
}

std::optional<NamedCamera> cameraOf(const json& root, std::size_t index,
                                    const glm::dmat4& worldFromNode, const glm::dvec3& ahead) {
    const json& node = root.at("nodes")[index];
    if (!node.contains("camera"))
        return std::nullopt;
    const json& from = root.at("cameras")[node.at("camera").get<std::size_t>()];
    if (from.at("type") != "perspective")
        return std::nullopt;
    const json& perspective = from.at("perspective");
    const glm::dvec3 position(worldFromNode[3]), forward(direction(-glm::dvec3(worldFromNode[2]))),
        up(direction(glm::dvec3(worldFromNode[1])));
    const double distance = glm::dot(ahead - position, forward);
    NamedCamera result{nameOf(node, from, index), {}};
    result.camera.position = array(position);
    result.camera.target = array(position + forward * (distance > 0 ? distance : 1.0));
    result.camera.up = array(up);
    result.camera.fovDegrees =
        std::clamp(glm::degrees(perspective.at("yfov").get<double>()), 1.0, 120.0);
    result.camera.near = perspective.at("znear").get<double>();
    return faultOf(result.camera).empty() ? std::optional(result) : std::nullopt;
}

std::optional<PointLight> lightOf(const json& root, std::size_t index,
                                  const glm::dmat4& worldFromNode) {
    const json& node = root.at("nodes")[index];
    const json* use = extensionOf(node, "KHR_lights_punctual");
    if (!use)
        return std::nullopt;
    const json& from = root.at("extensions")
                           .at("KHR_lights_punctual")
                           .at("lights")[use->at("light").get<std::size_t>()];
    PointLight light;
    const auto type = from.at("type").get<std::string>();
    light.kind = type == "directional" ? PointLight::Kind::directional
                 : type == "spot"      ? PointLight::Kind::spot
                                       : PointLight::Kind::point;
    light.position = glm::vec3(worldFromNode[3]);
    light.direction = direction(-glm::dvec3(worldFromNode[2]));
    const auto colour = from.value("color", std::vector<float>{1, 1, 1});
    light.intensity = glm::vec3(colour[0], colour[1], colour[2]) * from.value("intensity", 1.0f);
    light.range = from.value("range", 0.0f);
    const json spot = from.value("spot", json::object());
    light.innerCosine = std::cos(spot.value("innerConeAngle", 0.0f));
    light.outerCosine = std::cos(spot.value("outerConeAngle", glm::quarter_pi<float>()));
    return light;
}

} // namespace obscura
