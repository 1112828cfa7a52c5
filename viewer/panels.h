#pragma once

#include "viewer/loader.h"
#include "viewer/state.h"
#include "viewer/test_run.h"
#include "viewer/uploads.h"
#include "viewer/widgets.h"
#include "viewer/worker.h"

#include <array>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

// Times of the last pictures, newest last; a pane's technique that changes begins anew.
struct History {
    struct Pane {
        std::string technique;
        std::deque<float> ms;
    };
    static constexpr std::size_t kept = 120;
    std::array<Pane, 4> panes;
    std::uint64_t number = 0;

    void add(const Drawn& drawn);
};

// What the user asked for that is no value to be set.
struct Requests {
    std::optional<SceneChoice> open;
    bool browse = false, frame = false, screenshot = false, meter = false;
    bool addPair = false, copySettings = false, writeSweep = false;
    bool startTest = false, stopTest = false, storeView = false, forgetView = false;
    std::optional<std::string> copy; // to the clipboard
};

// Where what is made here goes, and how long a test is.
struct Desk {
    std::string protocol = "study.toml", sweep = "sweep.toml", pictures = "screenshots";
    std::string out = "obscura-test";
    double seconds = 5, rounds = 3;
};

// The browser of files, as it stands.
struct Browser {
    bool open = false;
    std::filesystem::path folder;
    std::string filter;
    int chosen = -1;
};

// A message: an error stays until it is closed or another comes, others until they have been read.
struct Message {
    std::string text;
    bool error = false;
    double until = 0; // the window's time at which it goes by itself, unless an error
};

// What panels see in one frame, and what they may change.
struct Moment {
    Ui& ui;
    State& state;
    const std::shared_ptr<const Opened> opened; // null before the first
    const std::shared_ptr<const Drawn> drawn;   // null before the first
    const Status status;
    const std::optional<Probed> probed;
    const History& history;
    const TestRun* test; // null before the first
    Desk& desk;
    Requests& requests;
    Uploads& uploads;
    Box area; // where pictures are
    bool cursorLocked = false;
};

// Each draws itself into a place of the window.
void barPanel(Moment& moment, const Box& place);
void statusPanel(Moment& moment, const Box& place);
void sidePanel(Moment& moment, const Box& place);
void techniquesTab(Moment& moment);
void viewTab(Moment& moment);
void measureTab(Moment& moment);
void studyTab(Moment& moment);
void browserPanel(Moment& moment, Browser& browser);
void helpPanel(Moment& moment);
void messagePanel(Moment& moment, Message& message);

// The pictures with their dividers and captions. The mouse over them moves the camera, the divider
// and the magnification; the pixel under it is given.
struct Hand {
    bool overPicture = false, looking = false; // with the right button
    std::optional<PixelAt> pixel;
};
Hand picturesPanel(Moment& moment);

Scale errorScales();                // from 0.005 to 1
double wholeMs(const Drawn& drawn); // of a picture of which everything is drawn
std::string letterOf(int pane);     // "A"

} // namespace obscura
