#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace obscura::test {

// The rules of BIDS 1.9.0 (behavioural) that an export of ours can break, checked without our own
// readers: names of files; required fields; tables with a header once, rows of one length and no
// empty cell; onset and duration first, in seconds; columns described in a sidecar; participants as
// there are folders; images that are named are there. One line per fault.
std::vector<std::string> bidsFaults(const std::filesystem::path& dataset);

// What bids-validator 1.x (npm, of the standard's makers) says: its errors, and its warnings but
// for those that only a study's owner can answer (no authors). Nothing is returned where it is not
// installed; `installed` then is false. OBSCURA_BIDS_VALIDATOR names it, else it is looked for in
// PATH.
std::vector<std::string> validatorFaults(const std::filesystem::path& dataset, bool& installed);

} // namespace obscura::test
