#pragma once

#include "experiment/screens.h"
#include "experiment/study.h"
#include "image/image.h"

#include <string>
#include <vector>

namespace obscura {

// A screen as a participant would see it, pixel by pixel, and what is said of it.
struct PreviewedScreen {
    std::string name, end, shown; // how it ends; which images it shows
    Image8 image;
};

// Every screen of the first trial of slot 1, each of the images that alternate on one of its own;
// before it the instructions, after it the pages for breaks, leaving and thanks. Neither a window
// nor a display is needed.
std::vector<PreviewedScreen> previewed(const Study& study, int width, int height);

// How a phase ends, in words, on a display of 60 Hz: "2 s, 120 frames at 60 Hz, locked".
std::string endOf(const Phase& phase);

// All of them on one sheet, at half size.
Image8 previewSheet(const Study& study, int width, int height);

} // namespace obscura
