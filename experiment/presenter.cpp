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
    std::vector<Event> events;
    for (const gl::Input& input : wait ? display_.window().wait() : display_.window().poll()) {
        using Kind = gl::Input::Kind;
        if (input.kind == Kind::press)
            events.push_back({Event::Kind::press, input.time, input.key});
        else if (input.kind == Kind::release)
            events.push_back({Event::Kind::release, input.time, input.key});
        else if (input.kind == Kind::focusLost)
            events.push_back({Event::Kind::focusLost, input.time});
        else if (input.kind == Kind::close) { // as if Escape were pressed
            events.push_back({Event::Kind::press, input.time, gl::Key::escape});
            events.push_back({Event::Kind::release, input.time, gl::Key::escape});
        } else if (input.kind == Kind::click && shownSheet_) {
            for (std::size_t i = 0; i < shownSheet_->options.size(); ++i)
                if (shownSheet_->options[i].contains(input.x, input.y))
                    events.push_back(
                        {Event::Kind::option, input.time, {}, static_cast<int>(i) + 1});
        } else if (input.kind == Kind::exposed && wait)
            display_.show(shown_); // something had covered the window
    }
    return events;
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

// Until Space or a click on the page's option; false when the person leaves instead.
bool Presenter::read(const Sheet& page) {
    events(false); // what was pressed for the page before
    showPicture(&page.picture, &page);
    for (;;)
        for (const Event& event : answers()) {
            if (event.key == gl::Key::space || event.kind == Event::Kind::option)
                return true;
            if (event.key == gl::Key::escape) {
                if (leaves())
                    return false;
                showPicture(&page.picture, &page);
            }
        }
}

bool Presenter::leaves() {
    showPicture(&leave_.picture, &leave_);
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
    showPicture(&page.picture, &page);
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
