#pragma once

#include "image/image.h"

#include <optional>
#include <string>
#include <vector>

namespace obscura {

// What a photometer read of a full-screen grey.
struct LuminanceReading {
    int code = 0;         // 0 ... 255
    double luminance = 0; // cd/m2
};

// L(v) = black + scale (v / 255)^gamma, by least squares on log(L - black), each reading above
// black weighted by (L - black)^2: to first order that is least squares on L, where unweighted
// logarithms would let the darkest and least certain readings decide. Black is the reading of code
// 0, or none.
struct GammaFit {
    double gamma = 0, scale = 0, black = 0; // the latter two in cd/m2
    double at(int code) const;
};

// Nothing where readings do not decide it: fewer than two that are brighter than black, or darker
// towards white.
std::optional<GammaFit> fitGamma(const std::vector<LuminanceReading>& readings);

// Of a field of lines of 0 and 255 in turn that looks as bright as this code: half of the light.
double gammaOfMatch(int code); // 1 ... 254

// The readings and the curve.
Image8 drawGamma(const std::vector<LuminanceReading>& readings, const std::optional<GammaFit>& fit,
                 int width, int height, int grey);

} // namespace obscura
