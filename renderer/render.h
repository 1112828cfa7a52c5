#pragma once

#include "gl/context.h"
#include "image/image.h"
#include "protocols/reader/manifest.h"
#include "renderer/scene/scene.h"
#include "renderer/techniques/settings.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace obscura {

class Subject;

// Hash of our own C++ that decides the pixels of an image (code_hash.cmake), because images made by
// other code may look different. Shaders and built-in scenes are no part of it: those have hashes
// of their own (shaderSha256(), contentSha256()), so that a changed one is rendered anew alone.
std::string_view imageCode();

// Where the files that a study names are.
struct Folders {
    std::filesystem::path scenes;   // glTF scenes
    std::filesystem::path protocol; // environment images
};

// The view's scene, built in or from its file, with the ground that the view gives it. What is
// wrong with it is told with the view's place in the protocol.
Scene loadSceneOf(const View& view, const Folders& folders);

// The hashes of scenes, each looked up once: a study shows few scenes in many conditions. What is
// wrong with one is told with the view's place.
class SceneHashes {
  public:
    explicit SceneHashes(Folders folders) : folders_(std::move(folders)) {}
    const Folders& folders() const { return folders_; }
    std::string of(const View& view);

  private:
    Folders folders_;
    std::map<std::string, std::string> known_; // by file or built-in name
};

// The recipe of one image: settings complete, and the hashes of scene, environment and shader
// texts looked up. `driver` is the one that will render it, `code` what does so.
Recipe makeRecipe(const Protocol& protocol, const Condition& condition, int member,
                  SceneHashes& scenes, const gl::Driver& driver,
                  std::string_view code = imageCode());

// The technique of a recipe with its settings.
Settings settingsOf(const Recipe& recipe);

// Hash of the text of every shader that makes an image with these settings.
std::string shaderSha256(const Settings& settings, const Level& level);

struct Rendering {
    Image8 image;                        // sRGB, as shown
    Image visibility;                    // 1 channel
    std::map<std::string, Image> layers; // on request: "linear" (before the display curve),
                                         // "albedo", "normal", "occlusion-normal", "emission",
                                         // "depth" (of the first jittered frame)
    std::string inputsSha256; // of what composite and lighting read, for every jittered frame:
                              // albedo, depth, ambient and direct light, emission, and normals
                              // where the lighting reads them
    double meanOcclusion = 0; // over the pixels that show a surface in the first frame
};

// Wall seconds, each stage ended by waiting for the GPU.
struct StageTimes {
    double scene = 0, gbuffer = 0, light = 0, occlusion = 0, composite = 0, hash = 0;
};

// Carries out recipes one at a time in the current context. Keeps the last scene, its rays and
// lighting, so that recipes sorted by scene and level load each once, and rays are traced once for
// all levels.
class RecipeRenderer {
  public:
    explicit RecipeRenderer(Folders folders);
    ~RecipeRenderer();

    // Scene and environment must have the recipe's hashes; an Error says which has changed.
    Rendering render(const Recipe& recipe, bool layers = false);

    // The recipe's scene, to be probed (renderer/probe.h); until a recipe has another scene.
    const Subject& subject(const Recipe& recipe);

    const StageTimes& times() const { return times_; }
    const std::vector<std::string>& sceneWarnings() const { return warnings_; }

  private:
    struct Stage;

    void prepare(const Recipe& recipe);
    const std::filesystem::path environmentOf(const Level& level) const;

    Folders folders_;
    std::unique_ptr<Stage> stage_;
    StageTimes times_;
    std::vector<std::string> warnings_;
};

} // namespace obscura
