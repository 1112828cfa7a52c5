#include "experiment/pages.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace obscura {

namespace {

std::string replaced(std::string text, std::string_view mark, int number) {
    for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos;)
        text.replace(at, mark.size(), fmt::format("{}", number));
    return text;
}

} // namespace

Page loadingPage(const Texts& texts, int loaded, int images) {
    Page page;
    page.text = texts.loading;
    page.note = fmt::format("{} / {}", loaded, images);
    return page;
}

Page idPage(const Texts& texts, const std::string& typed, const std::string& objection) {
    Page page;
    page.text = texts.id;
    page.hasField = true;
    page.field = typed;
    page.note = objection.empty() ? texts.idNote : objection;
    return page;
}

Page instructionsPage(const Texts& texts) {
    Page page;
    page.text = texts.instructions;
    page.options = {{texts.space, ""}};
    return page;
}

Page startPage(const Texts& texts, int pair, int pairs) {
    Page page;
    page.heading = replaced(replaced(texts.progress, "{pair}", pair), "{pairs}", pairs);
    page.text = texts.start;
    page.options = {{texts.space, ""}};
    return page;
}

Page questionPage(const Texts& texts) {
    Page page;
    page.heading = texts.question;
    page.options = {{"1", texts.first}, {"2", texts.second}};
    return page;
}

Page leavePage(const Texts& texts) {
    Page page;
    page.heading = texts.leave;
    page.text = texts.leaveNote;
    page.options = {{"1", texts.stay}, {"2", texts.end}};
    return page;
}

Page thanksPage(const Texts& texts) {
    Page page;
    page.text = texts.thanks;
    page.note = texts.anyKey;
    return page;
}

Page unfocused(Page page, const Texts& texts) {
    page.warning += (page.warning.empty() ? "" : "\n") + texts.unfocused;
    return page;
}

void checkShowable(const Texts& texts) {
    constexpr std::size_t mostNamed = 8;
    for (const TextKey& key : textKeys()) {
        const std::vector<std::string> missing = unshowable(texts.*key.text);
        if (missing.empty())
            continue;
        std::string names;
        for (std::size_t i = 0; i < std::min(missing.size(), mostNamed); ++i)
            names += (i == 0 ? "" : ", ") + missing[i];
        if (missing.size() > mostNamed)
            names += fmt::format(" and {} more", missing.size() - mostNamed);
        const auto place = texts.places.find(key.name);
        throw Error(place == texts.places.end() ? Place{"", 0, 0, fmt::format("texts.{}", key.name)}
                                                : place->second,
                    fmt::format("no installed font can show {}; install one that can (such as the "
                                "packages fonts-noto-core and fonts-noto-cjk), or write it "
                                "otherwise",
                                names));
    }
}

} // namespace obscura
