#pragma once

#include "renderer/render.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace obscura {

// What makes conditions worthless and is no mistake of the file: images that look alike, a view of
// next to nothing, a radius within which nothing occludes. Found in renderings of 160 pixels
// across, in little more time than it takes to load scenes and compile shaders.
class Warnings {
  public:
    Warnings(const Protocol& protocol, RecipeRenderer& renderer);

    // `recipes` are those of the condition's roles. Each warning is a text with the condition,
    // figures, and what to do; what is wrong with a view is said once, of the condition that is
    // planned first, so that several processes do not repeat it. Images of a condition that
    // has a right answer may look alike: whoever looks for a threshold needs such.
    std::vector<std::string> of(const Condition& condition, std::span<const Recipe> recipes);

  private:
    const Rendering& glance(const Recipe& recipe);
    std::string faultOfView(const Condition& condition, std::span<const Recipe> recipes);
    std::string alike(const Condition& condition, const Role& a, const Role& b, const Image8& first,
                      const Image8& second) const;

    const Protocol& protocol_;
    RecipeRenderer& renderer_;
    std::map<std::string, Rendering> glances_;   // by the hash of the recipe
    std::map<std::string, std::size_t> firstOf_; // views: the condition
};

// What is said of a scene, as a text that names it.
std::vector<std::string> ofScene(const std::string& view, const std::vector<std::string>& found);

// Adds those that are not there yet.
void addOnce(std::vector<std::string>& all, const std::vector<std::string>& more);

} // namespace obscura
