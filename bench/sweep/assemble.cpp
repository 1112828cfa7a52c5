#include "bench/sweep/assemble.h"

#include "base/files.h"
#include "bench/measure/measured_view.h"
#include "bench/measure/timing.h"
#include "bench/sweep/merge.h"
#include "bench/sweep/results.h"
#include "renderer/techniques/fetches.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace obscura {

namespace fs = std::filesystem;

namespace {

fs::path kindsIn(const fs::path& folder) { return folder / "machines"; }

// Kinds of machine that have timed something, in an order that does not depend on when.
std::set<std::string> knownKinds(const fs::path& folder) {
    std::set<std::string> kinds;
    if (fs::is_directory(kindsIn(folder)))
        for (const fs::directory_entry& entry : fs::directory_iterator(kindsIn(folder)))
            if (entry.path().extension() == ".txt")
                if (const std::string kind = readFile(entry.path());
                    entry.path().stem() == tagOf(kind)) // else it is not ours
                    kinds.insert(kind);
    return kinds;
}

template <typename Values>
std::string spelt(const Values& values) {
    std::string text;
    for (const auto& [name, value] : values)
        text += fmt::format("{}{}={:g}", text.empty() ? "" : " ", name, value);
    return text;
}

std::string settingsText(const Settings& settings) {
    std::vector<std::pair<std::string_view, double>> values;
    for (std::size_t i = 0; i < settings.values().size(); ++i)
        values.emplace_back(settings.technique().parameters[i].name,
                            static_cast<double>(settings.values()[i]));
    return spelt(values);
}

// What is known without measuring.
SweepRow rowOf(const Configuration& configuration, const View& view, const ImageSize& size) {
    const Settings settings = settingsAt(configuration, view.radius, false);
    SweepRow row;
    row.configuration = configuration.setting.name;
    row.technique = std::string(settings.technique().id);
    row.name = variedName(row.configuration);
    row.settings = settingsText(settings);
    row.fitted = spelt(configuration.fitted);
    row.scene = sceneOf(view);
    row.view = view.name;
    row.radius = view.radius;
    row.width = size.width;
    row.height = size.height;
    row.bytes = addedBytes(settingsAt(configuration, view.radius, true), size.width, size.height) /
                (1.0 * size.width * size.height);
    row.fetches = fetchesPerPixel(settings) * (1 + guardShare(settings, size.width, size.height));
    return row;
}

class Assembling {
  public:
    Assembling(const SweepStudy& study, const fs::path& folder, const Units& units,
               const SweepMachine& about)
        : study_(study), folder_(folder), units_(units), sweep_{about, {}, {}} {}

    Sweep run();

  private:
    void addRows();
    void addErrors();
    void addTimes();
    SweepRow& rowAt(const SweepUnit& unit, std::size_t configuration);

    struct Timed : TimedKind {
        std::vector<std::pair<SweepUnit, TimesResult>> results;
    };
    Timed timedBy(const std::string& kind) const;

    const SweepStudy& study_;
    const fs::path& folder_;
    const Units& units_;
    Sweep sweep_;
};

SweepRow& Assembling::rowAt(const SweepUnit& unit, std::size_t configuration) {
    const auto size = static_cast<std::size_t>(
        std::find_if(study_.sizes.begin(), study_.sizes.end(),
                     [&](const ImageSize& each) {
                         return each.width == unit.size.width && each.height == unit.size.height;
                     }) -
        study_.sizes.begin());
    return sweep_.rows[(unit.view * study_.sizes.size() + size) * study_.match.techniques.size() +
                       configuration];
}

void Assembling::addRows() {
    std::vector<Configuration> configurations;
    for (const TechniqueSetting& setting : study_.match.techniques) {
        const auto fit = units_.result("fit of " + setting.name);
        configurations.push_back({setting, fit ? fitIn(*fit) : Fitted{}});
    }
    for (const View& view : study_.match.test)
        for (const ImageSize& size : study_.sizes)
            for (const Configuration& configuration : configurations)
                sweep_.rows.push_back(rowOf(configuration, view, size));
}

void Assembling::addErrors() {
    for (const SweepUnit& unit : sweepUnits(study_, {Measured::errors, 1, 1}, ""))
        if (unit.kind == SweepUnit::Kind::errors)
            if (const auto result = units_.result(unit.unit.name)) {
                const ErrorsResult errors = errorsIn(*result);
                static_cast<SweepErrors&>(rowAt(unit, unit.configurations.front())) = errors.errors;
                addTo(sweep_.machine.errorsBy, errors.renderer);
            }
}

Assembling::Timed Assembling::timedBy(const std::string& kind) const {
    Timed timed;
    for (const SweepUnit& unit : sweepUnits(study_, {Measured::times, 1, 1}, kind)) {
        if (unit.kind != SweepUnit::Kind::times && unit.kind != SweepUnit::Kind::growth)
            continue;
        const auto result = units_.result(unit.unit.name);
        if (!result)
            continue;
        timed.results.emplace_back(unit, timesIn(*result));
        TimesResult& times = timed.results.back().second;
        timed.rows += times.rows.size();
        if (timed.results.size() == 1)
            timed.machine = times.machine;
        addTo(timed.machine.clocks, times.machine.clocks);
        addTo(timed.machine.date, times.machine.date);
    }
    return timed;
}

void Assembling::addTimes() {
    std::vector<Timed> all;
    std::vector<TimedKind> kinds;
    for (const std::string& kind : knownKinds(folder_))
        if (Timed timed = timedBy(kind); !timed.results.empty()) {
            kinds.push_back(timed);
            all.push_back(std::move(timed));
        }
    if (all.empty())
        return;
    const Timed& kept = all[keptKind(kinds, sweep_.machine.notes)];
    static_cast<TimedOn&>(sweep_.machine) = kept.machine;
    for (const auto& [unit, times] : kept.results) {
        for (std::size_t i = 0; i < times.rows.size(); ++i)
            static_cast<SweepTimes&>(rowAt(unit, unit.configurations.at(i))) = times.rows[i];
        sweep_.growth.insert(sweep_.growth.end(), times.growth.begin(), times.growth.end());
    }
}

Sweep Assembling::run() {
    addRows();
    addErrors();
    addTimes();
    std::erase_if(sweep_.rows,
                  [](const SweepRow& row) { return !row.hasErrors() && !row.hasTimes(); });
    return std::move(sweep_);
}

} // namespace

Sweep assembled(const SweepStudy& study, const fs::path& folder, const Units& units,
                const SweepMachine& about) {
    return Assembling(study, folder, units, about).run();
}

void addKind(const fs::path& folder, const std::string& kind) {
    writeNewFile(kindsIn(folder) / (tagOf(kind) + ".txt"), kind);
}

} // namespace obscura
