#include "viewer/test_mode.h"

#include "base/error.h"
#include "base/files.h"
#include "base/random.h"
#include "base/version.h"
#include "gl/context.h"
#include "matching/anchor.h"
#include "renderer/render.h"
#include "viewer/screenshot.h"

#include <fmt/format.h>

#include <chrono>
#include <set>
#include <utility>

namespace obscura {

namespace fs = std::filesystem;

namespace {

constexpr int fewestFrames = 3;

template <typename T>
void expectDifferentNames(const std::vector<T>& items, const char* kind) {
    if (items.empty())
        throw Error(fmt::format("expected at least one {} to test, found none", kind));
    std::set<std::string> names;
    for (const T& item : items)
        if (!names.insert(item.name).second)
            throw Error(fmt::format("expected {}s with names that differ, found \"{}\" twice", kind,
                                    item.name));
}

void check(const TestPlan& plan) {
    expectDifferentNames(plan.cameras, "camera");
    expectDifferentNames(plan.techniques, "technique");
    for (const TechniqueSetting& each : plan.techniques)
        if (settingsOf(each, 1).technique().reads & rays)
            throw Error(each.place, fmt::format("expected techniques of the screen, found \"{}\", "
                                                "which traces rays and has no frame rate",
                                                each.name));
    for (const char* name : {"test.csv", "passes.csv", "table.txt"})
        if (fs::exists(plan.out / name))
            throw Error({(plan.out / name).string(), 0, 0, {}},
                        "expected a folder without results of a test, for none is replaced; name "
                        "another one");
}

std::string sceneOf(const View& view) { return view.file.empty() ? view.builtin : view.file; }

} // namespace

TestMode::TestMode(TestPlan plan, const gl::Driver& driver, const gl::TimingChoice& timing)
    : plan_(std::move(plan)), machine_{driver.renderer, processorName(),
                                       timing.timing == gl::Timing::finish ? "finish" : "queries",
                                       fmt::format("obscura {} ({})", version(), commit())},
      painter_(timing.timing) {
    check(plan_);
    wanted_.level = plan_.level;
    wanted_.normals = plan_.normals;
    wanted_.textures = plan_.textures;
    wanted_.width = plan_.width;
    wanted_.height = plan_.height;
    beginRound();
}

void TestMode::beginRound() {
    ++round_;
    at_ = 0;
    order_.clear();
    for (std::size_t c = 0; c < plan_.cameras.size(); ++c)
        for (std::size_t t = 0; t < plan_.techniques.size(); ++t)
            order_.push_back({c, t});
    Random random(plan_.seed, fmt::format("test mode/{}", round_));
    random.shuffle(order_);
    // Scene after scene, for loading takes long.
    std::vector<std::string> scenes;
    for (const View& view : plan_.cameras)
        if (std::find(scenes.begin(), scenes.end(), sceneOf(view)) == scenes.end())
            scenes.push_back(sceneOf(view));
    random.shuffle(scenes);
    const auto rank = [&](const Entry& entry) {
        return std::find(scenes.begin(), scenes.end(), sceneOf(plan_.cameras[entry.camera]));
    };
    std::stable_sort(order_.begin(), order_.end(),
                     [&](const Entry& a, const Entry& b) { return rank(a) < rank(b); });
}

void TestMode::open(const View& view) {
    const std::string scene =
        sceneOf(view) + (view.ground ? fmt::format(" on {}", view.ground->wall) : "");
    if (scene == opened_)
        return;
    painter_.open(++scene_, loadSceneOf(view, {plan_.scenes, {}}));
    opened_ = scene;
}

void TestMode::beginEntry() {
    open(camera());
    wanted_.scene = scene_;
    wanted_.view = camera();
    wanted_.panes = {settingsOf(technique(), camera().radius)};
    row_ = {round_, static_cast<int>(at_) + 1, camera().name, technique().name, 0, 0, 0, 0, {}};
    drawWhole(); // compiles, and is not timed
}

Drawn TestMode::drawWhole() {
    painter_.forget();
    return painter_.draw(wanted_);
}

bool TestMode::next() {
    if (at_ == order_.size()) {
        if (round_ == plan_.rounds)
            return false;
        beginRound();
    }
    if (row_.round == 0)
        beginEntry();
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    const Drawn drawn = drawWhole();
    row_.seconds += std::chrono::duration<double>(Clock::now() - start).count();
    ++row_.frames;
    row_.gbufferMs += drawn.gbufferMs;
    row_.lightMs += drawn.lightMs;
    const std::vector<PassDrawn>& passes = drawn.panes[0].passes;
    if (row_.passes.empty())
        row_.passes = passes;
    else
        for (std::size_t i = 0; i < passes.size(); ++i)
            row_.passes[i].ms += passes[i].ms;
    if (row_.seconds >= plan_.seconds && row_.frames >= fewestFrames)
        endEntry(drawn);
    return true;
}

void TestMode::endEntry(const Drawn& last) {
    row_.gbufferMs /= row_.frames;
    row_.lightMs /= row_.frames;
    for (PassDrawn& pass : row_.passes)
        pass.ms /= row_.frames;
    finished_.push_back(std::exchange(row_, {}));
    if (round_ == 1)
        writeScreenshot(plan_.out, screenshotName(wanted_.view, wanted_.panes[0], wanted_.show),
                        imageOf(*last.panes[0].picture), painter_.visibility(0));
    if (++at_ < order_.size())
        return;
    rows_ = finished_;
    write();
}

void TestMode::write() const {
    writeFile(plan_.out / "test.csv", testCsv(plan_, machine_, rows_));
    writeFile(plan_.out / "passes.csv", passesCsv(rows_));
    writeFile(plan_.out / "table.txt", leedsTable(plan_, rows_));
}

double TestMode::share() const {
    const double each =
        1.0 / static_cast<double>(order_.size() * static_cast<std::size_t>(plan_.rounds));
    const double within = plan_.seconds > 0 ? std::min(row_.seconds / plan_.seconds, 1.0) : 0;
    return std::min(1.0, each * (static_cast<double>(finished_.size()) + within));
}

std::string TestMode::now() const {
    const std::size_t at = std::min(at_, order_.size() - 1);
    return fmt::format("round {} of {}: {}, {}", round_, plan_.rounds,
                       plan_.cameras[order_[at].camera].name,
                       plan_.techniques[order_[at].technique].name);
}

std::vector<TestRow> runTest(const TestPlan& plan, const TestStep& step,
                             const std::string& device) {
    const gl::Context context(device);
    TestMode test(plan, context.driver(), gl::honestTiming());
    while (test.next())
        if (!step(test.share(), test.now()))
            break;
    return test.rows();
}

} // namespace obscura
