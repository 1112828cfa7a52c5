#include "bench/sweep/page_introduction.h"

#include "bench/sweep/merge.h"
#include "gl/context.h"
#include "report/html.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

using fmt::format;

std::string sweepIntroduction(const Sweep& sweep) {
    const SweepMachine& machine = sweep.machine;
    std::string html = element("h1", "Speed against accuracy");
    html += element(
        "p", machine.method.empty()
                 ? "Nothing was timed yet."
                 : format("Timed on {} ({}, OpenGL {}) with {}, {}. Times by {}. {}.",
                          machine.renderer, machine.vendor, machine.glVersion, machine.processor,
                          machine.clocks.empty() ? "clocks unknown" : "clocks " + machine.clocks,
                          machine.method, machine.date));
    if (!machine.errorsBy.empty() && machine.errorsBy != machine.renderer)
        html += element("p", format("Errors are of pictures by {}; they are the same on all "
                                    "renderers, but for rounding.",
                                    machine.errorsBy));
    if (!machine.display.empty())
        html += element("p", format("JOD (just-objectionable differences) are predicted, by "
                                    "ColorVideoVDP, for a person before this screen: {}. 10 is no "
                                    "difference from the lit truth; at 9, 75 of 100 would prefer "
                                    "the truth. Nobody has looked.",
                                    machine.display));
    html += format("<p class=\"aside hash\">{}; study {}</p>\n", escaped(machine.program),
                   escaped(machine.study));
    if (const std::string lacking = incompleteness(sweep); !lacking.empty())
        html += format("<p class=\"warning\">Not the whole study: {}.</p>\n", escaped(lacking));
    if (!machine.notes.empty())
        html += format("<p class=\"warning\">{}</p>\n", escaped(machine.notes));
    if (machine.formatVersion < SweepMachine{}.formatVersion)
        html += format(
            "<p class=\"aside\">Written by an earlier obscura-bench (format {}, now {}): what "
            "it did not measure is empty.</p>\n",
            machine.formatVersion, SweepMachine{}.formatVersion);
    if (gl::isSoftware(machine.renderer))
        html +=
            "<p class=\"warning\">This renderer is software. What is fast on a processor need not "
            "be on a GPU: neither these times nor their ratios and ranks carry over. Errors "
            "do.</p>\n";
    if (std::any_of(sweep.rows.begin(), sweep.rows.end(), [](const SweepRow& row) {
            const std::string settings = " " + row.settings + " ";
            return settings.find(" accumulate=") != std::string::npos &&
                   settings.find(" accumulate=1 ") == std::string::npos;
        }))
        html +=
            "<p class=\"warning\">Configurations with <code>accumulate</code> show the mean of so "
            "many frames of a camera at rest, and have the time of one. Of a camera that moves "
            "they "
            "are worse: see the tests of stability.</p>\n";
    if (std::none_of(sweep.rows.begin(), sweep.rows.end(),
                     [](const SweepRow& row) { return row.hasTimes() && row.hasErrors(); }))
        return html; // there are no charts to explain
    return html +
           "<p>Each mark is one configuration: its milliseconds against its error. Left and low is "
           "better; the staircase is the Pareto front, and all in its shade is beaten by something "
           "in both, in the lighter shade by no more than times are uncertain. Without the "
           "techniques that are switched off, the front is that of the others. Point, tap or tab "
           "to a mark for all its numbers.</p>\n"
           "<details><summary>What exactly is drawn</summary><p>Milliseconds are those of the "
           "technique's own passes: the median over views of each view's median frame. Thin bars "
           "go from the 5th to the 95th percentile of frames, also medians over views. Where a "
           "machine "
           "was faster or slower for a while, times are scaled by starcraft's in the same rounds; "
           "sweep.csv has them as they were. What took no time stands on the left border. RMSE is "
           "the "
           "root of the mean square over views, all other errors and predicted JOD are means over "
           "views; bias is the "
           "mean of its size, without its sign, which is above 0 where a technique is too dark. "
           "Matched errors "
           "are what remains after each technique was fitted on training views. The full reference "
           "knows the whole scene, the depth-buffer reference only what a depth buffer of one "
           "layer "
           "can show, its surfaces taken to be as thick as the radius, which is a guess: a "
           "technique "
           "may be nearer to the full reference than it is. A faint line joins the configurations "
           "of one technique in order of cost."
           "</p></details>\n";
}

} // namespace obscura
