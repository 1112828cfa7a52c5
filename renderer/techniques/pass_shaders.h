#pragma once

#include "gl/draw.h"
#include "gl/program.h"
#include "renderer/techniques/settings.h"

#include <span>
#include <vector>

namespace obscura {

// How the shaders of a technique's passes are assembled: frame, settings, inputs, the technique's
// file, and a main that calls the pass's function (technique.h). Who runs them binds what they read
// (occlusion_passes.h).

// What a pass's shader writes: its value, or how many texture fetches that takes
// (renderer/techniques/fetches.h).
enum class Writes { value, fetches };

// The text that runs one enabled pass. With `level` 1 it is that of every level after the first.
// The vertex shader of a pass over objects comes from objectShader().
gl::ShaderText passShader(const Settings& settings, const Pass& pass, int level = 0,
                          Writes writes = Writes::value);
gl::ShaderText objectShader(const Settings& settings, const Pass& pass);
gl::Program passProgram(const Settings& settings, const Pass& pass, int level = 0,
                        Writes writes = Writes::value);

// Whether these settings switch the pass on, and all that they do, in order.
bool isEnabled(const Settings& settings, const Pass& pass);
std::vector<const Pass*> enabledPasses(const Settings& settings);
// Whether the pass runs once for each sphere or triangle, all added up.
bool drawsObjects(const Pass& pass);
// Whether it is a compute shader, in groups of `computeGroup` pixels that share memory.
bool computes(const Pass& pass);
constexpr int computeGroup = 128;
// What the pass writes under these settings.
gl::Format formatOf(const Settings& settings, const Pass& pass);

// The block that a technique's points are read from: a uniform one where that many fit into it, for
// every driver has 16 KiB, and all pixels read the same point at once, which is what uniforms are
// fast at. Both kinds lie alike in memory.
gl::UniformBuffer::Kind kindOfPoints(std::span<const glm::vec4> points);

// Where a pass's shader finds what it reads.
namespace bindings {

// Blocks; the frame is 0.
constexpr int settingsBinding = 1, pointsBinding = 2, environmentBinding = 3, spheresBinding = 4,
              voxelsBinding = 6;
// Storage blocks have bindings of their own.
constexpr int treeBinding = 5; // three of them
constexpr int occludersBinding = 3;
// Samplers; later results follow.
constexpr int depthUnit = 0, normalUnit = 1, albedoUnit = 2, ambientUnit = 3, directUnit = 4,
              resultUnit = 5, voxelsUnit = 20, tracedUnit = 21; // results end below these
// Of a further layer of depth: 0 is the second.
int layerUnit(const Technique& technique, int further);

} // namespace bindings

} // namespace obscura
