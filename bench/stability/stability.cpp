#include "bench/stability/stability.h"

#include "base/files.h"
#include "bench/motion/temporal_tests.h"
#include "bench/stability/csv.h"
#include "bench/stability/failure_test.h"
#include "bench/stability/finding_text.h"
#include "bench/stability/motion_tasks.h"
#include "bench/stability/page.h"
#include "bench/stability/still_tasks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace obscura {

namespace fs = std::filesystem;

namespace {

std::vector<const FailureTestRow*> allRows() {
    std::vector<const FailureTestRow*> rows;
    for (const auto tests : {openTests(), occluderTests(), cameraTests(), invarianceTests()})
        for (const FailureTestRow& row : tests)
            rows.push_back(&row);
    return rows;
}

bool contains(const std::vector<std::string>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

// In the order of the page's columns.
std::vector<const FailureTestRow*> rowsOf(const std::vector<std::string>& wanted) {
    const std::vector<std::string> known = stillTestIds();
    for (const std::string& id : wanted)
        if (!contains(known, id))
            throw Error(fmt::format("expected the name of a failure test, one of {}, found \"{}\"",
                                    fmt::join(known, ", "), id));
    std::vector<const FailureTestRow*> rows = allRows();
    std::erase_if(rows,
                  [&](const FailureTestRow* row) { return !contains(wanted, row->about.id); });
    return rows;
}

} // namespace

std::vector<StabilityTest> stabilityTests() {
    std::vector<StabilityTest> tests;
    for (const FailureTestRow* row : allRows())
        tests.push_back(row->about);
    return tests;
}

std::vector<std::string> stillTestIds() {
    std::vector<std::string> ids;
    for (const FailureTestRow* row : allRows())
        ids.emplace_back(row->about.id);
    return ids;
}

std::vector<std::string> screenTechniques() {
    std::vector<std::string> ids;
    for (const Technique& technique : techniques())
        if (!(technique.reads & rays))
            ids.emplace_back(technique.id);
    return ids;
}

namespace {

// The tests that were run.
std::vector<StabilityTest> testsOf(const std::vector<StabilityCell>& cells) {
    std::vector<StabilityTest> tests = stabilityTests();
    for (const TemporalTest& row : temporalTests())
        tests.push_back(row.test);
    std::erase_if(tests, [&](const StabilityTest& test) {
        return std::none_of(cells.begin(), cells.end(),
                            [&](const StabilityCell& cell) { return cell.test == test.id; });
    });
    return tests;
}

std::vector<std::string> linesOf(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

// One run of the tests, which other processes may do as well.
class StabilityRun {
  public:
    explicit StabilityRun(const StabilityOptions& options);
    std::vector<StabilityCell> run(const StabilityProgress& progress);

  private:
    void claimFolder() const;
    std::vector<Task> tasks();
    bool stands(const std::string& unit, const std::string& result) const;
    std::vector<StabilityCell> kept() const;
    std::vector<StabilityCell> found() const;
    std::string assembled() const;

    const StabilityOptions& options_;
    fs::path csv_, page_;
    StillTasks still_;
    std::optional<MotionTasks> motion_;
    std::vector<std::string> inOrder_; // units that have cells
    std::string pageUnit_;
    std::vector<Task> tasks_;
    std::optional<Units> units_;
};

// Ends the names of units, so that those of several programs and devices can lie in one folder.
std::string markOf(const StabilityOptions& options) {
    return sha256(fmt::format("{} {} {}", options.about, options.size.width, options.size.height))
        .substr(0, 12);
}

StabilityRun::StabilityRun(const StabilityOptions& options)
    : options_(options), csv_(options.folder / "stability.csv"),
      page_(options.folder / "stability.html"),
      still_(rowsOf(options.tests), options.configurations, options.size, options.folder,
             markOf(options)) {
    for (const std::string& configuration : options.configurations)
        TestedTechnique{configuration}; // all names are checked before the first is run
    claimFolder();
    if (options.motion)
        motion_.emplace(*options.motion, options.configurations, options.folder, markOf(options));
    tasks_ = tasks();
    units_.emplace(options.folder, "obscura-bench stability, format 1\n", unitsOf(tasks_),
                   std::chrono::minutes(2),
                   [this](const auto& unit, const auto& result) { return stands(unit, result); });
}

// The folder's numbers are of one program, device, size and motion.
void StabilityRun::claimFolder() const {
    const fs::path json = options_.folder / "stability.json";
    if (options_.anew) {
        writeFile(json, options_.about);
        return;
    }
    const bool isNew = !fs::exists(csv_) && writeNewFile(json, options_.about);
    if (!isNew && (!fs::exists(json) || readFile(json) != options_.about))
        throw Error({json.string(), 0, 0, {}},
                    "expected the program, device, size and motion that the folder's numbers were "
                    "measured with, found others; name another folder by --out");
}

std::vector<Task> StabilityRun::tasks() {
    std::vector<Task> tasks = still_.tasks();
    for (const Task& task : tasks)
        inOrder_.push_back(task.unit.name);
    if (motion_) {
        std::vector<Task> more = motion_->tasks(
            [this](const std::string& unit) { return units_->result(unit).value(); });
        // First what takes long, so that nobody waits for it at the end.
        tasks.insert(tasks.begin(), more.begin(), more.end());
        for (const std::string& unit : motion_->inOrder())
            inOrder_.push_back(unit);
    }
    pageUnit_ =
        fmt::format("page {}", sha256(fmt::format("{}", fmt::join(inOrder_, "\n"))).substr(0, 12));
    tasks.push_back({{pageUnit_, "page", 1}, [this] { return assembled(); }, 3});
    return tasks;
}

// Whether pictures are there, and of the page whether the CSV still has the rows.
bool StabilityRun::stands(const std::string& unit, const std::string& result) const {
    if (unit == pageUnit_) {
        if (!fs::exists(page_) || !fs::exists(csv_))
            return false;
        const std::vector<std::string> lines = linesOf(readFile(csv_)), own = linesOf(result);
        const std::set<std::string> known(lines.begin(), lines.end());
        return std::all_of(own.begin(), own.end(),
                           [&](const std::string& line) { return known.contains(line); });
    }
    if (!contains(inOrder_, unit))
        return motion_->stands(unit, result);
    const TemporalFinding finding = readFinding(result);
    return std::all_of(finding.cells.begin(), finding.cells.end(), [&](const StabilityCell& cell) {
        return cell.picture.empty() || fs::exists(options_.folder / cell.picture);
    });
}

// What the folder's CSV has of other tests and configurations.
std::vector<StabilityCell> StabilityRun::kept() const {
    if (options_.anew || !fs::exists(csv_))
        return {};
    std::vector<std::string> tests = options_.tests;
    if (options_.motion)
        tests.insert(tests.end(), options_.motion->effort.tests.begin(),
                     options_.motion->effort.tests.end());
    std::vector<StabilityCell> cells = readStabilityCsv(csv_);
    std::erase_if(cells, [&](const StabilityCell& cell) {
        return contains(tests, cell.test) &&
               (contains(options_.configurations, cell.configuration) ||
                cell.configuration == truthName);
    });
    return cells;
}

std::vector<StabilityCell> StabilityRun::found() const {
    std::vector<StabilityCell> cells;
    for (const std::string& unit : inOrder_)
        for (StabilityCell& cell : readFinding(units_->result(unit).value()).cells)
            cells.push_back(std::move(cell));
    return cells;
}

std::string StabilityRun::assembled() const {
    std::vector<StabilityCell> cells = kept(), own = found();
    cells.insert(cells.end(), own.begin(), own.end());
    writeFile(csv_, stabilityCsv(testsOf(cells), cells));
    writeStabilityPage(options_.folder);
    return stabilityCsv(testsOf(own), own);
}

std::vector<StabilityCell> StabilityRun::run(const StabilityProgress& progress) {
    doTasks(*units_, tasks_, progress);
    std::vector<StabilityCell> cells = kept(), own = found();
    cells.insert(cells.end(), own.begin(), own.end());
    return cells;
}

} // namespace

std::vector<StabilityCell> runStability(const StabilityOptions& options,
                                        const StabilityProgress& progress) {
    return StabilityRun(options).run(progress);
}

void writeStabilityPage(const fs::path& folder) {
    const std::vector<StabilityCell> cells = readStabilityCsv(folder / "stability.csv");
    writeFile(folder / "stability.html",
              stabilityHtml(testsOf(cells), cells, folder, readFile(folder / "stability.json")));
}

} // namespace obscura
