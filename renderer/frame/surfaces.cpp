#include "renderer/frame/surfaces.h"

namespace obscura {

namespace {

std::vector<glm::vec3> unitVectors(const gl::Texture& texture, int width, int height) {
    const std::vector<float> values = gl::readFloats(texture, width, height, gl::Format::rgba16f);
    std::vector<glm::vec3> result(values.size() / 4);
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = glm::normalize(glm::vec3(values[4 * i], values[4 * i + 1], values[4 * i + 2]));
    return result;
}

} // namespace

glm::vec3 Surfaces::position(float x, float y, float viewDepth) const {
    const glm::vec2 uv((x + 0.5f) * frame.size.z, (y + 0.5f) * frame.size.w);
    return {(uv.x * frame.viewFromUv.x + frame.viewFromUv.z) * viewDepth,
            (uv.y * frame.viewFromUv.y + frame.viewFromUv.w) * viewDepth, -viewDepth};
}

Surfaces surfacesOf(const GpuScene& scene, const GBufferPass& pass, const Frame& frame,
                    Normals kind) {
    Surfaces result;
    result.frame = frame;
    result.width = static_cast<int>(frame.size.x);
    result.height = static_cast<int>(frame.size.y);
    const gl::UniformBuffer block = frameBuffer(frame);
    bindFrame(block);
    const auto normalsOf = [&](Normals wanted) {
        const GBuffer gbuffer(result.width, result.height, {false, false, wanted});
        pass.draw(scene, frame, gbuffer);
        if (result.depth.empty())
            result.depth =
                gl::readFloats(gbuffer.depth(), result.width, result.height, gl::Format::r32f);
        return unitVectors(*gbuffer.occlusionNormal(), result.width, result.height);
    };
    result.normal = normalsOf(kind);
    result.faceNormal = kind == Normals::face ? result.normal : normalsOf(Normals::face);
    return result;
}

} // namespace obscura
