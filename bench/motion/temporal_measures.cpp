#include "bench/motion/temporal_measures.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace obscura {

namespace {

constexpr double perUnit = 32768;
constexpr double missing = std::numeric_limits<double>::quiet_NaN();

} // namespace

void Magnitudes::add(double value) {
    assert(value >= 0 && value <= 2);
    ++counts_[static_cast<std::size_t>(std::lround(value * perUnit))];
    ++count_;
    sum_ += value;
}

double Magnitudes::mean() const {
    return count_ > 0 ? sum_ / static_cast<double>(count_) : missing;
}

double Magnitudes::percentile(double share) const {
    const double wanted = share * static_cast<double>(count_);
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
        below += counts_[i];
        if (below > 0 && static_cast<double>(below) >= wanted)
            return static_cast<double>(i) / perUnit;
    }
    return missing;
}

void StillNoise::add(const Image& visibility) {
    if (frames_++ == 0) {
        mean_ = visibility;
        squares_.assign(visibility.pixels.size(), 0);
        return;
    }
    for (std::size_t i = 0; i < squares_.size(); ++i) {
        const float difference = visibility.pixels[i] - mean_.pixels[i];
        mean_.pixels[i] += difference / static_cast<float>(frames_);
        squares_[i] += static_cast<double>(difference) *
                       static_cast<double>(visibility.pixels[i] - mean_.pixels[i]);
    }
}

Image StillNoise::deviation() const {
    assert(frames_ >= 2);
    Image result = mean_;
    for (std::size_t i = 0; i < squares_.size(); ++i)
        result.pixels[i] = static_cast<float>(std::sqrt(squares_[i] / (frames_ - 1)));
    return result;
}

Image warpedChange(const Image& now, const Image& before, const Reprojection& back) {
    Image result = now;
    for (std::size_t i = 0; i < result.pixels.size(); ++i)
        result.pixels[i] = back.valid(i) ? now.pixels[i] - back.fetch(before, i) : 0.0f;
    return result;
}

void MotionError::start(const Image& visibility) {
    before_ = visibility;
    unrealSums_ = visibility;
    std::fill(unrealSums_.pixels.begin(), unrealSums_.pixels.end(), 0.0f);
}

void MotionError::step(const Image& visibility, const FrameStep& step, const FrameStep* before) {
    ++steps_;
    addUnreal(visibility, step);
    addUnrealAtPixels(visibility, step);
    if (before)
        addSecond(visibility, step, *before);
    beforeThat_ = std::move(before_);
    before_ = visibility;
}

void MotionError::addUnreal(const Image& visibility, const FrameStep& step) {
    const Image change = warpedChange(visibility, before_, step.back);
    double sum = 0;
    for (std::size_t i = 0; i < change.pixels.size(); ++i) {
        if (!step.back.valid(i))
            continue;
        const float unreal = std::abs(change.pixels[i] - step.warpedChange.pixels[i]);
        unreal_.add(static_cast<double>(unreal));
        unrealSums_.pixels[i] += unreal;
        sum += static_cast<double>(unreal);
        warpedSquares_ += std::pow(static_cast<double>(change.pixels[i]), 2);
    }
    if (sum > worstSum_) {
        worstSum_ = sum;
        worstFrame_ = steps_;
        worst_ = visibility;
    }
}

void MotionError::addUnrealAtPixels(const Image& visibility, const FrameStep& step) {
    for (std::size_t i = 0; i < step.shown.size(); ++i)
        if (step.shown[i])
            unrealAtPixels_.add(static_cast<double>(
                std::abs(visibility.pixels[i] - before_.pixels[i] - step.change.pixels[i])));
}

void MotionError::addSecond(const Image& visibility, const FrameStep& step,
                            const FrameStep& before) {
    for (std::size_t i = 0; i < before_.pixels.size(); ++i)
        if (before.back.valid(i) && step.ahead.valid(i))
            second_.add(static_cast<double>(std::abs(before.back.fetch(beforeThat_, i) -
                                                     2 * before_.pixels[i] +
                                                     step.ahead.fetch(visibility, i))));
}

double MotionError::warpingError() const {
    return warpedSquares_ / static_cast<double>(unreal_.count());
}

Image MotionError::unrealPicture() const {
    Image result = unrealSums_;
    for (float& value : result.pixels)
        value /= static_cast<float>(steps_);
    return result;
}

void NewlySeen::step(const Reprojection& back) {
    std::vector<int> ages(ages_.size(), 0);
    for (std::size_t i = 0; i < ages.size(); ++i)
        if (const auto before = back.seenAt(i))
            ages[i] = std::min(ages_[*before] + 1, frames);
    ages_ = std::move(ages);
}

double TruthError::rmse() const {
    return count_ > 0 ? std::sqrt(squares_ / static_cast<double>(count_)) : missing;
}

} // namespace obscura
