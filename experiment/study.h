#pragma once

#include "image/image.h"
#include "protocols/reader/manifest.h"
#include "protocols/reader/protocol.h"

#include <filesystem>

namespace obscura {

// A protocol and the stimuli made from it, known to belong together: the manifest was made from
// this protocol, which may have other texts since then, and has both images of every condition.
struct Study {
    Protocol protocol;
    Manifest manifest;
    std::string language = {}; // in which it is shown, a tag; "" for the protocol's first

    const Texts& texts() const;
    const ConditionRecord& condition(int index) const; // as the protocol counts them, from 0

    std::string design() const; // designOf() both
};

Study openStudy(const std::filesystem::path& protocol, const std::filesystem::path& stimuli);

// Its pixels, from a file whose SHA-256 and size are as the manifest says; an Error otherwise.
Image8 loadStimulus(const Manifest& manifest, const ImageRecord& record);

// The same check for every image of the study, without decoding.
void verifyStimuli(const Manifest& manifest);

} // namespace obscura
