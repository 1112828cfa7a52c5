#include "bench/study_options.h"

#include "base/arguments.h"
#include "base/error.h"
#include "renderer/reference/reference_cache.h"

#include <fmt/format.h>

#include <cstdlib>

namespace obscura {

namespace {

namespace fs = std::filesystem;

std::vector<ImageSize> sizesOf(const std::vector<std::string>& texts) {
    std::vector<ImageSize> sizes;
    for (const std::string& text : texts) {
        const auto pair = parsePair(text, 'x');
        if (!pair || std::min(pair->first, pair->second) < 16 ||
            std::max(pair->first, pair->second) > 8192)
            throw Error(
                fmt::format("expected --size WIDTHxHEIGHT, each 16 ... 8192, found \"{}\"", text));
        sizes.push_back({pair->first, pair->second});
    }
    return sizes;
}

} // namespace

void addStudyOptions(CLI::App& command, StudyOptions& options) {
    const char* scenes = std::getenv("OBSCURA_SCENES");
    options.scenes = scenes ? scenes : ".";
    command.add_option("--out", options.out, "result folder; default named after the study");
    command.add_option("--scenes", options.scenes, "folder of glTF scenes; default OBSCURA_SCENES");
    command.add_option("--device", options.device,
                       "render with this device of obscura-render --devices");
    command.add_option("--size", options.sizes,
                       "WIDTHxHEIGHT instead of the study's sizes; may be repeated");
    command
        .add_option("--seconds", options.seconds,
                    "timed of each configuration and view, or the study's number of frames")
        ->check(numberFrom(0, 86400));
    command.add_option("--display", options.display,
                       "on which JOD is predicted, instead of the study's: a name, as "
                       "standard_4k, or NUMBER, as peak=100; may be repeated");
    command.add_option("--hours", options.hours, "that references may take")
        ->check(numberFrom(0, 1e6))
        ->capture_default_str();
    command.add_flag("--quick", options.quick,
                     "a first look in minutes: few views, small, hardly timed");
}

void adjust(SweepStudy& study, const StudyOptions& options, std::size_t quickViews) {
    if (options.quick)
        study = quick(std::move(study), quickViews);
    if (!options.sizes.empty())
        study.sizes = sizesOf(options.sizes);
    if (options.seconds >= 0)
        study.seconds = options.seconds;
    if (!options.display.empty())
        study.display = displayOf(options.display);
}

SweepPlan planOf(const StudyOptions& options, const fs::path& folder) {
    SweepPlan plan{folder, defaultCache()};
    plan.hours = options.hours;
    plan.share.measured = options.measure == "errors"  ? Measured::errors
                          : options.measure == "times" ? Measured::times
                                                       : Measured::both;
    if (options.part.empty())
        return plan;
    const auto part = parsePair(options.part, '/');
    if (!part || part->first < 1 || part->first > part->second)
        throw Error(
            fmt::format("expected --part I/N with I from 1 to N, found \"{}\"", options.part));
    plan.share.part = part->first;
    plan.share.parts = part->second;
    return plan;
}

} // namespace obscura
