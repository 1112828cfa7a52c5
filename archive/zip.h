#pragma once

#include "base/new_files.h"

#include <filesystem>
#include <string>

namespace obscura {

// Zip files, by libzip, which no other file of ours includes.

// A new zip of these files, all in the folder `folder` within it. Equal files give equal bytes, on
// any machine: nothing is compressed (pictures are already), every time is 1980-01-01, and the
// order is that of the paths.
void writeZip(const std::filesystem::path& zip, const std::string& folder, const NewFiles& files);

// Unpacks somebody's zip into a new folder `into`, and returns the one folder that all of it lies
// in. Everything is looked at before anything is written. An Error for what is damaged or cut
// short, and for what no archive of ours has: paths that lead elsewhere (faultOfPath), names that
// occur twice, links and devices, encryption, compression other than "deflate", more than a hundred
// times the zip's size or than there is room for. While unpacking: sizes and check sums other than
// declared.
std::filesystem::path unpackZip(const std::filesystem::path& zip,
                                const std::filesystem::path& into);

} // namespace obscura
