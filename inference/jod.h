#pragma once

namespace obscura {

// probit(0.75): one just-objectionable difference is what 75 % prefer, a difference of 0.67
// standard deviations (Perez-Ortiz and Mantiuk, arXiv:1712.03686).
inline constexpr double jodUnit = 0.674489750196081743;

} // namespace obscura
