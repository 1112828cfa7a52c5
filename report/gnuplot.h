#pragma once

#include <string>

namespace obscura {

// Runs gnuplot on a script and returns what it prints, the SVG of `set terminal svg`, without the
// XML prologue, so that it can stand inside a page; `title` becomes its accessible name. A missing
// gnuplot or a fault in the script is an Error.
std::string gnuplotSvg(const std::string& script, const std::string& title);

// The same for `set terminal pdfcairo`: a PDF file.
std::string gnuplotPdf(const std::string& script);

// The text as a gnuplot string on one line, to be drawn as it is: plain, or in bold type.
std::string gnuplotText(const std::string& text);
std::string gnuplotBold(const std::string& text);

} // namespace obscura
