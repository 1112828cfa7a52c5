#include "experiment/pages.h"

#include <fmt/format.h>

namespace obscura {

Page idPage(const std::string& typed, const std::string& objection) {
    Page page;
    page.heading = "Participant";
    page.text = "Type the participant's pseudonym and press Enter.";
    page.hasField = true;
    page.field = typed;
    page.note =
        objection.empty() ? "Letters and digits. Escape ends the program." : objection + ".";
    return page;
}

Page instructionsPage(const Texts& texts) {
    Page page;
    page.text = texts.instructions;
    page.options = {{"Space", ""}};
    return page;
}

Page startPage(const Texts& texts, int pair, int pairs) {
    Page page;
    page.heading = fmt::format("{} / {}", pair, pairs);
    page.text = texts.start;
    page.options = {{"Space", ""}};
    return page;
}

Page questionPage(const Texts& texts) {
    Page page;
    page.heading = texts.question;
    page.options = {{"1", texts.first}, {"2", texts.second}};
    return page;
}

Page leavePage() {
    Page page;
    page.heading = "End the session?";
    page.text = "Answers given so far are kept.";
    page.options = {{"1", "Continue"}, {"2", "End"}};
    return page;
}

Page thanksPage(const Texts& texts) {
    Page page;
    page.text = texts.thanks;
    return page;
}

} // namespace obscura
