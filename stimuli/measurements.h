#pragma once

#include "base/units.h"
#include "gl/timer.h"
#include "renderer/probe.h"
#include "renderer/render.h"

#include <filesystem>
#include <functional>
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
    // `recipes` are those of all images of the protocol, by view: all are timed together. A
    // reference is traced by one of the workers that share `units`; its pictures lie beside theirs.
    Measurements(const Protocol& protocol, std::filesystem::path folder,
                 std::map<std::string, std::vector<Recipe>> recipes, RecipeRenderer& renderer,
                 Units& units, std::function<void()> waiting);

    // Gives the images of a condition, whose files are in the folder, the quality that they lack,
    // or that is of another reference.
    void addQuality(ConditionRecord& condition);

    // Gives all images of a manifest their times, and the manifest what they were measured with.
    // Those that `earlier` has of the same images are kept, if they are of this machine; where one
    // image of a view lacks its time, all are timed anew.
    void addTimes(Manifest& manifest, const std::optional<Manifest>& earlier,
                  const gl::Driver& driver);

    double seconds() const { return seconds_; } // spent

  private:
    struct Reference {
        Image8 image, visibility;
        std::vector<bool> shown;
    };
    const Reference& reference(const Recipe& recipe);
    Reference shared(const Recipe& recipe);
    void time(Manifest& manifest, const std::string& view);

    const Protocol& protocol_;
    std::filesystem::path folder_;
    std::map<std::string, std::vector<Recipe>> recipes_;
    RecipeRenderer& renderer_;
    Units& units_;
    std::function<void()> waiting_;
    std::map<std::string, Reference> references_; // by the hash of the recipe
    std::optional<gl::TimingChoice> timing_;
    double seconds_ = 0;
};

} // namespace obscura
