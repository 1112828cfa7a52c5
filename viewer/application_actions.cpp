// What the user asks for that is more than a value: scenes, studies, screenshots, tests.
#include "viewer/application.h"
#include "viewer/presets.h"
#include "viewer/screenshot.h"
#include "viewer/seen.h"
#include "viewer/technique_words.h"
#include "viewer/to_study.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

namespace {

std::string lines(const std::vector<std::string>& notes) {
    std::string text;
    for (const std::string& note : notes)
        text += "\n" + note;
    return text;
}

Seen seenOf(const State& state, const Wanted& wanted) {
    Seen seen;
    seen.view = state.view;
    const View& chosen = state.views[static_cast<std::size_t>(state.viewAt)];
    const bool unmoved = chosen.camera.position == state.view.camera.position &&
                         chosen.camera.target == state.view.camera.target;
    seen.view.name = unmoved ? chosen.name : "";
    seen.level = state.level;
    seen.normals = state.normals;
    seen.textures = state.textures;
    seen.width = wanted.width;
    seen.height = wanted.height;
    seen.panes = wanted.panes;
    return seen;
}

// The panes' techniques under names of their own, each once.
// Of each pane, once where two are alike.
std::vector<TechniqueSetting> techniquesOf(const Wanted& wanted) {
    std::vector<TechniqueSetting> all;
    std::vector<std::string> names;
    for (auto pane = wanted.panes.begin(); pane != wanted.panes.end(); ++pane) {
        if (std::any_of(wanted.panes.begin(), pane, [&](const Settings& before) {
                return &before.technique() == &pane->technique() &&
                       before.values() == pane->values();
            }))
            continue;
        TechniqueSetting setting = settingOf(*pane, wanted.view.radius);
        setting.name = newName(setting.name, names);
        names.push_back(setting.name);
        all.push_back(std::move(setting));
    }
    return all;
}

} // namespace

// What goes wrong here is the user's to mend, and the window's to say.
void Application::carryOut(const Requests& requests) try {
    if (requests.open)
        open(*requests.open);
    if (requests.browse)
        browser_.open = true;
    if (requests.frame && opened_)
        frameScene();
    if (requests.meter)
        meter(0);
    if (requests.copy) {
        window_.copyText(*requests.copy);
        say("Copied: " + *requests.copy);
    }
    if (requests.storeView && opened_)
        storePresentView();
    if (requests.forgetView)
        forgetChosenView();
    if (requests.screenshot)
        askForScreenshot();
    addStudy(requests);
    if (requests.startTest)
        startTest();
    if (requests.stopTest && test_)
        test_->stop();
} catch (const Error& problem) {
    say(problem.what(), true);
}

void Application::storePresentView() {
    const std::string stored = storeView(state_);
    storeView(viewsFolder(), state_.views.back());
    say("Stored as " + stored + ". C goes through the views.");
}

void Application::forgetChosenView() {
    const std::string forgotten = state_.views[static_cast<std::size_t>(state_.viewAt)].name;
    forgetView(viewsFolder(), state_.view, forgotten);
    state_.views.erase(state_.views.begin() + state_.viewAt);
    showView(state_, 0);
}

void Application::addStudy(const Requests& requests) {
    if (!opened_)
        return;
    if (requests.copySettings) {
        window_.copyText(tablesText(seenOf(state_, wanted())));
        say("Copied scene, light and techniques as TOML.");
    }
    if (requests.addPair) {
        const Added added = addPair(desk_.protocol, seenOf(state_, wanted()));
        say(fmt::format("Condition \"{}\" is in {}.{}", added.condition,
                        std::filesystem::absolute(desk_.protocol).string(), lines(added.notes)));
    }
    if (requests.writeSweep) {
        std::vector<View> views = state_.views;
        for (View& view : views) {
            view.file = state_.view.file;
            view.builtin = state_.view.builtin;
            view.ground = state_.view.ground;
        }
        writeSweep(desk_.sweep, views, seenOf(state_, wanted()));
        say(fmt::format("{} has {} views; obscura-bench sweep takes it.",
                        std::filesystem::absolute(desk_.sweep).string(), views.size()));
    }
}

void Application::askForScreenshot() {
    if (!drawn_ || !opened_ || shot_)
        return;
    shot_ = std::make_shared<Shot>();
    shot_->drawn = drawn_;
    worker_->capture([shot = shot_](std::vector<Image> visibilities) {
        const std::lock_guard lock(shot->mutex);
        shot->visibilities = std::move(visibilities);
        shot->taken = true;
    });
}

void Application::saveScreenshot() try {
    if (!shot_)
        return;
    std::vector<Image> visibilities;
    {
        const std::lock_guard lock(shot_->mutex);
        if (!shot_->taken)
            return;
        visibilities = std::move(shot_->visibilities);
    }
    const Drawn drawn = *std::exchange(shot_, nullptr)->drawn;
    const View view = seenOf(state_, drawn.wanted).view;
    std::string written;
    for (std::size_t i = 0; i < drawn.panes.size(); ++i) {
        const std::string name = screenshotName(view, drawn.wanted.panes[i], drawn.wanted.show);
        const Screenshot saved =
            writeScreenshot(desk_.pictures, name, imageOf(*drawn.panes[i].picture),
                            i < visibilities.size() ? visibilities[i] : Image{});
        written += (written.empty() ? "" : "\n") + saved.png.string();
    }
    say("Saved as PNG, and visibility as EXR beside:\n" + written);
} catch (const Error& problem) {
    say(problem.what(), true);
}

void Application::startTest() {
    if (!opened_ || (test_ && !test_->finished()))
        return;
    TestPlan plan;
    const Wanted now = wanted();
    plan.cameras = state_.views;
    for (View& view : plan.cameras) {
        view.file = state_.view.file;
        view.builtin = state_.view.builtin;
        view.ground = state_.view.ground;
    }
    plan.techniques = techniquesOf(now);
    plan.level = state_.level;
    plan.normals = state_.normals;
    plan.textures = state_.textures;
    plan.width = now.width;
    plan.height = now.height;
    plan.seconds = desk_.seconds;
    plan.rounds = static_cast<int>(desk_.rounds);
    plan.out = desk_.out;
    plan.scenes = line_.scenes;
    test_ = std::make_unique<TestRun>(plan, ViewerWindow::wake);
}

} // namespace obscura
