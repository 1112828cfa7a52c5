#pragma once

#include "inference/jod.h"

#include <numbers>

namespace obscura {

// Of one look at one image: its worth is normal around its JOD with this standard deviation, in
// JOD. Two looks then differ so that 1 JOD is 75 % of the choices.
inline constexpr double lookDeviation = 1 / (jodUnit * std::numbers::sqrt2);

// Worths of a pair that lie nearer to each other than this, in JOD, are called "not sure" where
// that may be said: of two equal images by 26 %. Ours, not measured.
inline constexpr double unsureWithin = 0.5;

// How often each answer is given to a pair; sums to 1.
struct PairShares {
    double first = 0.5, second = 0.5, unsure = 0;
};

// A simulated observer whose truth is JOD: chooses the image of the greater worth (Thurstone,
// Psychol. Rev. 34 (1927) 273, case V). In a lapse, every answer is as likely.
struct ThurstoneObserver {
    double lapse = 0; // probability, 0 ... 1
    // -0.5 ... 0.5: by how much the second of two equal images is chosen more often than by a half,
    // lapses apart; at the ends all but always.
    double bias = 0;

    // What the second image gains by its place, in JOD.
    double advantage() const;
    // P(second) = lapse / 2 + (1 - lapse) Phi((second - first + advantage) jodUnit) for JODs of the
    // images. Where one `mayTie`, the threshold `unsureWithin` is taken off the difference in
    // favour of either image (Glenn and David, Biometrics 16 (1960) 86), and a lapse has three
    // answers.
    PairShares shares(double first, double second, bool mayTie) const;
};

} // namespace obscura
