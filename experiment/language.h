#pragma once

#include "experiment/display.h"
#include "experiment/study.h"

#include <filesystem>
#include <string>

namespace obscura {

// The study's language of that tag, in whatever letters: as the protocol spells it. An Error when
// it has none.
std::string languageNamed(const Protocol& protocol, const std::string& tag);

// Settles the study's language, where that has not been done and there are several: that of the
// session with this sidecar ("" or none there: no such session); or else the participant chooses,
// by number, arrows and Enter, or mouse. `warning` stands above the page. False when Escape was
// pressed.
bool settleLanguage(Study& study, StimulusDisplay& display, const std::string& warning,
                    const std::filesystem::path& sidecar);

} // namespace obscura
