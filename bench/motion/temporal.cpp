#include "bench/motion/temporal.h"

#include "base/error.h"
#include "bench/motion/temporal_animation.h"
#include "bench/motion/temporal_pictures.h"
#include "bench/stability/csv.h"

#include <fmt/format.h>

#include <array>
#include <numeric>
#include <optional>

namespace obscura {

namespace {

// No frame's noise has the truth's seed.
constexpr std::uint64_t truthSeed = 0, noiseSeed = 1;

bool sameView(const Camera& a, const Camera& b) {
    return a.position == b.position && a.target == b.target;
}

Magnitudes magnitudes(const Image& image, const std::vector<bool>& shown) {
    Magnitudes result;
    for (std::size_t i = 0; i < shown.size(); ++i)
        if (shown[i])
            result.add(static_cast<double>(image.pixels[i]));
    return result;
}

double occlusion(const Image& visibility) {
    double sum = 0;
    for (const float value : visibility.pixels)
        sum += 1 - static_cast<double>(value);
    return sum;
}

} // namespace

class TemporalMeasurement::Parts {
  public:
    explicit Parts(TemporalStudy study)
        : study_(std::move(study)),
          shots_(study_.scene, study_.configurations, study_.effort.width, study_.effort.height),
          all_(study_.configurations.size()) {
        if (study_.effort.frames < 3)
            throw Error(
                fmt::format("expected at least 3 frames a test, found {}", study_.effort.frames));
        std::iota(all_.begin(), all_.end(), std::size_t{0});
        for (const std::size_t i : all_)
            (accumulatedFrames(study_.configurations[i].settings) > 1 ? accumulating_ : single_)
                .push_back(i);
    }

    std::vector<Image> truths(const TemporalTest& test, const Tell& tell) const {
        std::vector<Image> truths;
        for (int frame = 0; !test.cyclesNoise && frame < study_.effort.frames; ++frame) {
            if (tell)
                tell();
            if (!isStill(test, frame))
                truths.push_back(truthOf(shots_.take(cameraOf(test, frame), noiseSeed, {})));
        }
        return truths;
    }

    TemporalFinding measure(const TemporalTest& test, const std::vector<Image>& truths,
                            const Tell& tell) const {
        return test.cyclesNoise ? measureStill(test, tell) : measureMotion(test, truths, tell);
    }

  private:
    Camera cameraOf(const TemporalTest& test, int frame) const {
        return test.camera(study_.start, frame, study_.effort.frames);
    }

    // The camera is where it was.
    bool isStill(const TemporalTest& test, int frame) const {
        return frame > 0 && sameView(cameraOf(test, frame), cameraOf(test, frame - 1));
    }

    Image truthOf(const Shot& shot) const {
        TraceSettings settings;
        settings.radius = study_.radius;
        settings.rays = study_.effort.rays;
        settings.seed = truthSeed;
        return shots_.truth(shot.surfaces, settings);
    }

    TemporalFinding measureStill(const TemporalTest& test, const Tell& tell) const {
        TemporalFinding finding;
        std::vector<StillNoise> noises(all_.size());
        std::vector<Image> last(all_.size());
        std::vector<bool> shown;
        const auto add = [&](Shot shot, std::span<const std::size_t> which) {
            for (std::size_t i = 0; i < which.size(); ++i) {
                noises[which[i]].add(shot.visibilities[i]);
                last[which[i]] = std::move(shot.visibilities[i]);
            }
            shown = std::move(shot.shown);
        };
        for (int frame = 0; frame < study_.effort.frames; ++frame) {
            if (tell)
                tell();
            const Camera camera = cameraOf(test, frame);
            if (!single_.empty())
                add(shots_.take(camera, noiseSeed + static_cast<std::uint64_t>(frame), single_),
                    single_);
            if (!accumulating_.empty()) // whose noise cycles by itself
                add(frame == 0 ? shots_.take(camera, noiseSeed, accumulating_)
                               : shots_.next(camera, noiseSeed, accumulating_),
                    accumulating_);
        }
        for (const std::size_t i : all_) {
            const Image deviation = noises[i].deviation();
            const Magnitudes values = magnitudes(deviation, shown);
            const std::string picture =
                writePicture(i, test, std::array{last[i], amplified(deviation)});
            addCell(finding, i, test, test.test.measure, values.mean(), picture,
                    values.percentile(1) > 0 ? "" : "no seed changes it");
            addCell(finding, i, test, "deviation over frames, 99th percentile",
                    values.percentile(0.99));
        }
        return finding;
    }

