#pragma once

#include "analysis/table.h"
#include "protocols/reader/protocol.h"

#include <string>
#include <vector>

namespace obscura {

// What was declared before a study against what was done in it, one line each.
struct Deviation {
    std::string subject, declared, done;
    bool deviates = false; // or was done as declared, or nothing was declared
};

// `declared` is what the study's folder keeps (Answers::declared), or what its protocol says; the
// protocol, where it is known, has the planned number of people besides. Findings of published
// counts have no people and no timing.
std::vector<Deviation> deviationsOf(const Findings& findings, const Declared& declared,
                                    const Protocol* protocol = nullptr);

// What a protocol declares; its design's hash has no images in it, and is left out.
Declared declaredBy(const Protocol& protocol);

Table deviationTable(const std::vector<Deviation>& deviations);
std::string deviationsCsv(const std::vector<Deviation>& deviations);

} // namespace obscura
