#include "protocols/reader/texts.h"

#include <algorithm>
#include <vector>

namespace obscura {

std::span<const TextKey> textKeys() {
    static const std::vector<TextKey> keys = {
        {"instructions", &Texts::instructions, true},
        {"start", &Texts::start},
        {"question", &Texts::question},
        {"first", &Texts::first},
        {"second", &Texts::second},
        {"thanks", &Texts::thanks, true},
        {"progress", &Texts::progress},
        {"space", &Texts::space},
        {"enter", &Texts::enter},
        {"done", &Texts::done},
        {"between", &Texts::between},
        {"anyKey", &Texts::anyKey},
        {"loading", &Texts::loading},
        {"unfocused", &Texts::unfocused},
        {"leave", &Texts::leave},
        {"leaveNote", &Texts::leaveNote},
        {"stay", &Texts::stay},
        {"end", &Texts::end},
        {"declined", &Texts::declined},
        {"rest", &Texts::rest},
        {"id", &Texts::id},
        {"idNote", &Texts::idNote},
        {"idMalformed", &Texts::idMalformed},
        {"idTaken", &Texts::idTaken},
        {"rehearsal", &Texts::rehearsal},
        {"untimed", &Texts::untimed},
        {"resume", &Texts::resume},
        {"otherId", &Texts::otherId},
    };
    return keys;
}

const std::string& Texts::at(std::string_view key) const {
    const auto known = std::find_if(textKeys().begin(), textKeys().end(),
                                    [&](const TextKey& text) { return text.name == key; });
    return known == textKeys().end() ? own.find(key)->second : this->*known->text;
}

} // namespace obscura
