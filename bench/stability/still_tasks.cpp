#include "bench/stability/still_tasks.h"

#include "bench/stability/csv.h"
#include "bench/stability/finding_text.h"
#include "bench/stability/page.h"
#include "image/canvas.h"

#include <fmt/format.h>

namespace obscura {

namespace {

// A finding's picture: visibility, and beside it what is wrong with it.
Image8 pictureOf(const Finding& finding, double fullColour) {
    return sideBySide(grey(finding.picture), signedError(finding.picture, finding.expected,
                                                         static_cast<float>(fullColour)));
}

std::vector<StabilityCell> cellsOf(const FailureTestRow& row, const TestedTechnique& technique,
                                   const Finding& finding, const std::string& picture) {
    const StabilityCell common{technique.configuration(),
                               std::string(technique.settings().technique().id),
                               std::string(row.about.id), std::string(row.about.measure)};
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

StillTasks::StillTasks(std::vector<const FailureTestRow*> tests,
                       std::vector<std::string> configurations, ImageSize size,
                       std::filesystem::path folder, std::string mark)
    : rows_(std::move(tests)), configurations_(std::move(configurations)), size_(size),
      folder_(std::move(folder)), mark_(std::move(mark)) {}

// Shaders take longer to compile than scenes to build, so that a configuration's tests are a group.
std::vector<Task> StillTasks::tasks() {
    std::vector<Task> tasks;
    const auto add = [&](const std::string& configuration, const FailureTestRow& row,
                         std::function<std::string()> work) {
        tasks.push_back(
            {{fmt::format("{}, {} {}", configuration, row.about.id, mark_), configuration, 1},
             std::move(work)});
    };
    for (const FailureTestRow* row : rows_)
        add(truthName, *row, [this, row] { return truth(*row); });
    for (const std::string& configuration : configurations_)
        for (const FailureTestRow* row : rows_)
            add(configuration, *row,
                [this, row, &configuration] { return measured(*row, configuration); });
    return tasks;
}

const FailureTest& StillTasks::test(const FailureTestRow& row) {
    std::unique_ptr<FailureTest>& test = tests_[&row];
    if (!test)
        test = row.make(size_);
    return *test;
}

// The cell with the truth's picture: visibility by ray tracing, and beside it what is seen.
std::string StillTasks::truth(const FailureTestRow& row) {
    const std::string picture = pictureName(row.about.id, truthName);
    const FailureView& view = test(row).view();
    writePng(folder_ / picture, sideBySide(grey(view.truth()), grey(view.lit())));
    return findingText(
        {{{truthName, "", std::string(row.about.id), std::string(row.about.measure), 0, picture}},
         {}});
}

std::string StillTasks::measured(const FailureTestRow& row, const std::string& configuration) {
    const TestedTechnique& technique =
        tested_.try_emplace(configuration, configuration).first->second;
    const Finding finding = test(row).measure(technique);
    const std::string picture = pictureName(row.about.id, configuration);
    writePng(folder_ / picture, pictureOf(finding, row.about.fail));
    return findingText({cellsOf(row, technique, finding, picture), {}});
}

} // namespace obscura
