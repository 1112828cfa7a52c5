#pragma once

#include "protocols/reader/manifest.h"
#include "protocols/reader/protocol.h"

#include <filesystem>
#include <string_view>

namespace obscura {

// The manifest of a folder of stimuli that were made from this protocol, which may have other texts
// since then; its conditions in the protocol's order. An Error where there is none, or they were
// made from another one.
Manifest readStimuli(const Protocol& protocol, const std::filesystem::path& folder);

// Predicted JOD of an image against the reference of its view, at most 10. An Error where the
// manifest does not have it.
double predictedJod(const Manifest& manifest, std::string_view condition, std::string_view role);

} // namespace obscura
