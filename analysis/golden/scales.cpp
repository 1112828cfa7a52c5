#include "inference/scales.h"

#include "analysis/golden/golden.h"
#include "analysis/golden/table.h"
#include "analysis/golden/values.h"
#include "base/error.h"

#include "inference/agreement.h"
#include "inference/pwcmp.h"
#include <fmt/format.h>

#include <algorithm>

namespace obscura::golden {

namespace fs = std::filesystem;

namespace {

Wins winsOf(const GoldenTable& matrix) {
    const auto n = static_cast<Eigen::Index>(matrix.size());
    Wins wins(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
            wins(i, j) = matrix.number(static_cast<std::size_t>(i),
                                       matrix.text(static_cast<std::size_t>(j), "winner"));
    return wins;
}

void addScale(Values& values, const std::string& name, const char* unit,
              const std::optional<Scale>& scale) {
    if (!scale)
        return;
    const Scale from = relativeTo(*scale, 0);
    values[fmt::format("tour.{}_{}", name, unit)] = listOf(from.values);
    std::vector<double> errors = listOf(from.covariance.diagonal().array().max(0).sqrt().matrix());
    errors.erase(errors.begin());
    values[fmt::format("tour.{}_se", name == "bt" ? name : fmt::format("{}_{}", name, unit))] =
        errors;
}

// The wins of one scene, its items in the order of their first lines.
struct SceneWins {
    std::vector<std::string> items;
    std::map<std::pair<std::string, std::string>, double> counts;

    Wins matrix() const {
        const auto n = static_cast<Eigen::Index>(items.size());
        Wins wins = Wins::Zero(n, n);
        for (Eigen::Index i = 0; i < n; ++i)
            for (Eigen::Index j = 0; j < n; ++j)
                if (const auto count = counts.find(
                        {items[static_cast<std::size_t>(i)], items[static_cast<std::size_t>(j)]});
                    count != counts.end() && i != j)
                    wins(i, j) = count->second;
        return wins;
    }
};

} // namespace

void addTournament(const fs::path& folder, Values& values) {
    const GoldenTable matrix(folder / "tournament_matrix.csv");
    const Wins wins = winsOf(matrix);
    const std::optional<Scale> bt = bradleyTerry(wins);
    addScale(values, "bt", "logworth", bt);
    values["tour.bt_deviance"] = {bt ? bt->deviance : none};
    addScale(values, "thurstone_ml", "jod", thurstone(wins));
    if (const auto ls = thurstoneLeastSquares(wins)) {
        values["tour.thurstone_ls_jod"] = listOf((ls->array() - (*ls)(0)).matrix());
        values["tour.mosteller_chisq"] = {spelt(mosteller(wins, *ls)).front()};
    }

    const GoldenTable trials(folder / "tournament_trials.csv");
    std::map<std::string, std::size_t> items;
    for (std::size_t i = 0; i < matrix.size(); ++i)
        items[matrix.text(i, "winner")] = i;
    std::map<std::string, std::vector<std::int64_t>> winsByPerson;
    std::vector<std::vector<std::int64_t>> total(items.size(),
                                                 std::vector<std::int64_t>(items.size()));
    for (std::size_t i = 0; i < trials.size(); ++i) {
        const std::string &chosen = trials.text(i, "chosen"), &first = trials.text(i, "first"),
                          &second = trials.text(i, "second");
        const auto winner = items.find(chosen),
                   loser = items.find(chosen == first ? second : first);
        if (winner == items.end() || loser == items.end())
            throw Error(fmt::format("tournament_trials.csv: row {} names an item that "
                                    "tournament_matrix.csv has not",
                                    i + 1));
        ++total[winner->second][loser->second];
        std::vector<std::int64_t>& person = winsByPerson[trials.text(i, "participant_id")];
        person.resize(items.size());
        ++person[winner->second];
    }
    double circular = 0;
    std::vector<std::vector<double>> scores;
    for (const auto& [person, won] : winsByPerson) {
        const auto triads = circularTriads(won);
        circular += triads ? static_cast<double>(triads->triads) : none;
        scores.emplace_back(won.begin(), won.end());
    }
    values["tour.circular_total"] = {circular};
    if (const auto u = kendallU(total))
        values["tour.kendall_u"] = {u->u};
    if (const auto agreement = concordance(scores)) {
        values["tour.friedman_chisq_p"] = {valueOf(agreement->friedman.statistic),
                                           agreement->friedman.p};
        values["tour.kendall_W_ties"] = {agreement->w};
    }
}

void addJods(const fs::path& folder, std::vector<GoldenValue>& golden) {
    const GoldenTable table(folder / "wins.csv"), expected(folder / "jod.csv");
    std::map<std::string, SceneWins> scenes;
    for (std::size_t i = 0; i < table.size(); ++i) {
        SceneWins& scene = scenes[table.text(i, "scene")];
        for (const char* column : {"winner", "loser"})
            if (const std::string& item = table.text(i, column);
                std::find(scene.items.begin(), scene.items.end(), item) == scene.items.end())
                scene.items.push_back(item);
        scene.counts[{table.text(i, "winner"), table.text(i, "loser")}] += table.number(i, "count");
    }
    std::map<std::string, std::map<std::string, double>> jods; // by scene and prior, then item
    for (const auto& [name, scene] : scenes)
        for (const bool prior : {false, true}) {
            const Wins wins = scene.matrix();
            const auto scale = prior ? pwcmpScaleWithPrior(wins) : pwcmpScale(wins);
            for (std::size_t i = 0; i < scene.items.size(); ++i)
                jods[name + (prior ? ".gaussian" : ".none")][scene.items[i]] =
                    scale ? (*scale)(static_cast<Eigen::Index>(i)) : none;
        }
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const std::string scale = expected.text(i, "scene") + "." + expected.text(i, "prior");
        const std::string& item = expected.text(i, "condition");
        const bool known = jods.contains(scale) && jods[scale].contains(item);
        // pwcmp's optimiser stops within these of its objective's minimum.
        golden.push_back({"jod." + scale + "." + item, known ? jods[scale][item] : none,
                          expected.number(i, "jod"),
                          expected.text(i, "prior") == "none" ? 0.002 : 0.005});
    }
}

} // namespace obscura::golden
