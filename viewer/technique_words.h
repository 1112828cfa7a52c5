#pragma once

#include "renderer/techniques/settings.h"

#include <string>
#include <string_view>
#include <vector>

namespace obscura {

// A technique with its settings as a person says it.

// What tells these settings from the technique's defaults, or from that of its presets which leaves
// the least to say; its name is nameOf() of it. A radius is said where it is not the scene's.
TechniqueSetting settingOf(const Settings& settings, double sceneRadius);

// A name for it that can stand in files: lower-case letters, digits and hyphens. "gtao",
// "gtao-high", "starcraft8-half"; what it does not tell makes it "-tuned".
std::string nameOf(const TechniqueSetting& setting);

// The other way round, from a command line: an id, then perhaps a preset and settings, "gtao high
// slices=6". An Error says what is wrong.
TechniqueSetting techniqueIn(std::string_view words);

// Its settings that are true or false, as a study's text has them.
std::vector<std::string> flagsOf(const TechniqueSetting& setting);

// Lower-case letters, digits and single hyphens of a text; "" where it has none of them.
std::string slug(std::string_view text);

} // namespace obscura
