#include "experiment/presenter.h"

#include "experiment/pages.h"

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

gl::Picture upload(const Image8& image) {
    return {image.width, image.height, image.channels, image.pixels};
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
    DrawnPage drawn =
        drawPage(page, window.width(), window.height(), study_.protocol.trial.grey);
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

} // namespace obscura
