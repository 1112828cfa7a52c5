#include "experiment/timing_run.h"

#include "base/random.h"
#include "experiment/timing_count.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <string_view>
#include <thread>

namespace obscura {

namespace {

// An image is shown once, as in a trial, and stays for so long.
constexpr auto viewed = std::chrono::milliseconds(50);

// Noise in colour, of 4:3 of the screen's height: nothing that a driver could know to be simple.
gl::Picture noise(const gl::Window& window, std::string_view name) {
    const int height = window.height(), width = std::min(window.width(), height * 4 / 3);
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width * height) * 3);
    Random random(1, name);
    for (std::uint8_t& value : pixels)
        value = static_cast<std::uint8_t>(random.below(256));
    return {width, height, 3, pixels};
}

bool escapes(gl::Window& window) {
    const std::vector<gl::Input>& inputs = window.poll();
    return std::any_of(inputs.begin(), inputs.end(), [](const gl::Input& input) {
        return input.kind == gl::Input::Kind::close ||
               (input.kind == gl::Input::Kind::press && input.key == gl::Key::escape);
    });
}

// Nothing when Escape was pressed.
std::optional<MaskTiming> holdMask(StimulusDisplay& display, const TimingRun& run,
                                   const gl::Picture& after, int number) {
    RefreshCount count(run.refresh.hz, run.planned);
    while (count.refreshes() < run.planned) {
        const double time = display.show(nullptr);
        if (count.refreshes() == 0)
            display.mark(time, number, 1, "mask");
        count.add(time);
        if (escapes(display.window()))
            return std::nullopt;
    }
    const double time = display.show(&after, true);
    display.mark(time, number, 2, "image");
    count.end(time);
    return MaskTiming{count.seconds(), count.refreshes(), count.missed()};
}

} // namespace

int TimingRun::wrong() const {
    const auto off = [&](const MaskTiming& mask) {
        return mask.refreshes != planned || std::abs(mask.seconds * refresh.hz - planned) >= 0.5;
    };
    return static_cast<int>(std::count_if(masks.begin(), masks.end(), off));
}

int TimingRun::missed() const {
    int sum = 0;
    for (const MaskTiming& mask : masks)
        sum += mask.missed;
    return sum;
}

void holdMasks(StimulusDisplay& display, int masks, TimingRun& run,
               const std::function<void(int)>& progress) {
    run.refresh = display.refresh();
    run.planned = maskRefreshes(run.seconds, run.refresh.hz);
    run.masks.reserve(static_cast<std::size_t>(masks));
    const std::array images{noise(display.window(), "first"), noise(display.window(), "second")};
    for (const gl::Picture& image : images)
        display.warmUp(image);
    display.window().showCursor(false);
    display.show(&images[0], true);
    for (int i = 1; i <= masks; ++i) {
        std::this_thread::sleep_for(viewed);
        const auto mask = holdMask(display, run, images[static_cast<std::size_t>(i % 2)], i);
        if (!mask) {
            run.ended = "ended by Escape";
            return;
        }
        run.masks.push_back(*mask);
        progress(i);
    }
}

} // namespace obscura
