#pragma once

#include "bench/sweep/row.h"

#include <filesystem>

namespace obscura {

// What a sweep found, as one HTML page that needs no network and no other file, and prints: for
// each scene and resolution the charts of time against each error, with the front and its table;
// then the frame rates of a thesis' table; and how cost grows. Everything is drawn here; a script
// only shows details and sorts, and without it links do. Thumbnails are read from the sweep's
// folder, each into the page once: of a configuration, scene and resolution the first view's.
// Well-formed as XML too.
std::string sweepPage(const Sweep& sweep, const std::filesystem::path& folder);

} // namespace obscura
