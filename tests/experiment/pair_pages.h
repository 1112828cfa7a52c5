#pragma once

#include "experiment/pages.h"

namespace obscura::test {

// The two pages of a pair as the shorthand has it.
inline Page startPage(const Texts& texts, int pair, int pairs) {
    return textPage(texts, phasesOf({}).front(), pair, pairs);
}
inline Page questionPage(const Texts& texts) {
    return formPage(texts, Form(phasesOf({}).back().questions, 2), {});
}

} // namespace obscura::test
