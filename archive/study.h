#pragma once

#include "protocols/reader/manifest.h"
#include "protocols/reader/protocol.h"

#include <filesystem>

namespace obscura {

// Where the parts of a study lie.
struct StudyPlaces {
    std::filesystem::path protocol; // a file; all others are folders
    std::filesystem::path stimuli;  // with manifest.json
    std::filesystem::path data;     // with the study's sessions/ and data/
    std::filesystem::path results;  // with results.json; "": there are none yet
};

// Those that are given, and of the others the ones found in `folder` ("": none is searched) and up
// to three levels below it: each is known by what it has in it. A data folder may also be given as
// the presenter takes it, one above. An Error says what is missing, or which of several it cannot
// tell.
StudyPlaces findStudy(const std::filesystem::path& folder, StudyPlaces given);

// A study whose parts are known to belong together.
struct WholeStudy {
    StudyPlaces places;
    Protocol protocol;
    Manifest manifest; // conditions in the protocol's order
};

// An Error where the stimuli were made from another protocol, a file is not the one that the
// manifest vouches for, or the data were recorded under another design; it says what has changed.
WholeStudy openWholeStudy(const StudyPlaces& places);

// The parts of that; each throws at the first fault.
void checkDesign(const WholeStudy& study); // of design.json and of every row that names one
void checkStimuli(const Manifest& manifest);

// Every file that a manifest vouches for: images, layers, contact sheets. An Error for a path that
// leads out of its folder.
std::vector<FileRecord> filesOf(const Manifest& manifest);

} // namespace obscura
