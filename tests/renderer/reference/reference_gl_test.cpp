// Rays and the rasteriser see the same surfaces.
#include "renderer/builtin/builtin.h"
#include "renderer/frame/surfaces.h"
#include "renderer/reference/ray_scene.h"
#include "renderer/reference/sight.h"
#include "tests/renderer/techniques/occlusion_fixture.h"

#include <cmath>

namespace obscura {
namespace {

class RaysAndRasteriser : public GlTest {
  protected:
    // The share of pixels where the ray through the centre meets something at the depth buffer's
    // depth, within a pixel's slope, or nothing where it is empty.
    static double agreement(const Scene& scene, const Camera& camera, int width, int height) {
        const GpuScene gpuScene(scene);
        const Surfaces surfaces =
            surfacesOf(gpuScene, GBufferPass(),
                       makeFrame(camera, width, height, gpuScene.bounds(), 1), Normals::face);
        const RayScene rays(scene);
        int agree = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const float depth = depthOfRay(rays, surfaces, x, y);
                const float drawn = surfaces.depth[surfaces.index(x, y)];
                agree += surfaces.empty(surfaces.index(x, y))
                             ? std::isinf(depth)
                             : std::abs(depth - drawn) < 2e-3f * drawn;
            }
        return static_cast<double>(agree) / (width * height);
    }
    // The share of pixels of which Sight and the rasteriser say the same, normals included.
    static double sightAgreement(const Scene& scene, const Camera& camera, int width, int height) {
        const GpuScene gpuScene(scene);
        const Surfaces drawn =
            surfacesOf(gpuScene, GBufferPass(),
                       makeFrame(camera, width, height, gpuScene.bounds(), 1), Normals::smooth);
        const Surfaces seen = Sight(scene).surfaces(camera, width, height);
        int agree = 0;
        for (std::size_t i = 0; i < drawn.depth.size(); ++i)
            agree += drawn.empty(i)
                         ? seen.empty(i)
                         : std::abs(seen.depth[i] - drawn.depth[i]) < 2e-3f * drawn.depth[i] &&
                               glm::dot(seen.normal[i], drawn.normal[i]) > 0.995f &&
                               glm::dot(seen.faceNormal[i], drawn.faceNormal[i]) > 0.99f;
        return static_cast<double>(agree) / (width * height);
    }
    static float depthOfRay(const RayScene& rays, const Surfaces& surfaces, int x, int y) {
        const Frame& frame = surfaces.frame;
        const glm::vec3 camera(frame.worldFromView[3]);
        // Of depth 1, so that distances along it are depths.
        const glm::vec3 ahead = glm::mat3(frame.worldFromView) *
                                surfaces.position(static_cast<float>(x), static_cast<float>(y), 1);
        RTCRayHit ray{};
        ray.ray = {camera.x, camera.y, camera.z, frame.depth.x, ahead.x, ahead.y,
                   ahead.z,  0,        INFINITY, ~0u,           0,       0};
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        findNearest(rays.handle(), ray);
        return ray.ray.tfar;
    }
};

TEST_F(RaysAndRasteriser, AgreeOnTheAtrium) {
    Camera camera;
    camera.position = {7.6, 1.2, -0.9};
    camera.target = {-4, 2.4, 1.2};
    camera.fovDegrees = 60;
    const Scene atrium = builtinScene("atrium");
    EXPECT_GT(agreement(atrium, camera, 320, 180), 0.995);
    EXPECT_GT(sightAgreement(atrium, camera, 160, 90), 0.97);
}

// Leaves cut out by alpha, and blades of grass narrower than a pixel.
TEST_F(RaysAndRasteriser, AgreeOnTheGarden) {
    Camera camera;
    camera.position = {2.2, 1.3, -0.9};
    camera.target = {4.8, 0.7, -3.5};
    camera.fovDegrees = 60;
    const Scene garden = builtinScene("garden");
    EXPECT_GT(agreement(garden, camera, 320, 180), 0.995);
    EXPECT_GT(sightAgreement(garden, camera, 160, 90), 0.97);
}

// From within a box of which only the outside is drawn, one sees what is around it; a picture and
// who looks by rays alike.
TEST_F(RaysAndRasteriser, AgreeOnBacks) {
    Scene scene;
    addBox(scene, glm::vec3(-1), glm::vec3(1));
    addBox(scene, glm::vec3(-2, -1, -6), glm::vec3(0.5, 2, -5));
    Camera camera;
    camera.target = {0.3, 0.1, -4};
    const Surfaces seen = Sight(scene).surfaces(camera, 64, 36);
    EXPECT_NEAR(seen.depth[seen.index(20, 18)], 5, 0.2);
    EXPECT_GT(sightAgreement(scene, camera, 64, 36), 0.98);
    scene.materials[0].doubleSided = true;
    EXPECT_GT(sightAgreement(scene, camera, 64, 36), 0.98);
}

// A floor whose normals lean away from the eye or contradict its winding, seen at 10 degrees. A
// hemisphere whose axis leans by an angle b from a plane's normal has the cosine-weighted share
// (1 + cos b) / 2 above the plane. By hand: what leans beyond the view is bent to lie across it, 10
// degrees from the floor's normal; what lies below the floor is mirrored first.
TEST_F(RaysAndRasteriser, SeeNormalsOnTheVisibleSide) {
    const auto leaning = [](double degrees) { // towards +x, where the eye is
        return glm::vec3(std::sin(degrees * M_PI / 180), std::cos(degrees * M_PI / 180), 0);
    };
    Camera camera;
    camera.position = {200 * std::cos(M_PI / 18), 200 * std::sin(M_PI / 18), 0};
    camera.target = {0, 0, 0};
    camera.fovDegrees = 0.2;
    for (const auto& [lean, expected] : {std::pair(30, 30.0),
                                         {80, 80.0},
                                         {-5, -5.0},
                                         {-60, -10.0},
                                         {180, 0.0},
                                         {175, 5.0},
                                         {-120, -10.0}}) {
        Scene scene;
        addQuad(scene, {glm::vec3(-4, 0, 4), glm::vec3(4, 0, 4), glm::vec3(4, 0, -4),
                        glm::vec3(-4, 0, -4)});
        for (Vertex& vertex : scene.vertices)
            vertex.normal = leaning(lean);
        const GpuScene gpuScene(scene);
        const Surfaces drawn =
            surfacesOf(gpuScene, GBufferPass(), makeFrame(camera, 8, 8, gpuScene.bounds(), 1),
                       Normals::smooth);
        const glm::vec3 normal =
            glm::mat3(drawn.frame.worldFromView) * drawn.normal[drawn.index(4, 4)];
        EXPECT_GT(glm::dot(normal, leaning(expected)), 0.9999f) << lean;
        EXPECT_GT(sightAgreement(scene, camera, 8, 8), 0.98) << lean;
        TraceSettings settings;
        settings.radius = 1;
        const Image traced = RayTracer(scene).trace(drawn, settings).visibility;
        double mean = 0;
        for (const float visibility : traced.pixels)
            mean += static_cast<double>(visibility) / 64;
        EXPECT_NEAR(mean, (1 + std::cos(expected * M_PI / 180)) / 2, 0.003) << lean;
    }
}

// A sheet with square holes above a floor; filtered, repeated, mirrored by negative coordinates.
TEST_F(RaysAndRasteriser, AgreeOnTheHolesOfMaskedMaterials) {
    Scene scene;
    addQuad(scene,
            {glm::vec3(-4, 0, 4), glm::vec3(4, 0, 4), glm::vec3(4, 0, -4), glm::vec3(-4, 0, -4)});
    Texture texture{{8, 8, 4, {}}, false, Wrap::repeat, Wrap::clamp};
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            for (const int value : {200, 100, 50, (x + y) % 3 ? 255 : 0})
                texture.image.pixels.push_back(static_cast<std::uint8_t>(value));
    scene.textures.push_back(texture);
    Material masked;
    masked.baseColourTexture.texture = 0;
    masked.baseColour.a = 0.9f;
    masked.alphaCutoff = 0.4f;
    masked.doubleSided = true;
    scene.materials.push_back(masked);
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    const glm::vec3 corners[] = {{-2, 1, 2}, {2, 1.5f, 2}, {2, 1, -2}, {-2, 1.5f, -2}};
    const glm::vec2 uvs[] = {{-1.3f, -0.2f}, {1.6f, 0}, {1.6f, 1.4f}, {-1.3f, 1}};
    for (int i = 0; i < 4; ++i)
        scene.vertices.push_back({corners[i], {0, 1, 0}, {}, uvs[i]});
    const auto start = static_cast<std::uint32_t>(scene.indices.size());
    for (const std::uint32_t i : {0, 1, 2, 0, 2, 3})
        scene.indices.push_back(first + i);
    scene.meshes.push_back({start, 6, 1});
    Camera camera;
    camera.position = {0.3, 5, 1};
    camera.target = {0, 0.5, 0};
    EXPECT_GT(agreement(scene, camera, 320, 240), 0.995);
    scene.textures[0].wrapU = Wrap::mirrored;
    scene.textures[0].wrapV = Wrap::mirrored;
    EXPECT_GT(agreement(scene, camera, 320, 240), 0.995) << "mirrored";
    scene.textures[0].nearest = true;
    EXPECT_GT(agreement(scene, camera, 320, 240), 0.995) << "squares";
    scene.textures[0] = texture;
    // Moved, turned and scaled coordinates, of the second set, and alpha of vertices.
    TextureUse& use = scene.materials[1].baseColourTexture;
    use.offset = {0.2f, 0.7f};
    use.scale = {1.5f, 0.6f};
    use.rotation = 0.5f;
    EXPECT_GT(agreement(scene, camera, 320, 240), 0.995) << "transformed";
    use.set = 1;
    for (std::uint32_t i = first; i < first + 4; ++i) {
        scene.vertices[i].uv1 = {scene.vertices[i].uv.y, scene.vertices[i].uv.x};
        scene.vertices[i].colour.a = i % 2 ? 0.5f : 1;
    }
    EXPECT_GT(agreement(scene, camera, 320, 240), 0.995) << "second set, vertex alpha";
    use = {.texture = 0};
    for (std::uint32_t i = first; i < first + 4; ++i)
        scene.vertices[i].colour.a = 1;
    // Colour is filtered anisotropically, which software Mesa does a tenth of a texel off.
    scene.textures[0].srgb = true;
    EXPECT_GT(agreement(scene, camera, 320, 240), 0.98);
}

} // namespace
} // namespace obscura
