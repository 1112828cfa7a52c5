#pragma once

#include <string>

namespace obscura {

// Scripts in R and Python, which need nothing but these languages, to go on from: they load the
// tables that lie beside them, compute the exact test once more and stop if it disagrees. `votes`:
// the path of votes.csv, as seen from the script's folder.
std::string startR(const std::string& votes);
std::string startPython(const std::string& votes);

} // namespace obscura
