#pragma once

#include "gl/timer.h"
#include "renderer/probe.h"
#include "renderer/render.h"

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace obscura {

// What a manifest says of its images beside what they are: how far each is from the ray-traced
// image of its view, and how long its technique takes. Neither decides a pixel.

// The recipe of the image that those of one condition are compared with: `ray_traced` in place of
// the technique. Its rays are those of the protocol's own ray-traced technique, the one with most,
// and at least 128 a pixel over all jittered frames.
Recipe referenceOf(const Protocol& protocol, std::span<const Recipe> condition);

// Of its images.
std::vector<Recipe> recipesOf(const ConditionRecord& condition);

class Measurements {
  public:
    // `recipes` are those of all images of the protocol, by view: all are timed together.
    Measurements(const Protocol& protocol, std::filesystem::path folder,
                 std::map<std::string, std::vector<Recipe>> recipes, RecipeRenderer& renderer);

    // Gives the images of a condition, whose files are in the folder, what they lack: quality, if
    // theirs is of another reference, and times. Where one image of a view lacks its time, all are
    // timed anew, also those of earlier conditions in the manifest.
    void complete(Manifest& manifest, ConditionRecord& condition);

    double seconds() const { return seconds_; } // spent

  private:
    struct Reference {
        Image8 image, visibility;
        std::vector<bool> shown;
    };
    const Reference& reference(const Recipe& recipe);
    void addQuality(ConditionRecord& condition);
    void time(Manifest& manifest, const std::string& view);

    const Protocol& protocol_;
    std::filesystem::path folder_;
    std::map<std::string, std::vector<Recipe>> recipes_;
    RecipeRenderer& renderer_;
    std::map<std::string, Reference> references_; // by the hash of the recipe
    std::optional<gl::TimingChoice> timing_;
    // Milliseconds of what was timed now, by view and technique with its settings.
    std::map<std::string, std::map<std::string, double>> times_;
    double seconds_ = 0;
};

} // namespace obscura
