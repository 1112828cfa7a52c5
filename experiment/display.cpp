#include "experiment/display.h"

#include "base/error.h"
#include "experiment/open_trigger.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <chrono>
#include <thread>

namespace obscura {

namespace {

using Stamp = gl::Window::Stamp;

constexpr int warmUpFlips = 10, measuredFlips = 120, burstFlips = 8;
constexpr double pause = 6.1; // refreshes, in which a display shows all that it has been given

constexpr int patchShare = 12; // of the screen's height

} // namespace

StimulusDisplay::StimulusDisplay(const DisplayOptions& options, const Curtain& curtain)
    : receiver_(options.trigger), trigger_(receiver_.empty() ? nullptr : openTrigger(receiver_)),
      priority_(askForPriority()), window_(options.window), grey_(options.grey),
      photodiode_(options.photodiode), windowed_(options.window.windowed.has_value()) {
    keepPriorityFromNewThreads();
    const Image8 image = curtain(window_.width(), window_.height());
    const gl::Picture picture(image.width, image.height, image.channels, image.pixels);
    for (int i = 0; i < warmUpFlips; ++i)
        show(&picture);
    check_.variable = window_.forbidVariableRefresh(); // which drivers ask for at the first swap
    measure(picture);
    check(picture);
}

// By the best clock that can be believed.
void StimulusDisplay::measure(const gl::Picture& curtain) {
    if (window_.countsBlanks() && measureBy(Stamp::blanks, curtain))
        return;
    if (measureBy(Stamp::finish, curtain))
        return;
    window_.stampBy(Stamp::none);
    ticks_.emplace(refresh_.hz);
}

bool StimulusDisplay::measureBy(Stamp stamp, const gl::Picture& curtain) {
    window_.stampBy(stamp);
    std::vector<gl::Onset> onsets;
    std::vector<double> intervals, now;
    for (int i = 0; i <= measuredFlips; ++i) {
        draw(std::array{centred(curtain)}, grey_, false);
        onsets.push_back(window_.swap());
        now.push_back(window_.now());
        if (i > 0)
            intervals.push_back(onsets.back().time - onsets[onsets.size() - 2].time);
    }
    check_.reportedHz = window_.monitor().refreshHz;
    refresh_ = judgeRefresh(intervals, check_.reportedHz);
    check_.flips = summarise(intervals, refresh_.hz);
    check_.unsynchronised = refresh_.doubt;
    if (refresh_.source == "none" ||
        (stamp == Stamp::blanks && !plausible(onsets, now, check_.reportedHz)))
        return false;
    if (stamp == Stamp::blanks)
        refresh_.source = "oml";
    return true;
}

void StimulusDisplay::check(const gl::Picture& curtain) {
    check_.compositor = window_.composited();
    check_.contentScale = window_.contentScale();
    check_.colourBits = window_.colourBits();
    if (!ticks_)
        check_.queued = queuedSwaps(burst(curtain), refresh_.hz);
    if (const std::string objection = objectionTo(check_); !objection.empty()) {
        refresh_.source = "none";
        refresh_.doubt = objection;
    }
}

// How long the first swaps take after a pause that began, and so ends, just after a blank.
std::vector<double> StimulusDisplay::burst(const gl::Picture& curtain) {
    const bool blanks = refresh_.source == "oml";
    window_.stampBy(Stamp::finish); // blanks would be waited for
    show(&curtain);
    std::this_thread::sleep_for(std::chrono::duration<double>(pause / refresh_.hz));
    std::vector<double> intervals;
    for (double last = window_.now(); intervals.size() < burstFlips;) {
        const double time = show(&curtain);
        intervals.push_back(time - last);
        last = time;
    }
    if (blanks)
        window_.stampBy(Stamp::blanks);
    return intervals;
}

std::string StimulusDisplay::inWords() const {
    return fmt::format("{}; timestamps: {}; scheduling: {}; memory: {}", obscura::inWords(check_),
                       refresh_.source, priority_.scheduling, priority_.memory);
}

void StimulusDisplay::describe(nlohmann::ordered_json& sidecar) const {
    const gl::Monitor& monitor = window_.monitor();
    const gl::Driver driver = window_.driver();
    sidecar["display"] = {
        {"monitor", monitor.name},
        {"mode", fmt::format("{}x{}", monitor.width, monitor.height)},
        {"reported_hz", monitor.refreshHz},
        {"size_mm", fmt::format("{}x{}", monitor.widthMm, monitor.heightMm)},
        {"framebuffer", fmt::format("{}x{}", window_.width(), window_.height())},
        {"content_scale", window_.contentScale()},
        {"windowed", windowed_},
        {"photodiode", photodiode_},
        {"gl_vendor", driver.vendor},
        {"gl_renderer", driver.renderer},
        {"gl_version", driver.version},
        {"check", spell(check_)},
        {"scheduling", priority_.scheduling},
        {"memory", priority_.memory},
    };
    describeMarks(sidecar);
}

void StimulusDisplay::mark(double onset, int trial, int phase, std::string_view name) {
    if (trigger_)
        trigger_->send({onset, window_.now() - onset, trial, phase, name});
}

void StimulusDisplay::countMarks() {
    if (trigger_)
        trigger_->restart();
}

void StimulusDisplay::describeMarks(nlohmann::ordered_json& sidecar) const {
    if (!trigger_)
        return;
    sidecar["trigger"] = {{"receiver", receiver_}};
    sidecar["trigger"].update(trigger_->counts());
}

void StimulusDisplay::warmUp(const gl::Picture& picture) {
    if (picture.width() > window_.width() || picture.height() > window_.height())
        throw Error(fmt::format("images of {}x{} pixels do not fit on a screen of {}x{}, and are "
                                "never scaled; choose a larger monitor (--monitor), a larger "
                                "window, or a smaller image size in the protocol",
                                picture.width(), picture.height(), window_.width(),
                                window_.height()));
    draw(std::array{centred(picture)}, grey_, false);
    window_.finish();
    window_.check();
}

double StimulusDisplay::show(const gl::Picture* picture, bool stimulus) {
    if (!picture)
        return show({}, grey_, stimulus);
    return show(std::array{centred(*picture)}, grey_, stimulus);
}

// With a clock in place of blanks, all is drawn before the tick, and swapped at it.
double StimulusDisplay::show(std::span<const Placed> pictures, int grey, bool stimulus) {
    draw(pictures, grey, stimulus);
    if (ticks_) {
        window_.finish();
        ticks_->await();
    }
    return window_.swap().time;
}

void StimulusDisplay::draw(std::span<const Placed> pictures, int grey, bool stimulus) {
    window_.clear(grey);
    for (const Placed& placed : pictures)
        window_.draw(*placed.picture, placed.x, placed.y);
    if (photodiode_)
        window_.fillCorner(window_.height() / patchShare, stimulus ? 255 : 0);
}

Placed StimulusDisplay::centred(const gl::Picture& picture) const {
    return {&picture, (window_.width() - picture.width()) / 2,
            (window_.height() - picture.height()) / 2};
}

} // namespace obscura
