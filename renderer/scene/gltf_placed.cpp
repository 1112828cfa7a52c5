#include "renderer/scene/gltf_placed.h"

#include "renderer/scene/gltf_piece.h"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace obscura {

using nlohmann::json;

namespace {

Vec3 array(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

std::string nameOf(const json& node, const json& camera, std::size_t index) {
    for (const json* each : {&node, &camera})
        if (std::string name = each->value("name", ""); !name.empty())
            return name;
    return fmt::format("nodes[{}]", index);
}

} // namespace

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
    if (!node.contains("extensions") || !node.at("extensions").contains("KHR_lights_punctual"))
        return std::nullopt;
    const json& use = node.at("extensions").at("KHR_lights_punctual");
    const json& from = root.at("extensions")
                           .at("KHR_lights_punctual")
                           .at("lights")[use.at("light").get<std::size_t>()];
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
