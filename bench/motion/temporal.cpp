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

class Measurement {
  public:
    Measurement(const TemporalStudy& study, const TemporalProgress& progress)
        : study_(study), progress_(progress),
          shots_(study.scene, study.configurations, study.effort.width, study.effort.height),
          all_(study.configurations.size()) {
        std::iota(all_.begin(), all_.end(), std::size_t{0});
    }

    std::vector<StabilityCell> run() {
        for (const std::string& id : study_.effort.tests) {
            const TemporalTest& test = temporalTest(id);
            test.cyclesNoise ? measureStill(test) : measureMotion(test);
            ++testsDone_;
        }
        if (auto animated = writeAnimation(study_, shots_, noiseSeed, records_))
            cells_.push_back(std::move(*animated));
        return std::move(cells_);
    }

  private:
    void tell(const TemporalTest& test, int frame) const {
        const double share = static_cast<double>(frame) / study_.effort.frames;
        if (progress_)
            progress_((testsDone_ + share) / static_cast<double>(study_.effort.tests.size()),
                      std::string(test.test.id));
    }

    Camera cameraOf(const TemporalTest& test, int frame) const {
        return test.camera(study_.start, frame, study_.effort.frames);
    }

    // With truth.
    Shot takeInMotion(const Camera& camera) const {
        Shot shot = shots_.take(camera, noiseSeed, all_);
        TraceSettings settings;
        settings.radius = study_.radius;
        settings.rays = study_.effort.rays;
        settings.seed = truthSeed;
        shot.truth = shots_.truth(shot.surfaces, settings);
        return shot;
    }

    void measureStill(const TemporalTest& test) {
        std::vector<StillNoise> noises(all_.size());
        Shot shot;
        for (int frame = 0; frame < study_.effort.frames; ++frame) {
            tell(test, frame);
            shot = shots_.take(cameraOf(test, frame), noiseSeed + static_cast<std::uint64_t>(frame),
                               all_);
            for (const std::size_t i : all_)
                noises[i].add(shot.visibilities[i]);
        }
        for (const std::size_t i : all_) {
            const Image deviation = noises[i].deviation();
            const Magnitudes values = magnitudes(deviation, shot.shown);
            const std::string picture =
                writePicture(i, test, std::array{shot.visibilities[i], amplified(deviation)});
            addCell(i, test, test.test.measure, values.mean(), picture,
                    values.percentile(1) > 0 ? "" : "no seed changes it");
            addCell(i, test, "deviation over frames, 99th percentile", values.percentile(0.99));
        }
    }

    void measureMotion(const TemporalTest& test) {
        std::vector<MotionError> errors(all_.size());
        MotionRecord record{&test, {}, {}, {}};
        std::optional<Shot> last;
        std::optional<FrameStep> lastStep;
        for (int frame = 0; frame < study_.effort.frames; ++frame) {
            tell(test, frame);
            const Camera camera = cameraOf(test, frame);
            // The same view gives the same picture again, because no technique remembers earlier
            // frames.
            if (last && sameView(camera, cameraOf(test, frame - 1)))
                continue;
            Shot shot = takeInMotion(camera);
            std::optional<FrameStep> step;
            if (last)
                step = stepBetween(*last, shot);
            for (const std::size_t i : all_)
                if (step)
                    errors[i].step(shot.visibilities[i], *step, lastStep ? &*lastStep : nullptr);
                else
                    errors[i].start(shot.visibilities[i]);
            record.truths.push_back(shot.truth);
            lastStep = std::move(step);
            last = std::move(shot);
        }
        for (const std::size_t i : all_)
            addMotionCells(i, errors[i], record);
        records_.push_back(std::move(record));
    }

    void addMotionCells(std::size_t i, const MotionError& error, MotionRecord& record) {
        const TemporalTest& test = *record.test;
        const Image& truth = record.truths[static_cast<std::size_t>(error.worstFrame())];
        record.unreal.push_back(error.unreal().mean());
        record.truthfulness.push_back(occlusion(error.worst()) / occlusion(truth));
        const std::string picture = writePicture(
            i, test, std::array{error.worst(), truth, amplified(error.unrealPicture())});
        addCell(i, test, test.test.measure, record.unreal.back(), picture,
                fmt::format("shows {:.0f} % of the truth's occlusion",
                            100 * record.truthfulness.back()));
        addCell(i, test, unrealChange99, error.unreal().percentile(0.99));
        addCell(i, test, "unreal change pixel by pixel, mean", error.unrealAtPixels().mean());
        addCell(i, test, "unreal change pixel by pixel, 99th percentile",
                error.unrealAtPixels().percentile(0.99));
        addCell(i, test, "warping error", error.warpingError());
        if (error.second().count() == 0)
            return;
        addCell(i, test, "second difference, mean", error.second().mean());
        addCell(i, test, "second difference, 99th percentile", error.second().percentile(0.99));
    }

    std::string writePicture(std::size_t configuration, const TemporalTest& test,
                             std::span<const Image> images) const {
        std::string name = pictureName(test.test.id, study_.configurations[configuration].name);
        writePng(study_.folder / name, strip(images));
        return name;
    }

    void addCell(std::size_t configuration, const TemporalTest& test, std::string_view measure,
                 double value, const std::string& picture = {}, const std::string& note = {}) {
        const NamedSettings& named = study_.configurations[configuration];
        cells_.push_back({named.name, std::string(named.settings.technique().id),
                          std::string(test.test.id), std::string(measure), value, picture, note});
    }

    const TemporalStudy& study_;
    const TemporalProgress& progress_;
    Shots shots_;
    std::vector<std::size_t> all_; // configurations
    std::vector<MotionRecord> records_;
    std::vector<StabilityCell> cells_;
    int testsDone_ = 0;
};

} // namespace

TemporalEffort fullTemporalEffort() {
    return {256, 144, 60, 256, {"still", "dolly", "orbit", "turn", "cut"}};
}

TemporalEffort quickTemporalEffort() { return {192, 108, 12, 128, {"still", "dolly", "turn"}}; }

std::vector<StabilityCell> measureTemporal(const TemporalStudy& study,
                                           const TemporalProgress& progress) {
    if (study.effort.frames < 3)
        throw Error(
            fmt::format("expected at least 3 frames a test, found {}", study.effort.frames));
    return Measurement(study, progress).run();
}

} // namespace obscura
