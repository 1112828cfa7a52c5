// What sweep.html shows once techniques are hidden, in a browser: what C++ finds of the others.
#include "base/files.h"
#include "bench/sweep/page.h"
#include "bench/sweep/summary.h"
#include "tests/bench/sweep/sample_sweep.h"
#include "tests/folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <regex>
#include <set>

namespace obscura {
namespace {

using testing::HasSubstr;

using Places = std::vector<std::size_t>;

// One scene at one size, on a machine that was busy in every third row.
Sweep busySweep() {
    Sweep sweep = test::sampleSweep();
    std::erase_if(sweep.rows, [](const SweepRow& row) {
        return row.scene != "atrium" || row.width != 640 || row.view >= "view 3";
    });
    for (std::size_t i = 0; i < sweep.rows.size(); i += 3)
        sweep.rows[i].toStarcraft *= i % 2 ? 1 / 1.5 : 1.5;
    const std::vector<SweepRow> rows = sweep.rows;
    for (SweepRow row : rows)
        if (row.technique == "gtao") { // a twin that is worse in one error and equal in all else
            row.configuration += " twin";
            row.matched.rmse *= 1.01;
            sweep.rows.push_back(row);
        }
    return sweep;
}

bool has(const Places& places, std::size_t place) {
    return std::find(places.begin(), places.end(), place) != places.end();
}

// The first group of the expression.
std::string found(const std::string& text, const std::string& expression) {
    std::smatch match;
    return std::regex_search(text, match, std::regex(expression)) ? match[1].str() : "none";
}

// The classes of the rows of the table of fronts, which are the points in their order.
std::vector<std::set<std::string>> rowClasses(const std::string& page) {
    static const std::regex row("<tr class=\"([^\"]*)\"><td class=\"number rank\">"), word("\\w+");
    std::vector<std::set<std::string>> rows;
    for (std::sregex_iterator at(page.begin(), page.end(), row), end; at != end; ++at) {
        const std::string classes = (*at)[1];
        rows.emplace_back();
        for (std::sregex_iterator one(classes.begin(), classes.end(), word); one != end; ++one)
            rows.back().insert(one->str());
    }
    return rows;
}

std::string browserOnPath() {
    for (const char* name : {"chromium", "google-chrome"})
        if (std::system(fmt::format("command -v {} >/dev/null", name).c_str()) == 0)
            return name;
    return {};
}

// What a browser shows of a page after a script ran in it.
std::string shownAfter(const std::string& script, std::string page, const std::string& browser) {
    const test::Folder folder;
    page.insert(page.rfind("</body>"), "<script>" + script + "</script>");
    writeFile(folder / "page.html", page);
    const std::string command =
        fmt::format("'{0}' --headless --no-sandbox --disable-gpu --user-data-dir='{1}/profile' "
                    "--dump-dom 'file://{1}/page.html' >'{1}/shown.html' 2>/dev/null",
                    browser, folder.path().string());
    EXPECT_EQ(std::system(command.c_str()), 0);
    return readFile(folder / "shown.html");
}

// Says in the title whether hiding a technique and showing it again changes nothing, then hides
// some.
constexpr const char* hiding = R"(
const state = () => all('path.front').map(path => path.getAttribute('d')).join() +
  all('.numbers').map(group => group.innerHTML).join() +
  all('figcaption').map(caption => caption.textContent).join();
const set = (box, on) => { box.checked = on; box.dispatchEvent(new Event('change')); };
const before = state();
set(boxes[3], false);
const during = state();
set(boxes[3], true);
document.title = during === before ? 'idle' : state() === before ? 'restored' : 'changed';
for (const box of boxes)
  if (['none', 'sao', 'visibility_bitmask'].includes(box.parentElement.textContent.trim()))
    set(box, false);
)";

TEST(SweepFront, IsThatOfTheTechniquesThatAreShown) {
    const std::string browser = browserOnPath();
    if (browser.empty())
        GTEST_SKIP() << "expected chromium, found none";
    const Sweep sweep = busySweep();
    const SweepGroup group = groupsOf(sweep.rows).at(0);
    const auto techniques = techniquesOf(sweep.rows);
    const std::set<std::string> hidden = {"none", "sao", "visibility_bitmask"};
    const std::string shown = shownAfter(hiding, sweepPage(sweep, "."), browser);
    EXPECT_EQ(found(shown, "<title>([^<]*)"), "restored");
    const auto left =
        std::count_if(group.points.begin(), group.points.end(),
                      [&](const SweepRow& point) { return !hidden.contains(point.technique); });
    const auto rows = rowClasses(shown);
    ASSERT_EQ(rows.size(), group.points.size());
    std::size_t at = 0, near = 0;
    for (std::size_t m = 0; m < errorMeasures().size(); ++m) {
        const ErrorMeasure& measure = errorMeasures()[m];
        SCOPED_TRACE(measure.name);
        Scatter scatter = scatterOf(group, measure, techniques);
        const Places front = scatter.front;
        auto points = paretoPoints(group, measure);
        for (std::size_t i = 0; i < points.size(); ++i)
            if (hidden.contains(group.points[i].technique))
                points[i].error = std::nan("");
        scatter.front = paretoFront(points);
        scatter.near = nearFront(points, uncertaintyOf(group));
        EXPECT_NE(scatter.front, front);
        near += scatter.near.size();

        at = shown.find("<figure>", at + 1);
        const std::string figure = shown.substr(at, shown.find("</figure>", at) - at),
                          drawn = scatterSvg(scatter, techniques.size(), 0);
        for (const char* part : {"class=\"front\" d=\"([^\"]*)", "class=\"unsure\" d=\"([^\"]*)",
                                 "class=\"numbers\">(.*?)</g>"})
            EXPECT_EQ(std::regex_replace(found(figure, part), std::regex("></path>"), "/>"),
                      found(drawn, part));
        EXPECT_EQ(found(figure, "class=\"count\">([^<]*)"),
                  fmt::format("{} of the {} configurations shown", scatter.front.size(), left));
        std::vector<std::string> names;
        for (const std::size_t i : scatter.near)
            names.push_back(points[i].name);
        EXPECT_EQ(found(figure, "class=\"names\">([^<]*)"),
                  fmt::format("{}", fmt::join(names, "; ")));
        for (std::size_t i = 0; i < points.size(); ++i) {
            EXPECT_EQ(rows[i].contains(fmt::format("f{}", m)), has(scatter.front, i)) << i;
            EXPECT_EQ(rows[i].contains(fmt::format("n{}", m)), has(scatter.near, i)) << i;
        }
    }
    EXPECT_GT(near, 5u);
}

TEST(SweepFront, IsWholeWithoutAScript) {
    const Sweep sweep = busySweep();
    const SweepGroup group = groupsOf(sweep.rows).at(0);
    const std::string page = sweepPage(sweep, ".");
    const auto points = paretoPoints(group, errorMeasures()[0]);
    const Places front = paretoFront(points), near = nearFront(points, uncertaintyOf(group));
    ASSERT_FALSE(near.empty());
    const auto rows = rowClasses(page);
    ASSERT_EQ(rows.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_EQ(rows[i].contains("f0"), has(front, i)) << i;
        EXPECT_EQ(rows[i].contains("n0"), has(near, i)) << i;
    }
    EXPECT_THAT(page, HasSubstr(fmt::format("<span class=\"count\">{} of {} configurations</span>",
                                            front.size(), points.size())));
    EXPECT_THAT(page, HasSubstr("<span class=\"names\">" + points[near[0]].name));
    EXPECT_LT(page.find("The machine was busy"), page.find("class=\"chart\""));
}

} // namespace
} // namespace obscura
