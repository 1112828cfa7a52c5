#pragma once

#include "archive/checked.h"

#include <filesystem>
#include <string>
#include <vector>

namespace obscura {

// An archive read again, and everything in it that this machine can make once more, made once more.

// `archive`: a folder, or a zip, which is unpacked into a temporary one. Nothing else is written.
// An Error where it is no archive, or one that is damaged or made to do harm, so that nothing in it
// can be looked at; all else is told in the result.
std::vector<Checked> checkArchive(const std::filesystem::path& archive,
                                  const CheckOptions& options);

// Whether nothing differs that should be the same.
bool isSound(const std::vector<Checked>& all);

// The table, and below it a line for each thing that differs or could not be looked at.
std::string textOf(const std::vector<Checked>& all);

} // namespace obscura