    TemporalFinding measureMotion(const TemporalTest& test, const std::vector<Image>& truths,
                                  const Tell& tell) const {
        std::vector<Errors> errors(all_.size());
        auto truth = truths.begin();
        std::optional<Shot> last;
        std::optional<FrameStep> lastStep;
        NewlySeen newly(static_cast<std::size_t>(study_.effort.width * study_.effort.height));
        int unmoved = 0; // frames since the camera moved
        for (int frame = 0; frame < study_.effort.frames; ++frame) {
            if (tell)
                tell();
            const Camera camera = cameraOf(test, frame);
            const bool still = isStill(test, frame);
            unmoved = still ? unmoved + 1 : 0;
            // Before a still camera nothing changes, but what came into sight by its last move.
            if (still && (!lastStep || unmoved >= NewlySeen::frames))
                continue;
            Shot shot =
                last ? shots_.next(camera, noiseSeed, all_) : shots_.take(camera, noiseSeed, all_);
            shot.truth = still ? last->truth : *truth++;
            if (last) {
                FrameStep step = stepBetween(*last, shot);
                newly.step(step.back);
                addTruthErrors(camera, shot, newly, errors);
                for (const std::size_t i : all_)
                    if (!still)
                        errors[i].motion.step(shot.visibilities[i], step,
                                              lastStep ? &*lastStep : nullptr);
                lastStep = std::move(step);
            } else {
                for (const std::size_t i : all_)
                    errors[i].motion.start(shot.visibilities[i]);
            }
            last = std::move(shot);
        }
        TemporalFinding finding;
        for (const std::size_t i : all_)
            addMotionCells(finding, i, test, errors[i], truths);
        return finding;
    }

    // Of one configuration.
    struct Errors {
        MotionError motion;
        TruthError everywhere, newlySeen; // against the truth
        TruthError ghosts, newGhosts;     // against its own still picture; where it accumulates
    };

    static void add(const Image& visibility, const Image& truth, const std::vector<bool>& shown,
                    const NewlySeen& newly, TruthError& everywhere, TruthError& newlySeen) {
        for (std::size_t pixel = 0; pixel < shown.size(); ++pixel)
            if (shown[pixel]) {
                everywhere.add(visibility.pixels[pixel], truth.pixels[pixel]);
                if (newly[pixel])
                    newlySeen.add(visibility.pixels[pixel], truth.pixels[pixel]);
            }
    }

    void addTruthErrors(const Camera& camera, const Shot& shot, const NewlySeen& newly,
                        std::vector<Errors>& errors) const {
        for (const std::size_t i : all_)
            add(shot.visibilities[i], shot.truth, shot.shown, newly, errors[i].everywhere,
                errors[i].newlySeen);
        const std::vector<Image> stills = shots_.stills(camera, noiseSeed, accumulating_);
        for (std::size_t k = 0; const std::size_t i : accumulating_)
            add(shot.visibilities[i], stills[k++], shot.shown, newly, errors[i].ghosts,
                errors[i].newGhosts);
    }

    void addMotionCells(TemporalFinding& finding, std::size_t i, const TemporalTest& test,
                        const Errors& errors, const std::vector<Image>& truths) const {
        const MotionError& error = errors.motion;
        const Image& truth = truths[static_cast<std::size_t>(error.worstFrame())];
        finding.truthfulness.push_back(occlusion(error.worst()) / occlusion(truth));
        const std::string picture = writePicture(
            i, test, std::array{error.worst(), truth, amplified(error.unrealPicture())});
        addCell(finding, i, test, test.test.measure, error.unreal().mean(), picture,
                fmt::format("shows {:.0f} % of the truth's occlusion",
                            100 * finding.truthfulness.back()));
        addCell(finding, i, test, unrealChange99, error.unreal().percentile(0.99));
        addCell(finding, i, test, "unreal change pixel by pixel, mean",
                error.unrealAtPixels().mean());
        addCell(finding, i, test, "unreal change pixel by pixel, 99th percentile",
                error.unrealAtPixels().percentile(0.99));
        addCell(finding, i, test, "warping error", error.warpingError());
        addCell(finding, i, test, "error against the truth, RMSE", errors.everywhere.rmse());
        if (errors.newlySeen.count() > 0)
            addCell(finding, i, test, errorNewlySeen, errors.newlySeen.rmse(), "",
                    fmt::format("{:.1f} % of all points",
                                100.0 * static_cast<double>(errors.newlySeen.count()) /
                                    static_cast<double>(errors.everywhere.count())));
        if (errors.ghosts.count() > 0)
            addCell(finding, i, test, "ghosts: difference from its still picture, RMSE",
                    errors.ghosts.rmse());
        if (errors.newGhosts.count() > 0)
            addCell(finding, i, test, "ghosts where newly seen, RMSE", errors.newGhosts.rmse());
        if (error.second().count() == 0)
            return;
        addCell(finding, i, test, "second difference, mean", error.second().mean());
        addCell(finding, i, test, "second difference, 99th percentile",
                error.second().percentile(0.99));
    }

