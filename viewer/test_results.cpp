#include "viewer/test_results.h"

#include "base/csv.h"
#include "viewer/seen.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

namespace {

using fmt::format;

// The technique's settings as a protocol has them, for a name alone does not say them.
std::string settingsText(const TechniqueSetting& technique) {
    return tomlInline(techniqueFields(technique));
}

const TechniqueSetting& techniqueNamed(const TestPlan& plan, const std::string& name) {
    return *std::find_if(plan.techniques.begin(), plan.techniques.end(),
                         [&](const TechniqueSetting& each) { return each.name == name; });
}

const View& cameraNamed(const TestPlan& plan, const std::string& name) {
    return *std::find_if(plan.cameras.begin(), plan.cameras.end(),
                         [&](const View& each) { return each.name == name; });
}

double meanFps(const std::vector<TestRow>& rows, const std::string& camera,
               const std::string& technique) {
    double sum = 0;
    int count = 0;
    for (const TestRow& row : rows)
        if (row.camera == camera && row.technique == technique) {
            sum += row.fps();
            ++count;
        }
    return sum / count;
}

} // namespace

double TestRow::techniqueMs() const {
    double sum = 0;
    for (const PassDrawn& pass : passes)
        sum += pass.ms;
    return sum;
}

std::string testCsv(const TestPlan& plan, const TestMachine& machine,
                    const std::vector<TestRow>& rows) {
    std::string text = "round,place,scene,camera,technique,settings,width,height,frames,seconds,"
                       "mean_fps,gbuffer_ms,light_ms,technique_ms,prepare_ms,gather_ms,filter_ms,"
                       "upsample_ms,seed,timed,renderer,processor,program\n";
    for (const TestRow& row : rows) {
        const View& view = cameraNamed(plan, row.camera);
        std::array<double, 4> work{};
        for (const PassDrawn& pass : row.passes)
            work[static_cast<std::size_t>(pass.work)] += pass.ms;
        text += format(
            "{},{},{},{},{},{},{},{},{},{:.6f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},"
            "{:.4f},{:.4f},{},{},{},{},{}\n",
            row.round, row.place, csvCell(view.file.empty() ? view.builtin : view.file),
            csvCell(row.camera), csvCell(row.technique),
            csvCell(settingsText(techniqueNamed(plan, row.technique))), plan.width, plan.height,
            row.frames, row.seconds, row.fps(), row.gbufferMs, row.lightMs, row.techniqueMs(),
            work[0], work[1], work[2], work[3], plan.seed, csvCell(machine.timed),
            csvCell(machine.renderer), csvCell(machine.processor), csvCell(machine.program));
    }
    return text;
}

std::string passesCsv(const std::vector<TestRow>& rows) {
    std::string text = "round,camera,technique,pass,work,ms\n";
    for (const TestRow& row : rows)
        for (const PassDrawn& pass : row.passes)
            text += format("{},{},{},{},{},{:.4f}\n", row.round, csvCell(row.camera),
                           csvCell(row.technique), csvCell(pass.name),
                           workNames()[static_cast<std::size_t>(pass.work)], pass.ms);
    return text;
}

std::string leedsTable(const TestPlan& plan, const std::vector<TestRow>& rows) {
    if (rows.empty())
        return "Stopped before the first round had ended: no results.\n";
    std::vector<std::vector<std::string>> lines(1, {"Camera"});
    for (const TechniqueSetting& technique : plan.techniques)
        lines[0].push_back(technique.name + " (average FPS)");
    std::vector<double> sums(plan.techniques.size());
    for (const View& camera : plan.cameras) {
        lines.push_back({camera.name});
        for (std::size_t i = 0; i < plan.techniques.size(); ++i) {
            const double fps = meanFps(rows, camera.name, plan.techniques[i].name);
            lines.back().push_back(format("{:.3f}", fps));
            sums[i] += fps;
        }
    }
    lines.push_back({"Average"});
    for (const double sum : sums)
        lines.back().push_back(format("{:.3f}", sum / static_cast<double>(plan.cameras.size())));
    std::vector<std::size_t> widths(lines[0].size());
    for (const auto& line : lines)
        for (std::size_t i = 0; i < line.size(); ++i)
            widths[i] = std::max(widths[i], line[i].size());
    std::string text;
    for (const auto& line : lines) {
        text += format("{:<{}}", line[0], widths[0]);
        for (std::size_t i = 1; i < line.size(); ++i)
            text += format("  {:>{}}", line[i], widths[i]);
        text += "\n";
    }
    return text;
}

} // namespace obscura
