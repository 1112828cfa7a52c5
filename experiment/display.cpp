#include "experiment/display.h"

#include "base/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

namespace obscura {

namespace {

constexpr int warmUpFlips = 10, measuredFlips = 100;

} // namespace

Display::Display(const gl::WindowOptions& options, int grey, const Curtain& curtain)
    : window_(options), grey_(grey), windowed_(options.windowed.has_value()) {
    const Image8 image = curtain(window_.width(), window_.height());
    measure({image.width, image.height, image.channels, image.pixels});
}

void Display::measure(const gl::Picture& curtain) {
    for (int i = 0; i < warmUpFlips; ++i)
        show(&curtain);
    std::vector<double> intervals;
    for (double last = show(&curtain); intervals.size() < measuredFlips;) {
        const double time = show(&curtain);
        intervals.push_back(time - last);
        last = time;
    }
    refresh_ = judgeRefresh(intervals, window_.monitor().refreshHz);
    paced_ = refresh_.source == "none";
}

void Display::describe(nlohmann::ordered_json& sidecar) const {
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
        {"gl_vendor", driver.vendor},
        {"gl_renderer", driver.renderer},
        {"gl_version", driver.version},
    };
}

void Display::warmUp(const gl::Picture& picture) {
    if (picture.width() > window_.width() || picture.height() > window_.height())
        throw Error(fmt::format("images of {}x{} pixels do not fit on a screen of {}x{}, and are "
                                "never scaled; choose a larger monitor (--monitor), a larger "
                                "window, or a smaller image size in the protocol",
                                picture.width(), picture.height(), window_.width(),
                                window_.height()));
    draw(std::array{centred(picture)}, grey_);
    window_.finish();
    window_.check();
}

double Display::show(const gl::Picture* picture) {
    if (!picture)
        return show({}, grey_);
    return show(std::array{centred(*picture)}, grey_);
}

double Display::show(std::span<const Placed> pictures, int grey) {
    draw(pictures, grey);
    if (paced_) {
        window_.finish();
        awaitTick();
    }
    window_.swap();
    return window_.now();
}

void Display::draw(std::span<const Placed> pictures, int grey) {
    window_.clear(grey);
    for (const Placed& placed : pictures)
        window_.draw(*placed.picture, placed.x, placed.y);
}

Placed Display::centred(const gl::Picture& picture) const {
    return {&picture, (window_.width() - picture.width()) / 2,
            (window_.height() - picture.height()) / 2};
}

// The next whole multiple of 1/60 s on the window's clock.
void Display::awaitTick() {
    const double tick = (std::floor(window_.now() * refresh_.hz) + 1) / refresh_.hz;
    while (window_.now() < tick)
        std::this_thread::sleep_for(std::chrono::duration<double>(tick - window_.now()));
}

} // namespace obscura
