#include "experiment/preview.h"

#include "experiment/pages.h"
#include "experiment/play.h"
#include "experiment/refresh.h"
#include "image/canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <map>

namespace obscura {

namespace {

constexpr double shownHz = 60;
constexpr int margin = 24, gap = 20, header = 76, caption = 76; // pixels of the sheet
constexpr int fewestColumns = 3;

std::string timeOf(const Phase& phase) {
    const int frames = phase.frames > 0 ? phase.frames : maskRefreshes(phase.seconds, shownHz);
    return fmt::format("{:.4g} s, {} frame{} at {:g} Hz", frames / shownHz, frames,
                       frames == 1 ? "" : "s", shownHz);
}

std::string keyOf(const Phase& phase) {
    return (phase.text.empty() ? "Space" : "Space or a click") +
           (phase.atLeast > 0 ? fmt::format(", not before {:g} s", phase.atLeast) : "");
}

std::string answerOf(const Phase& phase) {
    return Form(phase.questions, 1).alone() ? "the answer: one key or click"
                                            : "Enter or a click on the button, once answered";
}

class Preview {
  public:
    Preview(const Study& study, int width, int height)
        : study_(study), screens_(study.protocol, study.texts(), width, height, ""),
          trial_(upcoming(study.protocol, obscura::next(study.protocol, 1, {}).value(), 1,
                          longest(study.protocol))) {}

    std::vector<PreviewedScreen> all() {
        const Texts& texts = study_.texts();
        for (const Phase& page : study_.protocol.before)
            add(page);
        add("instructions", "Space or a click", screens_.page(instructionsPage(texts)));
        for (const Phase& phase : phasesOf(study_.protocol.trial))
            add(phase);
        if (const int every = study_.protocol.ordering.breakEvery; every > 0)
            add("break", fmt::format("Space or a click; after every {} main trials", every),
                screens_.page(restPage(texts)));
        for (const Phase& page : study_.protocol.after)
            add(page);
        add("leave", "1 or Escape goes back, 2 ends; asked for by Escape",
            screens_.page(leavePage(texts)));
        add("thanks", "any key", screens_.page(thanksPage(texts)));
        return std::move(all_);
    }

    // Of the trial.
    std::string title() const {
        const Condition& condition =
            study_.protocol.conditions[static_cast<std::size_t>(trial_.planned.condition)];
        return fmt::format("{}: trial 1 of {} of slot 1, condition {}, on {}x{} pixels",
                           study_.protocol.name, trial_.count, condition.id, screens_.width(),
                           screens_.height());
    }

  private:
    void add(const Phase& phase) {
        Screenful screen = screens_.phase(phase, trial_.index, trial_.count);
        if (screen.turns == 1) {
            add(phase.name, endOf(phase), screen);
            return;
        }
        const std::vector<std::string> images = std::move(screen.images);
        const auto together = static_cast<std::ptrdiff_t>(images.size()) / screen.turns;
        for (int turn = 0; turn < screen.turns; ++turn) {
            const auto first = images.begin() + turn * together;
            screen.images.assign(first, first + together);
            add(fmt::format("{}, {} of {} in turn", phase.name, turn + 1, screen.turns),
                endOf(phase), screen);
        }
    }

    void add(const std::string& name, const std::string& end, const Screenful& screen) {
        std::string shown;
        for (const std::string& image : screen.images) {
            const ImageRecord& record = recordOf(image);
            shown +=
                fmt::format("{}{}{} ({})", shown.empty() ? "" : "   ",
                            record.role == image ? "" : image + " = ", record.role, record.name);
        }
        all_.push_back({name, end, shown, composed(screen)});
    }

    const ImageRecord& recordOf(const std::string& image) const {
        return study_.condition(trial_.planned.condition).image(trial_.role(image));
    }

    const Image8& loaded(const std::string& image) {
        const ImageRecord& record = recordOf(image);
        const auto [at, isNew] = loaded_.try_emplace(record.role);
        if (isNew)
            at->second = loadStimulus(study_.manifest, record);
        return at->second;
    }

    // As StimulusDisplay::show() has it: the page or grey, and the images upon it.
    Image8 composed(const Screenful& screen) {
        Image8 all{screens_.width(), screens_.height(), 3, {}};
        if (screen.drawn)
            all.pixels = screen.drawn->image.pixels;
        else
            all.pixels.assign(static_cast<std::size_t>(all.width) *
                                  static_cast<std::size_t>(all.height) * 3,
                              static_cast<std::uint8_t>(screen.grey));
        for (std::size_t i = 0; i < screen.images.size(); ++i)
            paste(all, loaded(screen.images[i]), screen.places[i]);
        return all;
    }

    static void paste(Image8& all, const Image8& image, const Box& box) {
        for (int row = 0; row < image.height; ++row)
            std::copy_n(image.pixels.begin() + std::ptrdiff_t{row} * image.width * 3,
                        std::ptrdiff_t{image.width} * 3,
                        all.pixels.begin() + (std::ptrdiff_t{box.y + row} * all.width + box.x) * 3);
    }

    const Study& study_;
    Screens screens_;
    Upcoming trial_;
    std::map<std::string, Image8> loaded_; // by role
    std::vector<PreviewedScreen> all_;
};

} // namespace

std::string endOf(const Phase& phase) {
    if (!phase.questions.empty())
        return answerOf(phase) +
               (phase.counted() ? fmt::format("; or unanswered after {}", timeOf(phase)) : "");
    if (!phase.counted())
        return keyOf(phase);
    const std::string turns = phase.alternate > 0
                                  ? fmt::format(", in turns of {:g} s, {} frames", phase.alternate,
                                                maskRefreshes(phase.alternate, shownHz))
                                  : "";
    return timeOf(phase) + turns + (phase.locked() ? ", locked" : "; or " + keyOf(phase));
}

std::vector<PreviewedScreen> previewed(const Study& study, int width, int height) {
    return Preview(study, width, height).all();
}

Image8 previewSheet(const Study& study, int width, int height) {
    Preview preview(study, width, height);
    const std::vector<PreviewedScreen> screens = preview.all();
    const int count = static_cast<int>(screens.size());
    const int columns = std::max(fewestColumns, static_cast<int>(std::ceil(std::sqrt(count))));
    const int halfWidth = (width + 1) / 2, halfHeight = (height + 1) / 2;
    const int cellWidth = halfWidth + gap, cellHeight = halfHeight + caption + gap;
    Canvas sheet(2 * margin + columns * cellWidth - gap,
                 header + margin + (count + columns - 1) / columns * cellHeight - gap);
    sheet.text(margin, margin, fmt::format("<b>{}</b>", escaped(preview.title())), 24);
    for (int i = 0; i < count; ++i) {
        const PreviewedScreen& screen = screens[static_cast<std::size_t>(i)];
        const int x = margin + i % columns * cellWidth, y = header + i / columns * cellHeight;
        sheet.text(x, y, fmt::format("<b>{}. {}</b>", i + 1, escaped(screen.name)), 18);
        sheet.text(x, y + 24, "ends: " + escaped(screen.end), 16);
        sheet.text(x, y + 46, escaped(screen.shown), 16);
        sheet.image(x, y + caption, shrunk(screen.image, halfWidth, halfHeight));
        sheet.frame(x, y + caption, halfWidth, halfHeight);
    }
    return sheet.finish();
}

} // namespace obscura
