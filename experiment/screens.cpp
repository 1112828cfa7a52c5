#include "experiment/screens.h"

#include "base/error.h"
#include "experiment/pages.h"
#include "experiment/selection.h"

#include <fmt/format.h>

#include <utility>

namespace obscura {

Screens::Screens(const Protocol& protocol, const Texts& texts, int width, int height,
                 std::string warning)
    : protocol_(protocol), texts_(texts), width_(width), height_(height),
      warning_(std::move(warning)) {}

Screenful Screens::page(Page page) const {
    page.warning = warning_;
    return drawn(std::move(page));
}

Screenful Screens::drawn(Page page) const {
    Screenful screen;
    screen.drawn = drawPage(page, width_, height_, protocol_.trial.grey);
    screen.places = screen.drawn->pictures;
    screen.mirrored = page.rightToLeft;
    screen.page = std::move(page);
    screen.grey = protocol_.trial.grey;
    return screen;
}

Screenful Screens::unfocused(const Screenful& screen) const {
    Screenful result = drawn(obscura::unfocused(screen.page, texts_));
    result.images = screen.images;
    result.mirrored = screen.mirrored;
    return result;
}

Screenful Screens::phase(const Phase& phase, int trial, int trials) const {
    return this->phase(
        phase, trial, trials,
        Form(phase.questions, static_cast<int>(protocol_.trial.order.size()), protocol_.keys));
}

Screenful Screens::phase(const Phase& phase, int trial, int trials, const Form& form) const {
    Screenful screen;
    screen.grey = phase.grey >= 0 ? phase.grey : protocol_.trial.grey;
    if (!phase.questions.empty()) {
        screen = page(formPage(texts_, form, roomFor(phase), phase.text));
        const auto focus = static_cast<std::size_t>(form.focus());
        screen.mirrored &=
            !(screen.page.parts.empty() ? screen.page.ofImages : screen.page.parts[focus].ofImages);
    } else if (!phase.text.empty())
        screen = page(textPage(texts_, phase, trial, trials));
    else if (!phase.images.empty())
        screen.places = gridOf(phase);
    screen.turns = phase.turns;
    const std::size_t turns = static_cast<std::size_t>(phase.turns);
    for (std::size_t turn = 0; turn < turns; ++turn)
        for (std::size_t i = turn; i < phase.images.size(); i += turns)
            screen.images.push_back(phase.images[i]);
    return screen;
}

Page::Pictures Screens::roomFor(const Phase& phase) const {
    return obscura::roomFor(phase, protocol_.width, protocol_.height);
}

// Beside each other in the middle of the screen, the same for each turn.
std::vector<Box> Screens::gridOf(const Phase& phase) const {
    Page::Pictures pictures = roomFor(phase);
    pictures.count /= phase.turns;
    std::vector<Box> boxes = obscura::gridOf(pictures, width_, 0);
    const int height = boxes.back().y + boxes.back().height;
    if (boxes.front().x < 0 || height > height_)
        throw Error(
            phase.place,
            fmt::format("{} images of {}x{} pixels do not fit beside each other on a screen "
                        "of {}x{}, and are never scaled; choose a larger monitor "
                        "(--monitor), or a smaller image size in the protocol",
                        pictures.count, pictures.width, pictures.height, width_, height_));
    for (Box& box : boxes)
        box.y += (height_ - height) / 2;
    std::vector<Box> all;
    for (int turn = 0; turn < phase.turns; ++turn)
        all.insert(all.end(), boxes.begin(), boxes.end());
    return all;
}

void Screens::check() const {
    const Texts& texts = texts_;
    const int images = imageCount(protocol_), trials = longest(protocol_);
    for (const Page& each :
         {loadingPage(texts, images, images), idPage(texts, "", texts.idMalformed),
          idPage(texts, "", texts.idTaken), instructionsPage(texts), restPage(texts),
          leavePage(texts), resumePage(texts, trials, trials), thanksPage(texts)})
        unfocused(page(each));
    if (!protocol_.before.empty())
        unfocused(page(declinedPage(texts)));
    for (const auto* pages : {&protocol_.before, &protocol_.after})
        for (const Phase& each : *pages)
            unfocused(phase(each, 0, 0));
    for (const Phase& each : phasesOf(protocol_.trial))
        if (const Screenful screen = phase(each, trials, trials); screen.drawn)
            unfocused(screen);
}

int imageCount(const Protocol& protocol) {
    int count = 0;
    for (const Condition& condition : protocol.conditions)
        count += static_cast<int>(condition.roles.size());
    return count;
}

} // namespace obscura
