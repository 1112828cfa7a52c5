#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace obscura::test {

// The rules of Psych-DS that a dataset of ours can break, checked without our own readers:
// dataset_description.json is JSON-LD with its required fields; data files are named in
// key-value pairs; headers are unique; rows have equal length; columns and variableMeasured are
// the same set, taken over all files; row_id is unique in its file; nothing but data files lies in
// data/. One line per fault.
std::vector<std::string> psychDsFaults(const std::filesystem::path& dataset);

} // namespace obscura::test
