#pragma once

#include "experiment/text.h"
#include "protocols/protocol.h"

#include <string>

namespace obscura {

// What participants and experimenters read, page by page. The study's words come from its protocol,
// so they are in the participant's language; only the question whether to leave is ours.

Page idPage(const std::string& typed, const std::string& objection);
Page instructionsPage(const Texts& texts);
Page startPage(const Texts& texts, int pair, int pairs);
Page questionPage(const Texts& texts);
Page leavePage();
Page thanksPage(const Texts& texts);

} // namespace obscura
