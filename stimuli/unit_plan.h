#pragma once

#include "renderer/render.h"
#include "stimuli/earlier.h"
#include "stimuli/plan.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace obscura {

// The units of work (base/units.h) of a stimulus folder. Their names say what they are, and have a
// hash of all that decides what comes of them: so those of several protocols, of several versions
// of one and of several programs can lie in one folder, and each is done once.

// All images of a condition, which one process makes, for they must match.
struct PlannedCondition {
    std::size_t condition = 0; // index into the protocol's conditions
    std::vector<PlannedImage> images;
    std::vector<Recipe> recipes;
    std::vector<bool> exrs; // of each image: whether it is to have them
    std::string unit;
};

struct UnitPlan {
    std::vector<PlannedCondition> conditions; // in the order that loads each scene once
    std::string times, manifest;              // units: of all techniques' times, and the last

    std::vector<Recipe> recipes() const; // of all images
};

// A mistake in any condition is an Error, before the first image is made.
UnitPlan unitPlan(const Protocol& protocol, const Folders& folders, bool layers,
                  const gl::Driver& driver, std::string_view code, const Earlier& earlier);

// What a manifest and a condition's record say of a protocol, without images.
Manifest emptyManifest(const Protocol& protocol, const std::filesystem::path& folder);
ConditionRecord emptyCondition(const Protocol& protocol, const Condition& condition);

} // namespace obscura
