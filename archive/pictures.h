#pragma once

#include "archive/checked.h"
#include "archive/study.h"

namespace obscura {

// Renders every image of a study again by its recipe, and compares it, its visibility and what
// other layers there are with the files; boosted images are boosted again. Not here are images of
// scenes that are neither built in nor in the folder of scenes, or of others of that name; and all
// of them where there is no OpenGL. `folder`: the protocol's, with environment images.
Checked picturesAgain(const WholeStudy& study, const std::filesystem::path& scenes,
                      const std::filesystem::path& folder, const CheckOptions& options);

} // namespace obscura
