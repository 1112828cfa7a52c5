#include "bench/stability.h"

#include "bench/failure_test.h"
#include "bench/stability_csv.h"
#include "bench/stability_page.h"
#include "protocols/files.h"
#include "stimuli/page.h"

#include <fmt/format.h>

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

// "pictures/halo-hbao-steps-8.png"
std::string pictureName(std::string_view test, const std::string& configuration) {
    std::string name = fmt::format("pictures/{}-{}.png", test, configuration);
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == ' ' || c == '='; }, '-');
    return name;
}

// Visibility, and what is wrong with it.
Image8 pictureOf(const Finding& finding, double fullColour) {
    return sideBySide(grey(finding.picture), signedError(finding.picture, finding.expected,
                                                         static_cast<float>(fullColour)));
}

// Visibility by ray tracing, and what is seen.
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

std::vector<std::string> screenTechniques() {
    std::vector<std::string> ids;
    for (const Technique& technique : techniques())
        if (!(technique.reads & rays))
            ids.emplace_back(technique.id);
    return ids;
}

std::vector<StabilityCell> runStability(const StabilityOptions& options,
                                        const StabilityProgress& progress) {
    std::vector<TestedTechnique> tested; // all names are checked before the first is run
    for (const std::string& configuration : options.configurations)
        tested.emplace_back(configuration);
    std::vector<StabilityCell> cells;
    std::vector<std::unique_ptr<FailureTest>> tests;
    const std::vector<const FailureTestRow*> rows = allRows();
    const double steps = static_cast<double>(rows.size() * (tested.size() + 1));
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
        writeFile(options.folder / "stability.csv", stabilityCsv(stabilityTests(), cells));
    }
    writeStabilityPage(options.folder);
    return cells;
}

void writeStabilityPage(const fs::path& folder) {
    writeFile(folder / "stability.html",
              stabilityHtml(stabilityTests(), readStabilityCsv(folder / "stability.csv"), folder));
}

} // namespace obscura
