#include "experiment/language.h"

#include "base/error.h"
#include "base/files.h"
#include "experiment/form.h"
#include "experiment/pages.h"
#include "experiment/text.h"
#include "protocols/reader/languages.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>
#include <vector>

namespace obscura {

namespace {

// The page on the screen.
class Choice {
  public:
    Choice(StimulusDisplay& display, const Protocol& protocol, const std::string& warning)
        : display_(display), protocol_(protocol), warning_(warning) {
        show();
        display_.window().poll(); // what was pressed before it was there
        display_.window().setTitle("Obscura: which language?");
    }

    // Which was chosen, from 0; nothing when the person leaves instead.
    std::optional<std::size_t> await() {
        for (;;) {
            if (focused_ != display_.window().focused())
                show();
            for (const gl::Input& input : std::vector(display_.window().wait())) {
                const bool press = input.kind == gl::Input::Kind::press;
                if (input.kind == gl::Input::Kind::close || (press && input.key == gl::Key::escape))
                    return std::nullopt;
                if (const auto chosen = press                                  ? pressed(input.key)
                                        : input.kind == gl::Input::Kind::click ? clicked(input)
                                                                               : std::nullopt)
                    return chosen;
                if (input.kind == gl::Input::Kind::exposed)
                    show();
            }
        }
    }

  private:
    void show() {
        Page page = languagePage(protocol_, offered_);
        page.warning = warning_;
        focused_ = display_.window().focused();
        const gl::Window& window = display_.window();
        drawn_ = drawPage(focused_ ? page : unfocused(page, protocol_.texts), window.width(),
                          window.height(), protocol_.trial.grey);
        const Image8& image = drawn_.image;
        const gl::Picture picture(image.width, image.height, image.channels, image.pixels);
        display_.window().showCursor(true);
        display_.show(&picture);
    }

    std::optional<std::size_t> pressed(gl::Key key) {
        const std::size_t count = drawn_.options.size();
        if (key == gl::Key::enter || key == gl::Key::keypadEnter)
            return offered_;
        if (const int digit = digitOf(key); digit >= 0) {
            const std::size_t option = digit == 0 ? 9 : static_cast<std::size_t>(digit - 1);
            return option < count ? std::optional(option) : std::nullopt;
        }
        const bool up = key == gl::Key::up && offered_ > 0;
        const bool down = key == gl::Key::down && offered_ + 1 < count;
        if (up || down) {
            offered_ += up ? -1 : 1;
            show();
        }
        return std::nullopt;
    }

    std::optional<std::size_t> clicked(const gl::Input& input) const {
        const auto& boxes = drawn_.options;
        const auto found = std::find_if(boxes.begin(), boxes.end(), [&](const Box& box) {
            return box.contains(input.x, input.y);
        });
        if (found == boxes.end())
            return std::nullopt;
        return static_cast<std::size_t>(found - boxes.begin());
    }

    StimulusDisplay& display_;
    const Protocol& protocol_;
    const std::string& warning_;
    DrawnPage drawn_;
    std::size_t offered_ = 0;
    bool focused_ = true;
};

// As the sidecar says; "" where it does not, or says one that the study no longer has.
std::string languageOf(const std::filesystem::path& sidecar, const Protocol& protocol) {
    if (!std::filesystem::exists(sidecar))
        return "";
    const auto said = nlohmann::json::parse(readFile(sidecar), nullptr, false);
    const auto language = said.is_object() ? said.find("language") : said.end();
    for (const Texts* texts : protocol.languages())
        if (language != said.end() && *language == texts->language)
            return texts->language;
    return "";
}

} // namespace

std::string languageNamed(const Protocol& protocol, const std::string& tag) {
    std::vector<std::string> known;
    for (const Texts* texts : protocol.languages()) {
        if (sameLanguage(texts->language, tag))
            return texts->language;
        if (!texts->language.empty())
            known.push_back(texts->language);
    }
    throw Error(fmt::format("--language: expected a language of the study, found \"{}\"; {}", tag,
                            known.empty() ? "it does not say which its own is"
                                          : fmt::format("it has {}", fmt::join(known, ", "))));
}

bool settleLanguage(Study& study, StimulusDisplay& display, const std::string& warning,
                    const std::filesystem::path& sidecar) {
    const Protocol& protocol = study.protocol;
    if (!study.language.empty() || protocol.translations.empty())
        return true;
    study.language = languageOf(sidecar, protocol);
    if (!study.language.empty())
        return true;
    const std::optional<std::size_t> chosen = Choice(display, protocol, warning).await();
    if (chosen)
        study.language = protocol.languages()[*chosen]->language;
    return chosen.has_value();
}

} // namespace obscura
