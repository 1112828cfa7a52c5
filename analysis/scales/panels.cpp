#include "analysis/scales/panels.h"

#include "report/gnuplot.h"
#include "report/paper_figure.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

namespace {

constexpr double titleHeight = 0.27, gap = 0.08;

} // namespace

double textWidth(const std::string& text) {
    const auto characters =
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
    return 0.064 * static_cast<double>(characters);
}

PanelFigure panelFigure(const std::string& blocks, const std::string& begin,
                        const std::vector<Panel>& panels, PanelLayout layout,
                        const std::string& stamp) {
    PanelFigure figure;
    const std::size_t columns = panels.size() > 1 ? 2 : 1;
    const double width = figure.width / 2; // one panel alone is as wide as one of two
    if (columns == 1)
        figure.width = std::max(width + 0.6, layout.nameWidth + layout.rightWidth + 2);
    if (!stamp.empty())
        layout.header = std::max(layout.header, 0.22);
    std::vector<double> rows; // heights
    for (std::size_t i = 0; i < panels.size(); ++i) {
        if (i % columns == 0)
            rows.push_back(0);
        rows.back() = std::max(rows.back(), panels[i].height);
    }
    figure.height = layout.header;
    for (const double row : rows)
        figure.height += titleHeight + row + layout.below + gap;

    figure.script = plot::style + blocks + "set minussign\n" + begin + "set multiplot\n";
    double top = figure.height - layout.header;
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const double left = static_cast<double>(i % columns) * width + layout.nameWidth;
        const double right =
            (columns == 1 ? figure.width : static_cast<double>(i % columns + 1) * width) -
            layout.rightWidth;
        const double above = top - titleHeight;
        figure.script += fmt::format(
            "unset label\nunset arrow\nunset object\nset lmargin at screen {:.4f}\n"
            "set rmargin at screen {:.4f}\nset tmargin at screen {:.4f}\n"
            "set bmargin at screen {:.4f}\nset label {} at screen {:.4f}, {:.4f}\n",
            left / figure.width, right / figure.width, above / figure.height,
            (above - panels[i].height) / figure.height, gnuplotBold(panels[i].title),
            (left - layout.nameWidth + 0.08) / figure.width, (above + 0.13) / figure.height);
        if (i == 0 && !stamp.empty())
            figure.script +=
                fmt::format("set label {} at screen {:.4f}, {:.4f} right textcolor rgb '#B33A00'\n",
                            gnuplotBold(stamp), 1 - 0.08 / figure.width, 1 - 0.11 / figure.height);
        figure.script += panels[i].script;
        if (i % columns + 1 == columns)
            top -= titleHeight + rows[i / columns] + layout.below + gap;
    }
    figure.script += "unset multiplot\n";
    return figure;
}

} // namespace obscura
