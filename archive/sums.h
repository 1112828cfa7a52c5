#pragma once

#include "base/new_files.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace obscura {

// The list of an archive's files, by which anybody can tell that none was damaged: its lines are
// those of sha256sum, so that `sha256sum -c SHA256SUMS` in the archive's folder does so without us.
constexpr const char* sumsName = "SHA256SUMS";

// Of all these files. An Error for a path that not every system can have (faultOfPath).
std::string sumsOf(const NewFiles& files);

// Hash by path. An Error names the line that is none of ours.
using Sums = std::map<std::string, std::string>;
Sums readSums(const std::filesystem::path& archive);

// Each file of the archive that is not as the list says, or that it lacks, as a sentence that
// begins with its path. Links and devices are Errors: nothing in an archive may lead out of it.
std::vector<std::string> faultsOf(const std::filesystem::path& archive, const Sums& sums);

} // namespace obscura
