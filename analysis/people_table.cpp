#include "analysis/people_table.h"

#include "analysis/table.h"
#include "base/csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <string_view>

namespace obscura {

namespace {

// A column of people.csv.
struct PersonCell {
    std::string_view name;
    std::string (*cell)(const Person&);
};

template <Estimate ObserverTraits::*member, double Estimate::*part>
std::string observer(const Person& person) {
    return person.observer ? digits((*person.observer).*member.*part) : "";
}

std::string ratio(const Votes& votes) {
    return votes.total() > 0
               ? digits(static_cast<double>(votes.b) / static_cast<double>(votes.total()))
               : "";
}

using P = Person;
using O = ObserverTraits;
using E = Estimate;
const PersonCell columns[] = {
    {"study_id", [](const P& p) { return csvCell(p.study.text()); }},
    {"participant_id", [](const P& p) { return csvCell(p.participant.text()); }},
    {"sessions", [](const P& p) { return fmt::format("{}", p.sessions); }},
    {"trials", [](const P& p) { return fmt::format("{}", p.trials()); }},
    {"second_chosen", [](const P& p) { return fmt::format("{}", p.places.b); }},
    {"share_second", [](const P& p) { return ratio(p.places); }},
    {"p_exact", [](const P& p) { return digits(p.p); }},
    {"p_holm", [](const P& p) { return digits(p.holm); }},
    {"repeat_pairs", [](const P& p) { return fmt::format("{}", p.repeats.total()); }},
    {"consistency", [](const P& p) { return ratio(p.repeats); }},
    {"bias_second", // the model's is towards the first
     [](const P& p) { return p.observer ? digits(0 - p.observer->bias.value) : ""; }},
    {"bias_se", observer<&O::bias, &E::standardError>},
    {"lapse", observer<&O::lapse, &E::value>},
    {"lapse_se", observer<&O::lapse, &E::standardError>},
    {"reliability", observer<&O::precision, &E::value>},
    {"reliability_se", observer<&O::precision, &E::standardError>},
    {"median_view1_ms", [](const P& p) { return digits(p.view1Ms); }},
    {"median_view2_ms", [](const P& p) { return digits(p.view2Ms); }},
    {"median_decision_ms", [](const P& p) { return digits(p.decisionMs); }},
    {"flagged_times", [](const P& p) { return fmt::format("{}", p.flaggedTimes); }},
    {"flags", [](const P& p) { return fmt::format("{}", fmt::join(flagsOf(p), " ")); }},
};

} // namespace

std::string peopleCsv(const Findings& findings) {
    std::string csv = "source";
    for (const PersonCell& column : columns)
        csv.append(",").append(column.name);
    csv += "\n";
    const std::string source = csvCell(sourceOf(findings));
    for (const Person& person : findings.people->persons) {
        csv += source;
        for (const PersonCell& column : columns)
            csv.append(",").append(column.cell(person));
        csv += "\n";
    }
    return csv;
}

std::string timesCsv(const Findings& findings) {
    const ResponseTimes& times = findings.people->times;
    std::string csv = "source,measure,trials,mean,sd,median,mad,geometric_mean,trimmed_mean";
    for (const double share : timeShares)
        csv += fmt::format(",quantile_{:02.0f}", 100 * share);
    for (const NamedRule& rule : flagRules())
        csv += fmt::format(",flagged_{}", rule.id);
    csv += "\n";
    for (const ResponseTimes::Measure& measure : times.measures) {
        const Summary& s = measure.summary;
        csv += fmt::format("{},{},{},{},{},{},{},{},{},{}", csvCell(sourceOf(findings)), measure.id,
                           s.count, s.mean, digits(s.sd), s.median, s.mad, digits(s.geometricMean),
                           s.trimmedMean, fmt::join(measure.quantiles, ","));
        const bool decision = &measure == &times.measures.back();
        for (const std::int64_t flagged : times.flagged)
            csv += decision ? fmt::format(",{}", flagged) : ",";
        csv += "\n";
    }
    return csv;
}

} // namespace obscura
