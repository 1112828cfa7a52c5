#include "bench/stability/motion_tasks.h"

#include "base/files.h"
#include "bench/measure/tested_technique.h"
#include "bench/stability/finding_text.h"
#include "bench/stability/page.h"
#include "image/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace obscura {

namespace fs = std::filesystem;

namespace {

// What a part's frames cost beside its techniques is then a tenth.
constexpr std::size_t together = 6;
const std::array<std::string, 1> channel{"V"};

bool moves(const std::string& test) { return !temporalTest(test).cyclesNoise; }

// Images of one size below each other, and back.
Image stacked(const std::vector<Image>& images) {
    Image all = images.at(0);
    for (std::size_t i = 1; i < images.size(); ++i)
        all.pixels.insert(all.pixels.end(), images[i].pixels.begin(), images[i].pixels.end());
    all.height *= static_cast<int>(images.size());
    return all;
}

std::vector<Image> unstacked(const Image& all, int height) {
    std::vector<Image> images;
    const std::ptrdiff_t size = std::ptrdiff_t{all.width} * height;
    for (auto at = all.pixels.begin(); at != all.pixels.end(); at += size)
        images.push_back({all.width, height, 1, {at, at + size}});
    return images;
}

} // namespace

MotionTasks::MotionTasks(const Motion& motion, const std::vector<std::string>& configurations,
                         fs::path folder, std::string mark)
    : motion_(motion), folder_(std::move(folder)), mark_(std::move(mark)) {
    // The truth has a row of its own, which shows what its noise leaves: a technique below it
    // cannot be told from a perfect one.
    Settings truth(technique("ray_traced"));
    truth.set("rays", motion.effort.rays);
    parts_.push_back({truthName, {{truthName, truth}}});
    for (std::size_t i = 0; i < configurations.size(); ++i) {
        if (i % together == 0)
            parts_.emplace_back();
        Part& part = parts_.back();
        part.name += (part.name.empty() ? "" : " + ") + configurations[i];
        part.configurations.push_back(
            {configurations[i], TestedTechnique(configurations[i]).settings()});
    }
    for (Part& part : parts_)
        for (NamedSettings& each : part.configurations)
            if (each.settings.has("radius"))
                each.settings.set("radius", motion.radius);
}

MotionTasks::~MotionTasks() = default;

std::string MotionTasks::truthsUnit(const std::string& test) const {
    return fmt::format("frames of {} {}", test, mark_);
}

fs::path MotionTasks::truthsFile(const std::string& test) const {
    return folder_ / "units" / (plainName(truthsUnit(test)) + ".exr");
}

std::string MotionTasks::unitOf(const Part& part, const std::string& test) const {
    return fmt::format("{}: {} {}", test, part.name, mark_);
}

std::string MotionTasks::animationUnit() const {
    std::string all = fmt::format("{}", fmt::join(motion_.effort.tests, " "));
    for (const Part& part : parts_)
        all += "\n" + part.name;
    return fmt::format("animation {} {}", sha256(all).substr(0, 8), mark_);
}

// Costs are about those of a configuration in a test of still pictures.
std::vector<Task> MotionTasks::tasks(const ResultOf& resultOf) {
    std::vector<Task> tasks;
    for (const std::string& test : motion_.effort.tests)
        if (moves(test))
            tasks.push_back(
                {{truthsUnit(test), "frames", 20}, [this, test] { return traced(test); }});
    for (const Part& part : parts_)
        for (const std::string& test : motion_.effort.tests)
            tasks.push_back(
                {{unitOf(part, test), part.name,
                  part.name == truthName ? 20
                                         : 3.0 * static_cast<double>(part.configurations.size())},
                 [this, &part, test] { return measured(part, test); },
                 1});
    tasks.push_back(
        {{animationUnit(), "animation", 2}, [this, resultOf] { return animated(resultOf); }, 2});
    return tasks;
}

std::vector<std::string> MotionTasks::inOrder() const {
    std::vector<std::string> units;
    for (const std::string& test : motion_.effort.tests)
        for (const Part& part : parts_)
            units.push_back(unitOf(part, test));
    units.push_back(animationUnit());
    return units;
}

bool MotionTasks::stands(const std::string& unit, const std::string& result) const {
    return std::all_of(
        motion_.effort.tests.begin(), motion_.effort.tests.end(), [&](const std::string& test) {
            return unit != truthsUnit(test) ||
                   (fs::exists(truthsFile(test)) && sha256File(truthsFile(test)) == result);
        });
}

TemporalStudy MotionTasks::studyOf(const std::vector<NamedSettings>& configurations) const {
    return {motion_.scene, motion_.start, motion_.radius, configurations, motion_.effort, folder_};
}

// Of one part at a time: a worker stays with its part, and each has its own scene and shaders.
const TemporalMeasurement& MotionTasks::measurement(const Part& part) {
    if (current_ != &part) {
        measurement_ = std::make_unique<TemporalMeasurement>(studyOf(part.configurations));
        current_ = &part;
    }
    return *measurement_;
}

std::string MotionTasks::traced(const std::string& test) {
    writeExr(truthsFile(test), stacked(measurement(truths_).truths(temporalTest(test))), channel,
             true);
    return sha256File(truthsFile(test));
}

std::vector<Image> MotionTasks::truthsOf(const std::string& test) const {
    return moves(test) ? unstacked(readExr(truthsFile(test), channel), motion_.effort.height)
                       : std::vector<Image>();
}

std::string MotionTasks::measured(const Part& part, const std::string& test) {
    return findingText(measurement(part).measure(temporalTest(test), truthsOf(test)));
}

std::string MotionTasks::animated(const ResultOf& resultOf) const {
    std::vector<NamedSettings> all;
    for (const Part& part : parts_)
        all.insert(all.end(), part.configurations.begin(), part.configurations.end());
    std::vector<TemporalFinding> findings;
    std::vector<std::vector<Image>> truths;
    for (const std::string& test : motion_.effort.tests) {
        TemporalFinding& finding = findings.emplace_back();
        for (const Part& part : parts_) {
            const TemporalFinding some = readFinding(resultOf(unitOf(part, test)));
            finding.cells.insert(finding.cells.end(), some.cells.begin(), some.cells.end());
            finding.truthfulness.insert(finding.truthfulness.end(), some.truthfulness.begin(),
                                        some.truthfulness.end());
        }
        truths.push_back(truthsOf(test));
    }
    const auto cell = animationOf(studyOf(all), findings, truths);
    return findingText({cell ? std::vector{*cell} : std::vector<StabilityCell>(), {}});
}

} // namespace obscura
