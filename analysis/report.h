#pragma once

#include "analysis/deviations.h"
#include "analysis/findings.h"

#include <filesystem>
#include <string>

namespace obscura {

// One HTML page for three readers: the answer in words, then figures, then every number. It has
// everything in it, figures and pictures too, needs no network and no other file, and prints. It is
// well-formed XML as well, so that programs can read it.
std::string reportHtml(const Findings& findings, const std::vector<Deviation>& deviations = {});

// What lies beside the page, in `folder`: figures/ for papers, and scripts to go on from, start.R
// and start.py, which read `votes`, the CSV of resultCsv().
void writeBesideReport(const std::filesystem::path& folder, const std::filesystem::path& votes,
                       const Findings& findings);

} // namespace obscura
