#include "bench/motion/temporal_animation.h"

#include "bench/motion/temporal_pictures.h"
#include "bench/stability/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace obscura {

namespace fs = std::filesystem;

namespace {

constexpr int framesPerSecond = 10;

struct Choice {
    const MotionRecord* record = nullptr;
    std::size_t worst = 0, best = 0; // configurations
};

// The configurations of a record that are considered, the steadiest first.
std::vector<std::size_t> ranked(const TemporalStudy& study, const MotionRecord& record) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < study.configurations.size(); ++i)
        if (record.truthfulness[i] >= 0.5 &&
            !(study.configurations[i].settings.technique().reads & rays))
            order.push_back(i);
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return record.unreal[a] < record.unreal[b]; });
    return order;
}

std::optional<Choice> choose(const TemporalStudy& study, std::span<const MotionRecord> records) {
    std::optional<Choice> choice;
    for (const MotionRecord& record : records) {
        if (record.truths.size() < static_cast<std::size_t>(study.effort.frames))
            continue;
        const std::vector<std::size_t> order = ranked(study, record);
        if (!order.empty() &&
            (!choice || record.unreal[order.back()] > choice->record->unreal[choice->worst]))
            choice = {&record, order.back(), order.front()};
    }
    return choice;
}

Image unrealChange(const Shot& now, const Shot& before, const FrameStep& step, std::size_t which) {
    Image result = warpedChange(now.visibilities[which], before.visibilities[which], step.back);
    for (std::size_t i = 0; i < result.pixels.size(); ++i)
        result.pixels[i] = std::abs(result.pixels[i] - step.warpedChange.pixels[i]);
    return result;
}

} // namespace

std::optional<StabilityCell> writeAnimation(const TemporalStudy& study, std::uint64_t noiseSeed,
                                            std::span<const MotionRecord> records) {
    const std::optional<Choice> choice = choose(study, records);
    if (!choice)
        return std::nullopt;
    std::vector<NamedSettings> shown{study.configurations[choice->worst]};
    if (choice->best != choice->worst)
        shown.push_back(study.configurations[choice->best]);
    std::vector<std::size_t> which(shown.size());
    std::iota(which.begin(), which.end(), std::size_t{0});
    const Shots shots(study.scene, shown, study.effort.width, study.effort.height);
    const TemporalTest& test = *choice->record->test;
    std::vector<Image8> frames;
    std::optional<Shot> before;
    for (std::size_t frame = 0; frame < choice->record->truths.size(); ++frame) {
        const Camera camera =
            test.camera(study.start, static_cast<int>(frame), study.effort.frames);
        Shot shot =
            before ? shots.next(camera, noiseSeed, which) : shots.take(camera, noiseSeed, which);
        shot.truth = choice->record->truths[frame];
        if (before) {
            const FrameStep step = stepBetween(*before, shot);
            std::vector<AnimatedRow> rows;
            for (std::size_t i = 0; i < which.size(); ++i)
                rows.push_back({fmt::format("{}, {}", shown[i].name, test.test.id),
                                shot.visibilities[i], unrealChange(shot, *before, step, i)});
            frames.push_back(animationFrame(rows, shot.truth));
        }
        before = std::move(shot);
    }
    const NamedSettings& worst = shown.front();
    const std::string name =
        fs::path(pictureName(test.test.id, worst.name)).replace_extension("gif").string();
    writeGif(study.folder / name, frames, framesPerSecond);
    const auto unreal = [&](std::size_t i) { return choice->record->unreal[i]; };
    return StabilityCell{worst.name,
                         std::string(worst.settings.technique().id),
                         std::string(test.test.id),
                         std::string(worstFlicker),
                         unreal(choice->worst),
                         name,
                         which.size() < 2 ? ""
                                          : fmt::format("below it the steadiest, {}: {:.3f}",
                                                        shown.back().name, unreal(choice->best))};
}

} // namespace obscura
