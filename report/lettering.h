#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace obscura {

// How text fits into pictures; gnuplot neither measures nor breaks lines. Texts are UTF-8.

std::size_t letters(const std::string& text); // code points

// Cut to so many letters, at least 1, the last of them "…" then.
std::string shortened(const std::string& text, std::size_t most);

// In lines of at most so many letters, broken at spaces; a longer word has a line of its own.
std::vector<std::string> wrapped(const std::string& text, std::size_t most);

} // namespace obscura
