#include "experiment/script.h"

#include <glib.h>

namespace obscura {

namespace {

// The blocks that Unicode keeps for scripts from right to left.
bool isFromRightToLeft(gunichar letter) {
    const auto in = [letter](gunichar first, gunichar last) {
        return letter >= first && letter <= last;
    };
    return in(0x590, 0x8FF) || in(0xFB1D, 0xFDFF) || in(0xFE70, 0xFEFF) || in(0x10800, 0x10FFF) ||
           in(0x1E800, 0x1EFFF);
}

} // namespace

bool runsFromRightToLeft(const std::string& text) {
    int balance = 0;
    for (const char* at = text.c_str(); *at && g_utf8_get_char_validated(at, -1) < 0x110000;
         at = g_utf8_next_char(at))
        if (const gunichar letter = g_utf8_get_char(at); g_unichar_isalpha(letter))
            balance += isFromRightToLeft(letter) ? 1 : -1;
    return balance > 0;
}

} // namespace obscura
