#pragma once

#include "image/image.h"
#include "protocols/reader/manifest.h"

#include <string>

namespace obscura {

// How images are boosted for triplet comparisons. Men, Lin, Jenadeleh and Saupe, "Subjective Image
// Quality Assessment With Boosted Triplet Comparisons", IEEE Access 9, 2021, and, after them, JPEG
// AIC-3 (ISO/IEC 29170-3; Testolina et al. 2024, arXiv:2410.09501).
//
// First each channel becomes r + amplify (v - r), where v is the image's and r the reference's code
// value (8-bit sRGB, as displayed and as the papers have it: about equal steps look about equal),
// rounded and cut to 0 ... 255. Men et al. lower the factor where a value would be cut; we do not,
// as AIC-3 names none but 2. Then the part of the image that begins at `crop` and is `magnify`
// times smaller is magnified to the size of the whole, by Lanczos' kernel as in AIC-3 (its support,
// 3 pixels, is ours), which sees the pixels around the part. Flicker, the third boost, is a phase.
Image8 boosted(const Image8& image, const Image8& reference, const Derivation& how);

// The file that was rendered: that of the image itself, unless it is shown boosted.
const FileRecord& renderedOf(const ImageRecord& image);

// As the protocol has it; of the files that were rendered.
Derivation derivationOf(const Protocol& protocol, const ConditionRecord& condition,
                        const ImageRecord& image);

// Gives each image of the manifest a boosted one in its place, written to the manifest's folder,
// and keeps what was rendered as the layer "rendered".
void boostImages(const Protocol& protocol, Manifest& manifest);

// The record as it was before.
ImageRecord unboosted(ImageRecord image);

// Why the image is not boosted as the protocol has it now; "" when it is.
std::string faultOfBoost(const Protocol& protocol, const Manifest& manifest,
                         const ConditionRecord& condition, const ImageRecord& image);

} // namespace obscura
