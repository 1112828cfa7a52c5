#pragma once

#include "protocols/reader/texts.h"
#include "protocols/reader/toml_table.h"

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace obscura {

// Whether it is a language tag as RFC 5646 (BCP 47) writes them: "en", "zh-Hans", "de-AT",
// "x-ours". Whether such a language exists is not asked, and those that were registered before that
// form
// ("i-klingon") are refused.
bool isLanguageTag(std::string_view tag);

// Tags are the same in capitals and small letters.
bool sameLanguage(std::string_view one, std::string_view other);

// [texts] and each of [languages.TAG], which has the same keys: every text of the program's own,
// and `named`, those that the trial names besides. Of its own texts the program has translations
// (protocols/languages); in a language that it does not know none is left to its English default.
// The first is that of [texts]; the others follow in the order of the file.
std::vector<Texts> parseLanguages(TomlTable& root, const std::set<std::string>& named);

} // namespace obscura
