#pragma once

#include "renderer/framing.h"
#include "renderer/scene/scene.h"
#include "viewer/picture.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace obscura {

// A scene as it was read, or why it could not be.
struct Loaded {
    SceneId id = 0;
    SceneChoice choice;
    std::unique_ptr<const Scene> scene; // null where there is an error
    std::shared_ptr<const RayTracer> rays;
    Framing view; // that shows it
    double seconds = 0;
    std::string error;
};

// Reads scenes on threads of its own. All member functions return at once and may be called from
// any thread.
class Loader {
  public:
    // Called from its threads when take() has something, and as a stage begins. Must return at
    // once, and not call the loader.
    explicit Loader(std::function<void()> changed);
    ~Loader(); // waits for files to be read to their end, also for those that were given up

    // Begins at once, and gives up what is being read.
    void load(SceneId id, SceneChoice choice);
    void abort();
    // What has been read, once; for it, the view was sought and rays were prepared.
    std::optional<Loaded> take();

    struct Progress {
        std::string what;       // "sponza.gltf: reading"
        double share = 0;       // of the time that files of this size took before
        double secondsLeft = 0; // NaN: longer than expected
    };
    std::optional<Progress> progress() const; // nothing: nothing is being read

  private:
    struct State;
    std::unique_ptr<State> state_;
};

// What a file name is for people: "sponza.gltf", or the built-in scene's name.
std::string nameOf(const SceneChoice& choice);

} // namespace obscura
