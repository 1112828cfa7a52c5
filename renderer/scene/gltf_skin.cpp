#include "renderer/scene/gltf_skin.h"

#include "renderer/scene/gltf_check.h"

#include <fmt/format.h>

namespace obscura {

using fmt::format;

std::vector<glm::dmat4> jointsOf(const GltfFile& file, const tinygltf::Model& model, int skin,
                                 std::span<const std::optional<glm::dmat4>> worldFromNode) {
    const tinygltf::Skin& from = model.skins[static_cast<std::size_t>(skin)];
    std::optional<GltfAccessor> inverse;
    if (from.inverseBindMatrices >= 0) {
        inverse.emplace(file, model, from.inverseBindMatrices);
        if (inverse->components() != 16 || inverse->count() < from.joints.size())
            failGltf(file.path(), format("skins[{}].inverseBindMatrices", skin),
                     format("expected a matrix of 16 for each of {} joints, found {} of {}",
                            from.joints.size(), inverse->count(), inverse->components()));
    }
    std::vector<glm::dmat4> joints;
    for (std::size_t j = 0; j < from.joints.size(); ++j) {
        glm::dmat4 joint =
            worldFromNode[static_cast<std::size_t>(from.joints[j])].value_or(glm::dmat4(1));
        if (inverse) {
            glm::dmat4 bind(1);
            for (int c = 0; c < 16; ++c)
                bind[c / 4][c % 4] = inverse->value(j, c);
            joint *= bind;
        }
        joints.push_back(joint);
    }
    return joints;
}

std::vector<glm::dmat4> skinned(const GltfFile& file, const GltfPrimitive& primitive,
                                std::span<const glm::dmat4> joints,
                                std::span<const std::uint32_t> used) {
    std::vector<glm::dmat4> sums(used.size(), glm::dmat4(0));
    std::vector<double> totals(used.size(), 0);
    for (int set = 0; set == 0 || primitive.has(format("JOINTS_{}", set)); ++set) {
        const std::string name = format("JOINTS_{}", set);
        const auto joint = primitive.attribute(name),
                   weight = primitive.attribute(format("WEIGHTS_{}", set));
        if (!joint || !weight)
            failGltf(file.path(), primitive.at() + ".attributes",
                     format("expected {} and WEIGHTS_{} of a skinned mesh, found only one or none",
                            name, set));
        for (std::size_t i = 0; i < used.size(); ++i)
            for (int k = 0; k < 4; ++k) {
                const auto index = static_cast<double>(joint->value(used[i], k)),
                           share = static_cast<double>(weight->value(used[i], k));
                if (!(share > 0))
                    continue;
                if (!(index >= 0 && index < static_cast<double>(joints.size())))
                    failGltf(file.path(), primitive.at() + ".attributes." + name,
                             format("joint {} of vertex {} points past the {} joints of its skin",
                                    index, used[i], joints.size()));
                sums[i] += share * joints[static_cast<std::size_t>(index)];
                totals[i] += share;
            }
    }
    for (std::size_t i = 0; i < used.size(); ++i)
        sums[i] = totals[i] > 0 ? sums[i] / totals[i] : glm::dmat4(1);
    return sums;
}

} // namespace obscura
