#include "viewer/loader.h"

#include "base/error.h"
#include "renderer/render.h"
#include "viewer/seconds.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <list>
#include <map>
#include <mutex>
#include <regex>
#include <sstream>
#include <thread>

namespace obscura {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// Of the file and those that it names; 0 where nothing can be read, of which the reader tells.
double bytesOf(const fs::path& file) {
    std::error_code failed;
    const auto size = [&](const fs::path& path) {
        const std::uintmax_t bytes = fs::file_size(path, failed);
        return failed ? 0.0 : static_cast<double>(bytes);
    };
    double bytes = size(file);
    if (file.extension() != ".gltf" || bytes == 0 || bytes > 1e7)
        return bytes;
    std::ostringstream content;
    content << std::ifstream(file).rdbuf();
    const std::string text = content.str();
    static const std::regex uri(R"re("uri"\s*:\s*"([^":]+)")re"); // data: URIs lie in the text
    for (std::sregex_iterator at(text.begin(), text.end(), uri), end; at != end; ++at)
        bytes += size(file.parent_path() / (*at)[1].str());
    return bytes;
}

View viewOf(const SceneChoice& choice) {
    View view;
    view.file = choice.file;
    view.builtin = choice.builtin;
    view.ground = choice.ground;
    return view;
}

} // namespace

std::string nameOf(const SceneChoice& choice) {
    return choice.file.empty() ? choice.builtin : fs::path(choice.file).filename().string();
}

struct Loader::State {
    explicit State(std::function<void()> tell) : changed(std::move(tell)) {}

    void run(SceneId id, const SceneChoice& choice);
    void read(Loaded& loaded);
    bool stage(SceneId id, const char* name); // false where it was given up
    void expect(const Loaded& loaded);
    void remember(const Loaded& loaded);

    struct Thread {
        std::jthread thread;
        bool done = false;
    };

    std::function<void()> changed;
    mutable std::mutex mutex; // of all below
    SceneId current = 0;      // being read; 0: nothing
    SceneChoice choice;
    std::string what;
    Clock::time_point start;
    double expected = 1;        // seconds
    double bytesASecond = 10e6; // of files, as the last was read; at first, images of 8 bits
    std::map<std::string, double> took; // built-in scenes, seconds
    std::optional<Loaded> ready;
    std::list<Thread> threads; // last: they use all of the above
};

Loader::Loader(std::function<void()> changed)
    : state_(std::make_unique<State>(std::move(changed))) {}

Loader::~Loader() {
    abort();
    std::list<State::Thread> threads;
    {
        const std::lock_guard lock(state_->mutex);
        threads.swap(state_->threads);
    }
    for (State::Thread& each : threads)
        each.thread.join();
}

bool Loader::State::stage(SceneId id, const char* name) {
    {
        const std::lock_guard lock(mutex);
        if (current != id)
            return false;
        what = fmt::format("{}: {}", nameOf(choice), name);
    }
    changed();
    return true;
}

void Loader::State::read(Loaded& loaded) {
    try {
        auto scene = std::make_unique<Scene>(loadSceneOf(viewOf(loaded.choice), Folders{}));
        if (scene->indices.empty())
            throw Error("expected a scene with triangles, found none in it");
        if (!stage(loaded.id, "preparing rays"))
            return;
        loaded.rays = std::make_shared<const RayTracer>(*scene);
        if (!stage(loaded.id, "looking for a view"))
            return;
        loaded.view = framing(*scene, *loaded.rays, 1);
        loaded.scene = std::move(scene);
    } catch (const std::exception& error) {
        loaded.error = fmt::format("{}: {}", nameOf(loaded.choice), error.what());
    }
}

// How long it will take, as what was read before did.
void Loader::State::expect(const Loaded& loaded) {
    const double bytes = loaded.choice.file.empty() ? 0 : bytesOf(loaded.choice.file);
    const std::lock_guard lock(mutex);
    if (current != loaded.id)
        return;
    expected = std::max(bytes / bytesASecond, 0.2);
    if (loaded.choice.file.empty())
        expected = took.contains(loaded.choice.builtin) ? took[loaded.choice.builtin] : 2.0;
}

void Loader::State::remember(const Loaded& loaded) {
    if (loaded.choice.file.empty())
        took[loaded.choice.builtin] = loaded.seconds;
    else if (const double bytes = bytesOf(loaded.choice.file); bytes > 0)
        bytesASecond = bytes / std::max(loaded.seconds, 1e-3);
}

void Loader::State::run(SceneId id, const SceneChoice& chosen) {
    Loaded loaded;
    loaded.id = id;
    loaded.choice = chosen;
    const auto began = Clock::now();
    expect(loaded);
    read(loaded);
    loaded.seconds = secondsSince(began);
    {
        const std::lock_guard lock(mutex);
        for (Thread& each : threads)
            each.done |= each.thread.get_id() == std::this_thread::get_id();
        if (current != id)
            return;
        if (loaded.scene)
            remember(loaded);
        ready = std::move(loaded);
        current = 0;
    }
    changed();
}

void Loader::load(SceneId id, SceneChoice choice) {
    State& s = *state_;
    const std::lock_guard lock(s.mutex);
    s.threads.remove_if([](const State::Thread& each) { return each.done; }); // joins: it has ended
    s.ready.reset();
    s.current = id;
    s.choice = choice;
    s.what = fmt::format("{}: reading", nameOf(choice));
    s.start = Clock::now();
    s.threads.emplace_back();
    s.threads.back().thread =
        std::jthread([state = state_.get(), id, choice] { state->run(id, choice); });
}

void Loader::abort() {
    const std::lock_guard lock(state_->mutex);
    state_->current = 0;
    state_->ready.reset();
}

std::optional<Loaded> Loader::take() {
    const std::lock_guard lock(state_->mutex);
    return std::exchange(state_->ready, std::nullopt);
}

std::optional<Loader::Progress> Loader::progress() const {
    const std::lock_guard lock(state_->mutex);
    if (state_->current == 0)
        return std::nullopt;
    const double spent = secondsSince(state_->start), left = state_->expected - spent;
    return Progress{state_->what, std::min(spent / state_->expected, 0.98),
                    left > 0 ? left : std::numeric_limits<double>::quiet_NaN()};
}

} // namespace obscura
