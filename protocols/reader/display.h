#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace obscura {

class TomlTable;

// A screen that shows sRGB, as an eye in front of it has it: what predicted differences depend on
// (metrics/color_video_vdp.h). Pixels are square.
struct Display {
    std::string name;          // of a row of displays(), or "" once a number was changed
    int width = 0, height = 0; // pixels
    double diagonalInches = 0; //
    double distance = 0;       // from the eye, metres
    double peak = 0;           // luminance of white in the dark, cd/m2
    double contrast = 0;       // peak over the luminance of black in the dark
    double ambient = 0;        // light that falls on it, lux

    // At the middle of the screen.
    double pixelsPerDegree() const;
    bool operator==(const Display&) const = default;
};

// The displays that have a name; the first is what a study has that says nothing.
const std::vector<Display>& displays();

// "24-inch, 1920 x 1080 pixels, from 60 cm (37.8 pixels per degree), 200 cd/m2 at 1000:1 in 250
// lux"
std::string inWords(const Display& display);

// [display]: `name`, a named display (else the first), of which the other keys change something:
// width and height (pixels), diagonalInches, distanceCm, peak (cd/m2), contrast and ambientLux.
// `distanceCm` of [screen], above 0, stands in for a distance that is not given here.
Display parseDisplay(TomlTable table, double distanceCm = 0);

// Its numbers by these keys, in this order: as files of ours have a display, and read it again.
std::vector<std::pair<std::string, double>> numbersOf(const Display& display);

// The same from a command line: a name or "peak=100" each, later ones on top of earlier ones.
Display displayOf(std::span<const std::string> words);

} // namespace obscura
