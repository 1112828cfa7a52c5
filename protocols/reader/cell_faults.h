#pragma once

#include <string>
#include <string_view>

namespace obscura {

// What editors, spreadsheets and accidents do to the cells of a file, each in plain words with what
// to do about it; "" where nothing is wrong.

// Bytes that no text has: NUL and other control characters, what is not UTF-8.
std::string foreignByte(std::string_view cell);

// Of a name: blanks at its ends, also those that nobody sees, unseen characters within, and a
// number in a spreadsheet's notation. Each makes another name of it.
std::string strayName(std::string_view name);

// Why a cell that is no number, flag or digest may look as it does: "; ..." to follow an error.
std::string cellHint(std::string_view cell);

} // namespace obscura
