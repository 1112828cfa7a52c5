#pragma once

#include "experiment/display.h"
#include "protocols/reader/protocol.h"

#include <filesystem>
#include <optional>
#include <string>

namespace obscura {

// The study's language of that tag, in whatever letters: as the protocol spells it. An Error when
// it has none.
std::string languageNamed(const Protocol& protocol, const std::string& tag);

// In which language a session was, as its sidecar says; "" where it does not, or in none that the
// study still has.
std::string languageOf(const std::filesystem::path& sidecar, const Protocol& protocol);

// Lets the participant choose among the study's languages, by number, arrows and Enter, or mouse;
// the first is offered. Its tag; nothing when Escape was pressed. `warning` stands above the page.
std::optional<std::string> askLanguage(Display& display, const Protocol& protocol,
                                       const std::string& warning);

} // namespace obscura
