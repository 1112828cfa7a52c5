#include "experiment/presenter.h"

#include "experiment/data_folder.h"
#include "experiment/pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <future>
#include <thread>

namespace obscura {

namespace {

constexpr double progressInterval = 0.1;    // seconds
constexpr std::size_t expectedEvents = 256; // between two calls of events()

gl::Picture upload(const Image8& image) {
    return {image.width, image.height, image.channels, image.pixels};
}

} // namespace

Curtain curtain(const Study& study) {
    for (const Texts* texts : study.protocol.languages())
        checkShowable(*texts);
    return [&study](int width, int height) {
        const Page page = loadingPage(study.texts(), 0, imageCount(study.protocol));
        return drawPage(page, width, height, study.protocol.trial.grey).image;
    };
}

Presenter::Presenter(StimulusDisplay& display, const Study& study, std::string warning)
    : display_(display), study_(study), texts_(study.texts()),
      screens_(study.protocol, study.texts(), display.window().width(), display.window().height(),
               std::move(warning)),
      phases_(phasesOf(study.protocol.trial)), prepared_(phases_.size()) {
    screens_.check(); // what does not fit should stop the session before it begins
    leave_ = sheet(leavePage(texts_), "asked whether to end");
    loadImages();
    for (std::size_t i = 0; i < phases_.size(); ++i)
        if (const Phase& phase = phases_[i]; !phase.questions.empty()) {
            prepared_[i].sheet = uploaded(screens_.phase(phase, 1, 1), "");
            display_.warmUp(prepared_[i].sheet->picture);
        } else if (!phase.text.empty() && !phase.progress) {
            prepared_[i].sheet = uploaded(screens_.phase(phase, 1, 1), "");
        }
    display_.window().poll(); // what was pressed meanwhile was meant for nobody
    events_.reserve(expectedEvents);
}

// Files are read and decoded by as many threads as there are cores, no further ahead than that.
void Presenter::loadImages() {
    const Manifest& manifest = study_.manifest;
    struct Wanted {
        std::size_t condition;
        const ImageRecord* record;
    };
    std::vector<Wanted> wanted;
    for (std::size_t i = 0; i < manifest.conditions.size(); ++i)
        for (const ImageRecord& record : manifest.conditions[i].images)
            wanted.push_back({i, &record});
    std::deque<std::future<Image8>> ahead;
    const std::size_t threads = std::max(1u, std::thread::hardware_concurrency());
    pictures_.resize(manifest.conditions.size());
    double shown = display_.window().now();
    for (std::size_t next = 0, loaded = 0; loaded < wanted.size(); ++loaded) {
        while (next < wanted.size() && ahead.size() < threads)
            ahead.push_back(
                std::async(std::launch::async, [&manifest, record = wanted[next++].record] {
                    return loadStimulus(manifest, *record);
                }));
        gl::Picture& picture = pictures_[wanted[loaded].condition][wanted[loaded].record->role];
        picture = upload(ahead.front().get());
        ahead.pop_front();
        display_.warmUp(picture);
        display_.window().poll();
        if (display_.window().now() - shown > progressInterval) {
            const Sheet progress = sheet(
                loadingPage(texts_, static_cast<int>(loaded) + 1, static_cast<int>(wanted.size())),
                "");
            shown = display_.show(&progress.picture);
        }
    }
}

Presenter::Sheet Presenter::sheet(Page page, const std::string& title) const {
    return uploaded(screens_.page(std::move(page)), "Obscura: " + title);
}

Presenter::Sheet Presenter::uploaded(Screenful screen, std::string title) const {
    gl::Picture picture = upload(screen.drawn->image);
    screen.drawn->image = {}; // it is in graphics memory
    return {std::move(screen), std::move(title), std::move(picture)};
}

const gl::Picture& Presenter::picture(const std::string& image) const {
    return pictures_.at(static_cast<std::size_t>(trial_.planned.condition)).at(trial_.role(image));
}

void Presenter::place(const Screenful& screen, std::vector<Placed>& placed) const {
    for (std::size_t i = 0; i < screen.images.size(); ++i)
        placed.push_back({&picture(screen.images[i]), screen.places[i].x, screen.places[i].y});
}

double Presenter::showSheet(const Sheet& page) {
    sheet_ = &page;
    title_ = page.title;
    display_.window().showCursor(true);
    focused_ = display_.window().focused();
    if (!focused_)
        unfocused_ = uploaded(screens_.unfocused(page.screen), page.title);
    const Sheet& shown = focused_ ? page : unfocused_;
    placed_.assign(1, {&shown.picture, 0, 0});
    place(shown.screen, placed_);
    return display_.show(placed_, shown.screen.grey, !page.screen.images.empty());
}

double Presenter::showImages(std::span<const Placed> images, int grey) {
    sheet_ = nullptr;
    images_ = images;
    grey_ = grey;
    display_.window().showCursor(false);
    return display_.show(images_, grey_, !images_.empty());
}

void Presenter::announce() {
    if (announced_ == title_)
        return;
    display_.window().setTitle(title_);
    announced_ = title_;
}

// Sleeps until there is input. Before it sleeps, it announces in the window's title what is on the
// screen, and makes a page show whether this window has the keyboard.
const std::vector<gl::Input>& Presenter::inputs() {
    if (sheet_ && focused_ != display_.window().focused())
        showSheet(*sheet_);
    announce();
    const std::vector<gl::Input>* inputs = nullptr;
    do
        inputs = &(attend_ ? display_.window().wait(attend_()) : display_.window().wait());
    while (inputs->empty());
    const bool uncovered = std::any_of(inputs->begin(), inputs->end(), [](const gl::Input& input) {
        return input.kind == gl::Input::Kind::exposed;
    });
    if (uncovered && sheet_)
        showSheet(*sheet_);
    else if (uncovered)
        display_.show(images_, grey_, !images_.empty());
    return *inputs;
}

// The arrow to the right means the option on the right: on a page from right to left, the first.
gl::Key Presenter::asRead(gl::Key key) const {
    if (!sheet_ || !sheet_->screen.mirrored)
        return key;
    return key == gl::Key::left ? gl::Key::right : key == gl::Key::right ? gl::Key::left : key;
}

const std::vector<Event>& Presenter::events(bool wait) {
    using Kind = gl::Input::Kind;
    events_.clear();
    for (const gl::Input& input : wait ? inputs() : display_.window().poll())
        switch (input.kind) {
        case Kind::press:
            events_.push_back({Event::Kind::press, input.time, asRead(input.key)});
            break;
        case Kind::release:
            events_.push_back({Event::Kind::release, input.time, asRead(input.key)});
            break;
        case Kind::focusLost:
            events_.push_back({Event::Kind::focusLost, input.time});
            break;
        case Kind::close: // as if Escape were pressed
            events_.push_back({Event::Kind::press, input.time, gl::Key::escape});
            events_.push_back({Event::Kind::release, input.time, gl::Key::escape});
            break;
        case Kind::click:
            if (const Event event = clicked(input); event.option > 0)
                events_.push_back(event);
            break;
        case Kind::text:
            events_.push_back({Event::Kind::text, input.time, {}, 0, 0, input.symbol});
            break;
        case Kind::drag:
        case Kind::focusGained:
        case Kind::exposed:
            break;
        }
    return events_;
}

// Of the page on the screen, which of its options; 0 when there is none at that place.
Event Presenter::clicked(const gl::Input& input) const {
    Event event{Event::Kind::option, input.time};
    if (!sheet_)
        return event;
    const auto& boxes = (focused_ ? *sheet_ : unfocused_).screen.drawn->options;
    const auto found = std::find_if(boxes.begin(), boxes.end(),
                                    [&](const Box& box) { return box.contains(input.x, input.y); });
    if (found == boxes.end())
        return event;
    event.option = static_cast<int>(found - boxes.begin()) + 1;
    event.share = (input.x - found->x + 0.5) / found->width;
    if (sheet_->screen.page.rightToLeft)
        event.share = 1 - event.share;
    return event;
}

// For pages outside a trial: sleeps until there are presses or clicks.
std::vector<Event> Presenter::answers() {
    for (;;) {
        std::vector<Event> all = events(true);
        std::erase_if(all, [](const Event& event) {
            return event.kind != Event::Kind::press && event.kind != Event::Kind::option;
        });
        if (!all.empty())
            return all;
    }
}

// Drops what was pressed before the page was on the screen.
void Presenter::turnTo(const Sheet& page) {
    showSheet(page);
    display_.window().poll();
}

// Until Space or a click on the page's option; false when the person leaves instead.
bool Presenter::read(const Sheet& page) {
    turnTo(page);
    for (;;)
        for (const Event& event : answers()) {
            if (study_.protocol.keys.isGo(static_cast<int>(event.key)) ||
                event.kind == Event::Kind::option)
                return true;
            if (event.key == gl::Key::escape) {
                if (leaves())
                    return false;
                turnTo(page);
            }
        }
}

bool Presenter::leaves() { return choose(leave_) == 2; }

// Which of the page's two options was chosen, 1 or 2; 0 for Escape.
int Presenter::choose(const Sheet& page) {
    turnTo(page);
    for (;;)
        for (const Event& event : answers()) {
            const int option =
                event.kind == Event::Kind::option ? event.option : optionOf(event.key);
            if (option != 0 || event.key == gl::Key::escape)
                return option;
        }
}

bool Presenter::instruct() {
    display_.countMarks();
    return read(sheet(instructionsPage(texts_), "instructions"));
}

bool Presenter::rest() { return read(sheet(restPage(texts_), "break")); }

void Presenter::dismiss(Page page, std::string title) {
    const Sheet last = sheet(std::move(page), std::move(title));
    turnTo(last);
    answers();
}

void Presenter::preparePage(const Phase& page) {
    page_ = &page;
    drawn_ = {};
    const std::string title = "Obscura: " + page.name;
    preparedPage_ = {uploaded(screens_.phase(page, 0, 0), title), {}, 0, title};
}

void Presenter::prepare(const Upcoming& trial) {
    trial_ = trial;
    page_ = nullptr;
    drawn_ = {};
    for (std::size_t i = 0; i < phases_.size(); ++i) {
        const Phase& phase = phases_[i];
        Prepared& prepared = prepared_[i];
        prepared.title =
            phase.grey >= 0
                ? "" // nothing is done but show grey
                : fmt::format("Obscura: pair {} of {}, {}{}", trial.index, trial.count, phase.name,
                              phase.questions.empty() && phase.text.empty() ? " image" : "");
        title_.reserve(prepared.title.size());
        announced_.reserve(prepared.title.size());
        placed_.reserve(1 + phase.images.size());
        if (phase.progress && !phase.text.empty())
            prepared.sheet = uploaded(screens_.phase(phase, trial.index, trial.count), "");
        if (prepared.sheet) {
            prepared.sheet->title = prepared.title;
            continue;
        }
        const Screenful screen = screens_.phase(phase, trial.index, trial.count);
        prepared.images.clear();
        place(screen, prepared.images);
        prepared.grey = screen.grey;
    }
}

double Presenter::show(const TrialMachine& trial) {
    const bool comesOn = !trial.isOn() && trial.screen() != leaveScreen && !page_;
    const double onset = showScreen(trial);
    if (comesOn)
        display_.mark(onset, trial_.index, trial.screen() + 1,
                      phases_[static_cast<std::size_t>(trial.screen())].name);
    return onset;
}

double Presenter::showScreen(const TrialMachine& trial) {
    if (trial.screen() == leaveScreen)
        return showSheet(leave_);
    const auto index = static_cast<std::size_t>(trial.screen());
    const Phase& phase = page_ ? *page_ : phases_[index];
    const Prepared& prepared = page_ ? preparedPage_ : prepared_[index];
    if (const Form* form = trial.form(); form && form->changes() > 0) {
        if (drawn_ != std::pair(index, form->changes())) { // not at every refresh of a timed page
            answered_ =
                uploaded(screens_.phase(phase, trial_.index, trial_.count, *form), prepared.title);
            drawn_ = {index, form->changes()};
        }
        return showSheet(answered_);
    }
    if (prepared.sheet)
        return showSheet(*prepared.sheet);
    if (!prepared.title.empty())
        title_ = prepared.title;
    std::span<const Placed> images = prepared.images;
    if (phase.alternate > 0) {
        const std::size_t together = images.size() / static_cast<std::size_t>(phase.turns);
        images = images.subspan(static_cast<std::size_t>(trial.alternation()) * together, together);
    }
    return showImages(images, prepared.grey);
}

} // namespace obscura
