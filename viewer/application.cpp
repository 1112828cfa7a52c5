#include "viewer/application.h"

#include "viewer/meter.h"
#include "viewer/navigation.h"
#include "viewer/presets.h"
#include "viewer/seen.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <exception>

namespace obscura {

namespace {

namespace fs = std::filesystem;

// Heights and widths of the window's parts, logical pixels.
constexpr double barHeight = 41, statusHeight = 24, sideWidth = 352, paneGap = 2;

Box rightOf(double width, double top, double bottom, double windowWidth) {
    return {windowWidth - width, top, width, bottom - top};
}

State stateOf(const CommandLine& line) {
    State state;
    state.level = line.level;
    state.normals = line.normals;
    state.textures = line.textures;
    state.reference = line.reference;
    state.renderScale = line.renderScale;
    state.show = line.show;
    state.view.exposure = line.exposure;
    state.view.radius = line.radius.value_or(state.view.radius);
    state.panels = line.panels;
    state.help = line.help;
    const auto tab = std::find(tabNames().begin(), tabNames().end(), line.tab);
    if (tab != tabNames().end())
        state.tab = static_cast<Tab>(tab - tabNames().begin());
    for (std::size_t i = 0; i < line.techniques.size() && i < state.panes.size(); ++i)
        state.panes[i] = settingsOf(line.techniques[i], state.view.radius);
    const std::size_t panes = line.techniques.size();
    state.layout = line.layout.value_or(panes == 1  ? Layout::single
                                        : panes > 2 ? Layout::grid
                                                    : Layout::split);
    if (state.layout == Layout::single)
        state.selected = 0;
    return state;
}

} // namespace

Application::Application(const CommandLine& line)
    : line_(line), window_(line.width, line.height, line.uiScale), state_(stateOf(line)),
      worker_(std::make_unique<Worker>(window_.workerContext(), ViewerWindow::wake,
                                       !window_.sharesWithWorker())) {
    if (line_.scenes.empty())
        line_.scenes = ".";
    if (!line_.protocol.empty())
        desk_.protocol = line_.protocol.string();
    browser_.folder = fs::current_path();
    if (fs::is_directory(line_.scenes))
        browser_.folder = fs::canonical(line_.scenes);
    open(line.scene);
}

Application::~Application() = default;

void Application::open(const SceneChoice& choice) {
    opening_ = worker_->open(choice);
    if (!choice.file.empty())
        browser_.folder = fs::absolute(choice.file).parent_path();
    name(choice);
    message_.text.clear();
}

void Application::name(const SceneChoice& choice) {
    state_.scene = choice;
    window_.setTitle("Obscura – " + nameOf(choice));
}

// The found view, for pictures of this shape.
void Application::frameScene() {
    const auto [width, height] = pictureSize(state_.layout, area_, 0, 1);
    state_.view.camera = fitted(opened_->framing, static_cast<double>(width) / height);
    state_.views.front().camera = state_.view.camera;
    state_.viewAt = 0;
}

// Views that cannot be read are no reason not to show the scene.
std::vector<View> Application::storedOf(const View& view) try {
    return storedViews(viewsFolder(), view);
} catch (const Error& problem) {
    say(problem.what(), true);
    return {};
}

// Sets the exposure by the first pane's picture, where it is off by more than some stops, and that
// of the views that came with the scene: rooms are darker than the sky outside.
void Application::meter(double within) {
    if (!drawn_ || drawn_->wanted.show != Show::lit || drawn_->panes.empty())
        return;
    const Wanted& wanted = drawn_->wanted;
    const double exposure = meteredExposure(imageOf(*drawn_->panes.front().picture),
                                            wanted.level.curve, wanted.view.exposure);
    if (std::abs(exposure - wanted.view.exposure) <= within)
        return;
    state_.view.exposure = exposure;
    for (std::size_t i = 0; i < state_.views.size() && i <= opened_->cameras.size(); ++i)
        state_.views[i].exposure = exposure;
}

// What the command line says of the view counts for the scene that it names, and only once.
void Application::takeNews() {
    status_ = worker_->status();
    drawn_ = worker_->newest();
    probed_ = worker_->probed();
    if (drawn_)
        history_.add(*drawn_);
    const auto opened = worker_->opened();
    if (opened && opened != opened_) {
        opened_ = opened;
        name(opened->choice);
        state_.view.file =
            opened->choice.file.empty() ? "" : inScenesFolder(opened->choice.file, line_.scenes);
        state_.view.builtin = opened->choice.builtin;
        state_.view.ground = opened->choice.ground;
        adopt(state_, *opened, storedOf(state_.view));
        for (const View& view : line_.views)
            state_.views.push_back(view);
        frameScene();
        if (line_.camera)
            state_.view.camera = *line_.camera;
        if (line_.radius)
            setRadius(state_, *line_.radius);
        line_.camera.reset();
        line_.radius.reset();
        line_.views.clear();
        metering_ = line_.exposure == 0;
    }
    if (metering_ && drawn_ && drawn_->wanted.scene == opened_->id) {
        metering_ = false;
        if (drawn_->wanted.level.name != "low") // whose light is the same everywhere
            meter(1);
    }
    if (status_.error != lastError_) {
        lastError_ = status_.error;
        if (!lastError_.empty())
            say(lastError_, true);
    }
    // A scene that could not be opened leaves the one before.
    if (opened_ && !status_.loading && std::exchange(opening_, 0) > opened_->id)
        name(opened_->choice);
}

Wanted Application::wanted() const {
    Wanted wanted = wantedOf(state_, area_, static_cast<double>(window_.theme().scale) * paneGap);
    if (test_ && !test_->finished()) { // whose times nothing is to disturb
        wanted.reference = false;
        if (wanted.show == Show::error || wanted.show == Show::jod)
            wanted.show = Show::lit;
    }
    return wanted;
}

// ImGui sees the end of a click in the frame after it, opens a list in the next, and knows its size
// in the one after that. Whatever else happens has an effect on the frame that follows at most.
int Application::framesToSettle() const {
    const ImGuiIO& io = ImGui::GetIO();
    const bool pressed = std::any_of(std::begin(io.MouseClicked), std::end(io.MouseClicked),
                                     [](bool each) { return each; }) ||
                         std::any_of(std::begin(io.MouseReleased), std::end(io.MouseReleased),
                                     [](bool each) { return each; });
    return pressed || pressed_ ? 4 : 1;
}

void Application::step(double atMost) {
    window_.wait(settling_ > 0 ? 0 : std::min(atMost, wakeIn_));
    frame();
}

void Application::frame() {
    window_.begin();
    const bool panels = state_.panels;
    takeNews();
    takeKeys();
    for (const fs::path& path : window_.takeDropped())
        requests_.open = SceneChoice{path.string(), "", {}};
    area_ = drawPanels();
    if (panels && !state_.panels)
        say("Tab brings the panels back, F1 shows all keys.");
    const bool flying = fly();
    carryOut(std::exchange(requests_, {}));
    saveScreenshot();
    if (opened_) // until another scene is ready, this one is drawn
        worker_->want(wanted());
    worker_->probe(hand_.pixel ? std::optional(std::array{hand_.pixel->x, hand_.pixel->y})
                               : std::nullopt);
    window_.end();
    uploads_.forget();
    ++frames_;
    settling_ = settling_ > 0 ? settling_ - 1 : framesToSettle();
    if (flying)
        wakeIn_ = std::min(wakeIn_, 0.01);
}

Box Application::drawPanels() {
    Ui ui{window_.theme(), {}};
    const double width = window_.width(), height = window_.height();
    const double scale = static_cast<double>(window_.theme().scale);
    const bool panels = state_.panels;
    const double top = panels ? std::round(barHeight * scale) : 0;
    const double bottom = panels ? height - std::round(statusHeight * scale) : height;
    const double side = panels ? std::min(std::round(sideWidth * scale), width * 0.5) : 0;
    const Box area{0, top, width - side, bottom - top};
    Moment moment{ui,
                  state_,
                  opened_,
                  drawn_,
                  status_,
                  probed_,
                  history_,
                  test_.get(),
                  desk_,
                  requests_,
                  uploads_,
                  area,
                  window_.cursorLocked()};
    hand_ = picturesPanel(moment);
    if (panels) {
        barPanel(moment, {0, 0, width, top});
        sidePanel(moment, rightOf(side, top, height, width));
        statusPanel(moment, {0, bottom, width - side, height - bottom});
    }
    browserPanel(moment, browser_);
    if (state_.help)
        helpPanel(moment);
    if (!message_.text.empty() && !message_.error) {
        ui.wake(std::max(message_.until - window_.now(), 0.0) + 0.01);
        if (window_.now() > message_.until)
            message_.text.clear();
    }
    messagePanel(moment, message_);
    places_ = std::move(ui.places);
    wakeIn_ = ui.wakeIn;
    return area;
}

std::optional<Box> Application::where(const std::string& label) const {
    const auto found = places_.find(label);
    return found == places_.end() ? std::nullopt : std::optional(found->second);
}

bool Application::settled(int rays) {
    if (!status_.error.empty())
        return true;
    return drawn_ && !status_.loading && drawn_->wanted == wanted() &&
           worker_->waitUntilDrawn(0, rays) && worker_->newest() == drawn_;
}

Image8 Application::picture() {
    Image8 image;
    window_.afterDrawing = [&] { image = window_.picture(); };
    frame();
    window_.afterDrawing = {};
    return image;
}

void Application::run() {
    const bool traced = line_.reference || line_.show == Show::error || line_.show == Show::jod ||
                        std::any_of(line_.techniques.begin(), line_.techniques.end(),
                                    [](const TechniqueSetting& each) {
                                        return technique(each.technique).reads & rays;
                                    });
    while (!window_.closing()) {
        step(line_.picture.empty() ? std::numeric_limits<double>::infinity() : 0.05);
        if (!line_.picture.empty() && settled(traced ? line_.rays : 0))
            break;
    }
    if (!line_.picture.empty()) {
        frame(); // what has just arrived changes the panels' sizes
        frame();
        writePng(line_.picture, picture());
        if (!status_.error.empty())
            throw Error(status_.error);
    }
}

void Application::say(const std::string& text, bool error) {
    const double seconds =
        3 + 0.06 * static_cast<double>(text.size()); // at some 17 letters a second
    message_ = {text, error, window_.now() + seconds};
}

int runWindow(const CommandLine& line) {
    Application application(line);
    application.run();
    if (line.times)
        fmt::print("{} frames of the window, the longest took {:.1f} ms\n", application.frames(),
                   application.longestFrame() * 1000);
    return 0;
}

} // namespace obscura
