#pragma once

#include "experiment/display.h"

#include <filesystem>

namespace obscura {

struct TimingArguments {
    int masks = 1000;
    double seconds = 2; // each
    bool json = false;
    std::filesystem::path out; // folder of further files; "" for none
};

// Holds masks on a display and says how long they were: the program's exit status.
int holdAndReport(const DisplayOptions& options, const TimingArguments& arguments);

} // namespace obscura