    std::string writePicture(std::size_t configuration, const TemporalTest& test,
                             std::span<const Image> images) const {
        std::string name = pictureName(test.test.id, study_.configurations[configuration].name);
        writePng(study_.folder / name, strip(images));
        return name;
    }

    void addCell(TemporalFinding& finding, std::size_t configuration, const TemporalTest& test,
                 std::string_view measure, double value, const std::string& picture = {},
                 const std::string& note = {}) const {
        const NamedSettings& named = study_.configurations[configuration];
        finding.cells.push_back({named.name, std::string(named.settings.technique().id),
                                 std::string(test.test.id), std::string(measure), value, picture,
                                 note});
    }

    TemporalStudy study_;
    Shots shots_;
    std::vector<std::size_t> all_, single_, accumulating_; // configurations
};

TemporalMeasurement::TemporalMeasurement(TemporalStudy study)
    : parts_(std::make_unique<Parts>(std::move(study))) {}
TemporalMeasurement::~TemporalMeasurement() = default;

std::vector<Image> TemporalMeasurement::truths(const TemporalTest& test, const Tell& tell) const {
    return parts_->truths(test, tell);
}

TemporalFinding TemporalMeasurement::measure(const TemporalTest& test,
                                             const std::vector<Image>& truths,
                                             const Tell& tell) const {
    return parts_->measure(test, truths, tell);
}

std::optional<StabilityCell> animationOf(const TemporalStudy& study,
                                         const std::vector<TemporalFinding>& findings,
                                         const std::vector<std::vector<Image>>& truths) {
    std::vector<MotionRecord> records;
    for (std::size_t i = 0; i < findings.size(); ++i) {
        const TemporalTest& test = temporalTest(study.effort.tests[i]);
        MotionRecord record{&test, truths[i], {}, findings[i].truthfulness};
        for (const StabilityCell& cell : findings[i].cells)
            if (cell.measure == test.test.measure)
                record.unreal.push_back(cell.value);
        if (!test.cyclesNoise)
            records.push_back(std::move(record));
    }
    return writeAnimation(study, noiseSeed, records);
}

TemporalEffort fullTemporalEffort() {
    return {256, 144, 60, 256, {"still", "dolly", "orbit", "turn", "cut"}};
}

TemporalEffort quickTemporalEffort() { return {192, 108, 12, 128, {"still", "dolly", "turn"}}; }

std::vector<StabilityCell> measureTemporal(const TemporalStudy& study,
                                           const TemporalProgress& progress) {
    const TemporalMeasurement measurement(study);
    const double steps = 2.0 * static_cast<double>(study.effort.tests.size()) * study.effort.frames;
    double done = 0;
    std::vector<StabilityCell> cells;
    std::vector<TemporalFinding> findings;
    std::vector<std::vector<Image>> truths;
    for (const std::string& id : study.effort.tests) {
        const TemporalTest& test = temporalTest(id);
        const auto tell = [&] {
            if (progress)
                progress(done++ / steps, id);
        };
        truths.push_back(measurement.truths(test, tell));
        findings.push_back(measurement.measure(test, truths.back(), tell));
        cells.insert(cells.end(), findings.back().cells.begin(), findings.back().cells.end());
    }
    if (auto animated = animationOf(study, findings, truths))
        cells.push_back(std::move(*animated));
    return cells;
}

} // namespace obscura
