#include "experiment/presenter.h"

#include "experiment/pages.h"

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

gl::Picture upload(const Image8& image) {
    return {image.width, image.height, image.channels, image.pixels};
}

// Types or deletes one character; false for all other input.
bool edit(std::string& text, const gl::Input& input) {
    const bool typed =
        input.kind == gl::Input::Kind::text && input.symbol > 32 && input.symbol < 127;
    const bool deleted =
        input.kind == gl::Input::Kind::press && input.key == gl::Key::backspace && !text.empty();
    if (typed)
        text += static_cast<char>(input.symbol);
    if (deleted)
        text.pop_back();
    return typed || deleted;
}

} // namespace

Presenter::Presenter(Display& display, const Study& study, std::string warning)
    : display_(display), study_(study), warning_(std::move(warning)) {
    for (const PairRecord& pair : study.manifest.pairs)
        pairs_.push_back({load(study.manifest, pair.a), load(study.manifest, pair.b)});
    const Texts& texts = study.protocol.texts;
    question_ = sheet(questionPage(texts));
    leave_ = sheet(leavePage());
    display_.warmUp(question_.picture);
    // Texts that do not fit should stop the session before it begins.
    sheet(instructionsPage(texts));
    sheet(startPage(texts, 1, static_cast<int>(pairs_.size())));
    sheet(thanksPage(texts));
}

gl::Picture Presenter::load(const Manifest& manifest, const ImageRecord& record) {
    gl::Picture picture = upload(loadStimulus(manifest, record));
    display_.warmUp(picture);
    return picture;
}

Presenter::Sheet Presenter::sheet(Page page) const {
    page.warning = warning_;
    const gl::Window& window = display_.window();
    DrawnPage drawn = drawPage(page, window.width(), window.height(), study_.protocol.trial.grey);
    return {upload(drawn.image), std::move(drawn.options)};
}

double Presenter::showPicture(const gl::Picture* picture, const Sheet* sheet) {
    shown_ = picture;
    shownSheet_ = sheet;
    display_.window().showCursor(sheet != nullptr);
    return display_.show(picture);
}

std::vector<Event> Presenter::events(bool wait) {
    using Kind = gl::Input::Kind;
    std::vector<Event> events;
    for (const gl::Input& input : wait ? display_.window().wait() : display_.window().poll())
        switch (input.kind) {
        case Kind::press:
            events.push_back({Event::Kind::press, input.time, input.key});
            break;
        case Kind::release:
            events.push_back({Event::Kind::release, input.time, input.key});
            break;
        case Kind::focusLost:
            events.push_back({Event::Kind::focusLost, input.time});
            break;
        case Kind::close: // as if Escape were pressed
            events.push_back({Event::Kind::press, input.time, gl::Key::escape});
            events.push_back({Event::Kind::release, input.time, gl::Key::escape});
            break;
        case Kind::click:
            if (const int option = optionAt(input.x, input.y))
                events.push_back({Event::Kind::option, input.time, {}, option});
            break;
        case Kind::exposed: // something had covered the window
            if (wait)
                display_.show(shown_);
            break;
        case Kind::text:
            break;
        }
    return events;
}

// Of the page on the screen, from 1; 0 when there is none at that place.
int Presenter::optionAt(int x, int y) const {
    if (!shownSheet_)
        return 0;
    const auto& boxes = shownSheet_->options;
    const auto found = std::find_if(boxes.begin(), boxes.end(),
                                    [&](const Box& box) { return box.contains(x, y); });
    return found == boxes.end() ? 0 : static_cast<int>(found - boxes.begin()) + 1;
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
    showPicture(&page.picture, &page);
    events(false);
}

// Until Space or a click on the page's option; false when the person leaves instead.
bool Presenter::read(const Sheet& page) {
    turnTo(page);
    for (;;)
        for (const Event& event : answers()) {
            if (event.key == gl::Key::space || event.kind == Event::Kind::option)
                return true;
            if (event.key == gl::Key::escape) {
                if (leaves())
                    return false;
                turnTo(page);
            }
        }
}

bool Presenter::leaves() {
    turnTo(leave_);
    for (;;)
        for (const Event& event : answers()) {
            const int option =
                event.kind == Event::Kind::option ? event.option : optionOf(event.key);
            if (option != 0 || event.key == gl::Key::escape)
                return option == 2;
        }
}

bool Presenter::instruct() { return read(sheet(instructionsPage(study_.protocol.texts))); }

void Presenter::thank() {
    const Sheet page = sheet(thanksPage(study_.protocol.texts));
    turnTo(page);
    answers();
}

std::optional<std::string>
Presenter::askId(const std::function<std::string(const std::string&)>& objection) {
    std::string typed, problem;
    for (;;) {
        const Sheet page = sheet(idPage(typed, problem));
        showPicture(&page.picture, &page);
        for (const gl::Input& input : display_.window().wait()) {
            const bool press = input.kind == gl::Input::Kind::press;
            if (input.kind == gl::Input::Kind::close || (press && input.key == gl::Key::escape))
                return std::nullopt;
            if (press && input.key == gl::Key::enter && (problem = objection(typed)).empty())
                return typed;
            if (edit(typed, input))
                problem.clear();
        }
    }
}

void Presenter::prepare(const Upcoming& trial) {
    const auto& pair = pairs_.at(static_cast<std::size_t>(trial.condition));
    first_ = &pair[trial.reversed ? 1 : 0];
    second_ = &pair[trial.reversed ? 0 : 1];
    start_ = sheet(startPage(study_.protocol.texts, trial.index, trial.count));
}

double Presenter::show(Screen screen) {
    switch (screen) {
    case Screen::start:
        return showPicture(&start_.picture, &start_);
    case Screen::first:
        return showPicture(first_, nullptr);
    case Screen::second:
        return showPicture(second_, nullptr);
    case Screen::question:
        return showPicture(&question_.picture, &question_);
    case Screen::leave:
        return showPicture(&leave_.picture, &leave_);
    case Screen::mask:
        break;
    }
    return showPicture(nullptr, nullptr);
}

} // namespace obscura
