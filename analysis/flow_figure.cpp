#include "analysis/figures.h"
#include "report/gnuplot.h"
#include "report/lettering.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

namespace {

// Lengths are pixels of the page, in which the type is 13 high.
constexpr double letterWidth = 7.3, lineHeight = 18, padding = 8, gap = 16, edge = 4;

// A stage of the study, or those that are lost before the next.
struct Box {
    bool loss = false;
    std::vector<std::string> lines; // the first in bold
};

std::string counted(int number, const char* one, const char* many) {
    return fmt::format("{} {}", number, number == 1 ? one : many);
}

void addLosses(std::vector<Box>& boxes, const std::vector<Flow::Loss>& losses,
               const std::string& what) {
    if (losses.empty())
        return;
    Box box{true, {fmt::format("{}: {}", what, Flow::sum(losses))}};
    for (const Flow::Loss& loss : losses)
        box.lines.push_back(fmt::format("{} × {}", loss.count, loss.reason));
    boxes.push_back(box);
}

std::vector<Box> boxesOf(const Flow& flow) {
    std::vector<Box> boxes;
    if (flow.begun)
        boxes.push_back({false,
                         {fmt::format("Begun: {}", counted(*flow.begun, "session", "sessions")),
                          "places of the ledger that were taken"}});
    addLosses(boxes, flow.unanswered, "Without answers");
    addLosses(boxes, flow.excluded, "Excluded");
    addLosses(boxes, flow.leftOut, "Single trials left out");
    boxes.push_back(
        {false,
         {fmt::format("Analysed: {}", counted(flow.participants, "participant", "participants")),
          fmt::format("{}, {}", counted(flow.sessions, "session", "sessions"),
                      counted(flow.trials, "trial", "trials"))}});
    return boxes;
}

struct Place {
    double left = 0, right = 0, top = 0, bottom = 0;
};

class Drawing {
  public:
    Drawing(std::vector<Box> boxes, double width) : boxes_(std::move(boxes)), width_(width) {
        for (Box& box : boxes_)
            place(box);
        height_ = places_.back().bottom + edge;
    }

    double height() const { return height_; }

    std::string script() const {
        std::string script = "set encoding utf8\nunset border\nunset tics\nunset key\n"
                             "set lmargin 0\nset rmargin 0\nset tmargin 0\nset bmargin 0\n";
        for (std::size_t i = 0; i < boxes_.size(); ++i)
            script += boxScript(i) + arrowTo(i);
        return script + "plot [0:1] [0:1] NaN title ''\n";
    }

  private:
    bool isNarrow() const { return width_ < 500; }
    double spine() const { return isNarrow() ? 24 : 180; } // where the arrows run down

    // Below the box before; breaks its lines.
    void place(Box& box) {
        Place place;
        place.left = !box.loss ? edge : isNarrow() ? 52 : 230;
        place.right = box.loss || isNarrow() ? width_ - edge : 360;
        place.top = places_.empty() ? edge : places_.back().bottom + gap + (box.loss ? 0 : 8);
        const double room = place.right - place.left - 2 * padding;
        std::vector<std::string> lines;
        for (const std::string& line : box.lines)
            for (const std::string& part :
                 wrapped(line, static_cast<std::size_t>(room / letterWidth)))
                lines.push_back(part);
        box.lines = lines;
        place.bottom = place.top + 2 * padding + lineHeight * static_cast<double>(box.lines.size());
        places_.push_back(place);
    }

    std::string at(double x, double y) const {
        return fmt::format("screen {:.5f}, screen {:.5f}", x / width_, 1 - y / height_);
    }

    std::string boxScript(std::size_t i) const {
        const Place& place = places_[i];
        std::string script =
            fmt::format("set object rectangle from {} to {} fillstyle empty border linecolor rgb "
                        "'{}' linewidth {}\n",
                        at(place.left, place.top), at(place.right, place.bottom),
                        boxes_[i].loss ? "#555555" : "#0072B2", boxes_[i].loss ? 1 : 2);
        for (std::size_t line = 0; line < boxes_[i].lines.size(); ++line) {
            const std::string& text = boxes_[i].lines[line];
            script += fmt::format(
                "set label {} at {} left\n", line == 0 ? gnuplotBold(text) : gnuplotText(text),
                at(place.left + padding,
                   place.top + padding + lineHeight * (static_cast<double>(line) + 0.5)));
        }
        return script;
    }

    // From the spine to a loss; to a stage from the one before.
    std::string arrowTo(std::size_t i) const {
        const char* form = "filled size screen 0.012, 20 linecolor rgb '#333333'";
        const Place& place = places_[i];
        const bool begins =
            std::none_of(boxes_.begin(), boxes_.begin() + static_cast<std::ptrdiff_t>(i),
                         [](const Box& box) { return !box.loss; });
        if (begins)
            return {};
        if (boxes_[i].loss) {
            const double y = (place.top + place.bottom) / 2;
            return fmt::format("set arrow from {} to {} {}\n", at(spine(), y), at(place.left, y),
                               form);
        }
        std::size_t before = i - 1;
        while (boxes_[before].loss)
            --before;
        return fmt::format("set arrow from {} to {} {}\n", at(spine(), places_[before].bottom),
                           at(spine(), place.top), form);
    }

    std::vector<Box> boxes_;
    std::vector<Place> places_;
    double width_, height_ = 0;
};

Table numbersOf(const Flow& flow) {
    Table table{{{"Stage"}, {"What"}, {"Number", true}}, {}};
    const auto add = [&](const char* stage, const std::string& what, int number) {
        table.rows.push_back({stage, what, fmt::format("{}", number)});
    };
    table.rows.push_back({"Invited", "people (not recorded by the program)", "–"});
    if (flow.begun)
        add("Begun", "sessions", *flow.begun);
    for (const Flow::Loss& loss : flow.unanswered)
        add("Without answers", loss.reason, loss.count);
    for (const Flow::Loss& loss : flow.excluded)
        add("Excluded", loss.reason, loss.count);
    for (const Flow::Loss& loss : flow.leftOut)
        add("Single trials left out", loss.reason, loss.count);
    add("Analysed", "participants", flow.participants);
    add("Analysed", "sessions", flow.sessions);
    add("Analysed", "trials", flow.trials);
    return table;
}

} // namespace

std::vector<StudyFigure> flowFigures(const Findings& findings) {
    if (!findings.conduct)
        return {};
    const Flow& flow = findings.conduct->flow;
    if (boxesOf(flow).size() < 2) // no ledger, and nothing lost
        return {};
    const auto draw = [&](double inches) {
        const Drawing drawing(boxesOf(flow), 96 * inches);
        return Figure{"flow", "Participants, from the first to those who count",
                      stampScript(findings, inches, drawing.height() / 96) + drawing.script(),
                      inches, drawing.height() / 96};
    };
    return {{draw(wideFigure),
             "Who began, who did not finish, who was excluded and why, and whose answers count. "
             "How many people were invited is not recorded by the program.",
             numbersOf(flow), draw(narrowFigure)}};
}

} // namespace obscura
