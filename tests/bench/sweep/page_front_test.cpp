// What sweep.html shows once techniques are hidden, in a browser: what C++ finds of the others
// alone.
#include "base/files.h"
#include "bench/sweep/page.h"
#include "bench/sweep/summary.h"
#include "tests/bench/sweep/sample_sweep.h"
#include "tests/folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <regex>

namespace obscura {
namespace {

using testing::HasSubstr;

// One scene at one size, on a machine that was busy in every third row.
Sweep busySweep() {
    Sweep sweep = test::sampleSweep();
    std::erase_if(sweep.rows, [](const SweepRow& row) {
        return row.scene != "atrium" || row.width != 640 || row.view >= "view 3";
    });
    for (std::size_t i = 0; i < sweep.rows.size(); i += 3)
        for (double* time :
             {&sweep.rows[i].total.median, &sweep.rows[i].total.low, &sweep.rows[i].total.high})
            *time *= 1.3;
    for (std::size_t i = 0; i < sweep.rows.size(); i += 3)
        sweep.rows[i].toStarcraft *= i % 2 ? 1 : 1.3;
    return sweep;
}

// The measure's front of all techniques but the hidden ones, as C++ draws it.
Scatter scatterWithout(const std::set<std::string>& hidden, const SweepGroup& group,
                       const ErrorMeasure& measure, const std::vector<std::string>& techniques) {
    auto points = paretoPoints(group, measure);
    for (std::size_t i = 0; i < points.size(); ++i)
        if (hidden.contains(group.points[i].technique))
            points[i].error = std::nan("");
    Scatter scatter = scatterOf(group, measure, techniques);
    scatter.front = paretoFront(points);
    scatter.near = nearFront(points, uncertaintyOf(group));
    return scatter;
}

std::string found(const std::string& text, const std::string& expression) {
    std::smatch match;
    return std::regex_search(text, match, std::regex(expression)) ? match[1].str() : "none";
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

std::string browserOnPath() {
    for (const char* name : {"chromium", "google-chrome"})
        if (std::system(fmt::format("command -v {} >/dev/null", name).c_str()) == 0)
            return name;
    return {};
}

// Hides techniques after showing that hiding and showing one changes nothing.
constexpr const char* hiding = R"(
const state = () => all('path.front').map(path => path.getAttribute('d')).join() +
  all('.numbers').map(group => group.innerHTML).join() +
  all('figcaption').map(caption => caption.textContent).join();
const set = (box, on) => { box.checked = on; box.dispatchEvent(new Event('change')); };
const before = state(), first = boxes[3];
set(first, false);
const during = state();
set(first, true);
const after = state(); let k = 0; while (after[k] === before[k]) ++k; document.title = after === before ? (during === before ? 'idle' : 'same') : 'changed: ' + before.slice(k - 60, k + 60).replaceAll(String.fromCharCode(60), '{') + ' TO ' + after.slice(k - 60, k + 60).replaceAll(String.fromCharCode(60), '{');
for (const box of boxes)
  if (HIDDEN.includes(box.parentElement.textContent.trim())) set(box, false);
)";

TEST(SweepFront, IsThatOfTheTechniquesThatAreShown) {
    const std::string browser = browserOnPath();
    if (browser.empty())
        GTEST_SKIP() << "there is no chromium here";
    const Sweep sweep = busySweep();
    const SweepGroup group = groupsOf(sweep.rows).at(0);
    const auto techniques = techniquesOf(sweep.rows);
    const std::set<std::string> hidden = {"none", "visibility_bitmask", "sao"};
    const std::string shown =
        shownAfter(std::regex_replace(std::string(hiding), std::regex("HIDDEN"),
                                      "['none', 'visibility_bitmask', 'sao']"),
                   sweepPage(sweep, "."), browser);
    EXPECT_EQ(found(shown, "<title>([^<]*)"), "same");
    const auto left =
        std::count_if(group.points.begin(), group.points.end(),
                      [&](const SweepRow& point) { return !hidden.contains(point.technique); });
    std::size_t at = 0, changed = 0, near = 0;
    for (std::size_t m = 0; m < errorMeasures().size(); ++m) {
        const ErrorMeasure& measure = errorMeasures()[m];
        const Scatter all = scatterOf(group, measure, techniques),
                      rest = scatterWithout(hidden, group, measure, techniques);
        at = shown.find("<figure>", at + 1);
        const std::string figure = shown.substr(at, shown.find("</figure>", at) - at),
                          drawn = scatterSvg(rest, techniques.size(), 0);
        const auto sameAs = [&](const std::string& expression) {
            EXPECT_EQ(std::regex_replace(found(figure, expression), std::regex("></path>"), "/>"),
                      found(drawn, expression))
                << measure.name << " " << expression;
        };
        sameAs("class=\"front\" d=\"([^\"]*)");
        sameAs("class=\"unsure\" d=\"([^\"]*)");
        sameAs("class=\"numbers\">(.*?)</g>");
        EXPECT_EQ(found(figure, "class=\"count\">([^<]*)"),
                  fmt::format("{} of the {} configurations shown", rest.front.size(), left));
        std::string names;
        for (const std::size_t i : rest.near)
            names += (names.empty() ? "" : "; ") + rest.points[i].name;
        EXPECT_EQ(found(figure, "class=\"names\">([^<]*)"), names) << measure.name;
        for (std::size_t i = 0; i < rest.points.size(); ++i) {
            const std::string row =
                found(shown, fmt::format("<tr class=\"([^\"]*)\"><td class=\"number rank\"></td>"
                                         "<th[^>]*>(?:(?!</th>).)*href=\"#p{}\"",
                                         i));
            const auto isIn = [&](const std::vector<std::size_t>& some) {
                return std::find(some.begin(), some.end(), i) != some.end();
            };
            EXPECT_EQ(std::regex_search(row, std::regex(fmt::format("\\bf{}\\b", m))),
                      isIn(rest.front))
                << measure.name << " " << rest.points[i].name << " " << row;
            EXPECT_EQ(std::regex_search(row, std::regex(fmt::format("\\bn{}\\b", m))),
                      isIn(rest.near));
        }
        changed += all.front != rest.front;
        near += rest.near.size();
    }
    EXPECT_EQ(changed, errorMeasures().size());
    EXPECT_GT(near, 5u);
}

TEST(SweepFront, IsWholeWithoutAScript) {
    const Sweep sweep = busySweep();
    const SweepGroup group = groupsOf(sweep.rows).at(0);
    const std::string page = sweepPage(sweep, ".");
    const auto points = paretoPoints(group, errorMeasures()[0]);
    const auto front = paretoFront(points), near = nearFront(points, uncertaintyOf(group));
    ASSERT_FALSE(near.empty());
    const auto rows = [&](const std::string& name) {
        const std::regex row("<tr class=\"[^\"]*\\b" + name +
                             "\\b[^\"]*\"><td class=\"number rank");
        return static_cast<std::size_t>(
            std::distance(std::sregex_iterator(page.begin(), page.end(), row), {}));
    };
    EXPECT_EQ(rows("f0"), front.size());
    EXPECT_EQ(rows("n0"), near.size());
    EXPECT_THAT(page, HasSubstr(fmt::format("<span class=\"count\">{} of {} configurations</span>",
                                            front.size(), points.size())));
    EXPECT_THAT(page, HasSubstr("<span class=\"names\">" + points[near[0]].name));
    EXPECT_LT(page.find("The machine was busy"), page.find("class=\"chart\""));
}

} // namespace
} // namespace obscura
