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

// All that must be the same for every participant: the protocol's design (design.h) and the hashes
// of the images. The SHA-256 of this text is in every row.
std::string designOf(const Protocol& protocol, const Manifest& manifest);

// Predicted JOD of an image against the reference of its view, at most 10. An Error where the
// manifest does not have it.
double predictedJod(const Manifest& manifest, std::string_view condition, std::string_view role);

// Whether who chooses one of a condition's images in order chooses the worse: the right answer is
// one that another excels by predicted JOD, or all take turns with the source and one flickers
// more.
bool asksForWorse(const Protocol& protocol, const Condition& condition, const Manifest& manifest);

} // namespace obscura
