#include "bench/stability/stability.h"

#include "base/files.h"
#include "bench/motion/temporal_tests.h"
#include "bench/stability/csv.h"
#include "bench/stability/failure_test.h"
#include "bench/stability/page.h"
#include "image/canvas.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

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

// A finding's picture: visibility, and beside it what is wrong with it.
Image8 pictureOf(const Finding& finding, double fullColour) {
    return sideBySide(grey(finding.picture), signedError(finding.picture, finding.expected,
                                                         static_cast<float>(fullColour)));
}

// The cell with the truth's picture: visibility by ray tracing, and beside it what is seen.
StabilityCell truthCell(const FailureTestRow& row, const FailureTest& test,
                        const fs::path& folder) {
    const std::string picture = pictureName(row.about.id, truthName);
    writePng(folder / picture, sideBySide(grey(test.view().truth()), grey(test.view().lit())));
    return {truthName, "", std::string(row.about.id), std::string(row.about.measure), 0, picture};
}

std::vector<StabilityCell> cellsOf(const FailureTestRow& row, const FailureTest& test,
                                   const TestedTechnique& technique, const fs::path& folder) {
    const Finding finding = test.measure(technique);
    const StabilityCell common{technique.configuration(),
                               std::string(technique.settings().technique().id),
                               std::string(row.about.id), std::string(row.about.measure)};
    const std::string picture = pictureName(row.about.id, technique.configuration());
    writePng(folder / picture, pictureOf(finding, row.about.fail));
    std::vector<StabilityCell> cells(1 + finding.others.size(), common);
    cells[0].value = finding.value;
    cells[0].picture = picture;
    cells[0].note = finding.note;
    for (std::size_t i = 0; i < finding.others.size(); ++i) {
        cells[i + 1].measure = finding.others[i].name;
        cells[i + 1].value = finding.others[i].value;
        cells[i + 1].note = finding.others[i].note;
    }
    return cells;
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

// The truth has a row of its own, which shows what its noise leaves: a technique below it cannot be
// told from a perfect one.
std::vector<StabilityCell> cellsInMotion(const Motion& motion,
                                         const std::vector<TestedTechnique>& tested,
                                         const fs::path& folder, const TemporalProgress& progress) {
    std::vector<NamedSettings> configurations;
    Settings truth(technique("ray_traced"));
    truth.set("rays", motion.effort.rays);
    configurations.push_back({truthName, truth});
    for (const TestedTechnique& each : tested)
        configurations.push_back({each.configuration(), each.settings()});
    for (NamedSettings& each : configurations)
        if (each.settings.has("radius"))
            each.settings.set("radius", motion.radius);
    return measureTemporal(
        {motion.scene, motion.start, motion.radius, configurations, motion.effort, folder},
        progress);
}

// What the folder has of other tests and configurations, measured alike.
std::vector<StabilityCell> keptCells(const StabilityOptions& options) {
    const fs::path csv = options.folder / "stability.csv", json = options.folder / "stability.json";
    if (options.anew || !fs::exists(csv))
        return {};
    if (!fs::exists(json) || readFile(json) != options.about)
        throw Error({json.string(), 0, 0, {}},
                    "expected the program, device, size and motion that the folder's numbers were "
                    "measured with, found others; name another folder by --out");
    std::vector<std::string> tests = options.tests;
    if (options.motion)
        tests.insert(tests.end(), options.motion->effort.tests.begin(),
                     options.motion->effort.tests.end());
    std::vector<StabilityCell> cells = readStabilityCsv(csv);
    std::erase_if(cells, [&](const StabilityCell& cell) {
        return contains(tests, cell.test) &&
               (contains(options.configurations, cell.configuration) ||
                cell.configuration == truthName);
    });
    return cells;
}

} // namespace

std::vector<StabilityCell> runStability(const StabilityOptions& options,
                                        const StabilityProgress& progress) {
    std::vector<TestedTechnique> tested; // all names are checked before the first is run
    for (const std::string& configuration : options.configurations)
        tested.emplace_back(configuration);
    std::vector<std::unique_ptr<FailureTest>> tests;
    const std::vector<const FailureTestRow*> rows = rowsOf(options.tests);
    std::vector<StabilityCell> cells = keptCells(options);
    writeFile(options.folder / "stability.json", options.about);
    // The tests in motion take about as long as all others together.
    const double still = options.motion ? (rows.empty() ? 0 : 0.5) : 1,
                 steps = static_cast<double>(rows.size() * (tested.size() + 1)) / still;
    double done = 0;
    for (const FailureTestRow* row : rows) {
        progress(done++ / steps, fmt::format("scene of {}", row->about.id));
        tests.push_back(row->make(options.size));
        cells.push_back(truthCell(*row, *tests.back(), options.folder));
    }
    for (const TestedTechnique& technique : tested) {
        for (std::size_t i = 0; i < rows.size(); ++i) {
            progress(done++ / steps,
                     fmt::format("{}, {}", technique.configuration(), rows[i]->about.id));
            for (StabilityCell& cell : cellsOf(*rows[i], *tests[i], technique, options.folder))
                cells.push_back(std::move(cell));
        }
        if (!rows.empty())
            writeFile(options.folder / "stability.csv", stabilityCsv(testsOf(cells), cells));
    }
    if (options.motion) {
        const auto inMotion = cellsInMotion(
            *options.motion, tested, options.folder, [&](double share, const std::string& note) {
                progress(still + (1 - still) * share, "in motion: " + note);
            });
        cells.insert(cells.end(), inMotion.begin(), inMotion.end());
        writeFile(options.folder / "stability.csv", stabilityCsv(testsOf(cells), cells));
    }
    writeStabilityPage(options.folder);
    return cells;
}

void writeStabilityPage(const fs::path& folder) {
    const std::vector<StabilityCell> cells = readStabilityCsv(folder / "stability.csv");
    writeFile(folder / "stability.html",
              stabilityHtml(testsOf(cells), cells, folder, readFile(folder / "stability.json")));
}

} // namespace obscura
