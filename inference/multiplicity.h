#pragma once

#include <span>
#include <vector>

namespace obscura {

// p values adjusted for the family that they form, in the given order; each is compared with the
// level of the whole family. As R 4.2.2 p.adjust. A value outside of 0 ... 1 is an Error.

// The probability of any false rejection stays below the level, whatever the dependence: Holm,
// Scand. J. Stat. 6 (1979) 65. The i-th smallest of m times (m - i + 1), running maximum.
std::vector<double> holm(std::span<const double> p);

// The expected share of false rejections among all: Benjamini and Hochberg, J. R. Stat. Soc. B 57
// (1995) 289. The i-th smallest of m times m / i, running minimum from the largest.
std::vector<double> benjaminiHochberg(std::span<const double> p);

} // namespace obscura
