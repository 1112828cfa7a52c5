#include "analysis/golden/golden.h"

#include "analysis/golden/table.h"
#include "analysis/golden/values.h"
#include "analysis/statistics.h"
#include "base/error.h"

#include "inference/equivalence.h"
#include "inference/glm.h"
#include "inference/mixed.h"
#include "inference/multiplicity.h"
#include "inference/paired.h"
#include "inference/power.h"
#include "inference/robust.h"
#include "inference/tails.h"
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <regex>

namespace obscura {

namespace fs = std::filesystem;

namespace {

using golden::none;
using golden::spelt;
using golden::valueOf;
using golden::Values;

// Of published counts, one element for each condition.
class Thesis {
  public:
    explicit Thesis(const fs::path& folder) {
        const GoldenTable table(folder / "thesis_counts.csv");
        for (std::size_t i = 0; i < table.size(); ++i)
            votes_.push_back({table.whole(i, "votes_a"), table.whole(i, "votes_b")});
    }

    void add(Values& values) const {
        for (const CountStatistic& statistic : countStatistics())
            if (!statistic.golden.empty())
                values[fmt::format("thesis.{}", statistic.golden)] =
                    each([&](Votes v) { return valueOf(statistic.of(v)); });
        values["thesis.bf10_uniform"] = each([](Votes v) { return std::exp(logBayesFactor(v)); });
        for (const auto& [name, p] :
             {std::pair("chisq", each([](Votes v) { return chiSquareP(chiSquare(v)); })),
              std::pair("exact", each(exactP))}) {
            values[fmt::format("thesis.holm_{}_all{}", name, p.size())] = holm(p);
            values[fmt::format("thesis.bh_{}_all{}", name, p.size())] = benjaminiHochberg(p);
        }
    }

    // Those whose key has a number: of a margin in percent, or a prior.
    std::vector<double> withNumber(const std::string& name, double number) const {
        if (name == "tost_p_d")
            return each([&](Votes v) { return equivalenceP(v, number / 100); });
        if (name == "rope")
            return each([&](Votes v) { return ropeProbability(v, number / 100); });
        return each([&](Votes v) { return std::exp(logBayesFactor(v, number)); });
    }

  private:
    std::vector<double> each(const std::function<double(Votes)>& statistic) const {
        std::vector<double> values;
        for (const Votes& votes : votes_)
            values.push_back(statistic(votes));
        return values;
    }
    std::vector<Votes> votes_;
};

// Of single choices: people x conditions.
class Trials {
  public:
    explicit Trials(const fs::path& folder) {
        const GoldenTable table(folder / "trials_2afc_28x7.csv");
        std::map<std::string, std::size_t> people;
        for (std::size_t i = 0; i < table.size(); ++i) {
            const auto person =
                people.try_emplace(table.text(i, "participant_id"), people.size()).first->second;
            rows_.push_back({static_cast<int>(person), table.whole(i, "condition_id") - 1,
                             table.text(i, "second_image") == "B",
                             table.whole(i, "chosen_position") == 2, table.whole(i, "chose_b") == 1,
                             table.number(i, "decision_rt_ms")});
            if (rows_.back().condition < 0)
                throw Error("trials_2afc_28x7.csv: expected conditions numbered from 1");
            conditions_ = std::max(conditions_, rows_.back().condition + 1);
        }
        answers_.assign(people.size(), std::vector<int>(static_cast<std::size_t>(conditions_)));
        for (const Row& row : rows_)
            answers_[static_cast<std::size_t>(row.person)]
                    [static_cast<std::size_t>(row.condition)] = row.choseB;
    }

    void add(Values& values) const {
        values["trials.counts_b"] = columnTotals(answers_);
        std::vector<double> p;
        for (const double b : columnTotals(answers_))
            p.push_back(
                exactP({static_cast<std::int64_t>(answers_.size()) - static_cast<std::int64_t>(b),
                        static_cast<std::int64_t>(b)}));
        values["trials.exact_p"] = p;
        values["trials.holm_exact"] = holm(p);
        values[fmt::format("trials.cochranQ{}", conditions_)] = spelt(cochranQ(answers_));
        values["trials.cochranQ_cb"] = spelt(cochranQ(columns({1, 3, 6})));
        addOrder(values);
        addModels(values);
        addTimes(values);
    }

    std::vector<double> mcNemar(int first, int second) const {
        PairedVotes votes;
        for (const std::vector<int>& row : columns({first, second}))
            ++(row[0] ? (row[1] ? votes.both : votes.firstOnly)
                      : (row[1] ? votes.secondOnly : votes.neither));
        const McNemar m = mcnemar(votes);
        return {static_cast<double>(m.firstOnly),
                static_cast<double>(m.secondOnly),
                valueOf(m.uncorrected.statistic),
                m.uncorrected.p,
                valueOf(m.corrected.statistic),
                m.corrected.p,
                m.exactP,
                m.midP};
    }

  private:
    struct Row {
        int person, condition;
        bool bSecond, choseSecond, choseB;
        double decisionMs;
    };

    AnswerTable columns(const std::vector<int>& conditions) const {
        AnswerTable table;
        for (const std::vector<int>& row : answers_) {
            table.emplace_back();
            for (const int condition : conditions)
                table.back().push_back(row.at(static_cast<std::size_t>(condition) - 1));
        }
        return table;
    }

    void addOrder(Values& values) const {
        Votes second;
        std::vector<FourfoldTable> strata(static_cast<std::size_t>(conditions_));
        for (const Row& row : rows_) {
            ++(row.choseSecond ? second.b : second.a);
            FourfoldTable& stratum = strata[static_cast<std::size_t>(row.condition)];
            Votes& votes = row.bSecond ? stratum.first : stratum.second;
            ++(row.choseB ? votes.b : votes.a);
        }
        values["trials.second_chosen"] = {static_cast<double>(second.b)};
        values["trials.second_exact_p"] = {exactP(second)};
        const auto mh = mantelHaenszel(strata);
        const bool odds = mh && mh->logOddsRatio;
        values["trials.mh_M2_p_or"] = {mh ? valueOf(mh->test.statistic) : none,
                                       mh ? mh->test.p : none,
                                       odds ? std::exp(mh->logOddsRatio->value) : none};
    }

    // A column for each condition, the first for all where there is an intercept; then the
    // position of b.
    BinomialData data(bool intercept) const {
        const auto n = static_cast<Eigen::Index>(rows_.size());
        BinomialData data{Eigen::MatrixXd::Zero(n, conditions_ + 1), Eigen::VectorXd(n),
                          Eigen::VectorXd::Ones(n)};
        for (Eigen::Index i = 0; i < n; ++i) {
            const Row& row = rows_[static_cast<std::size_t>(i)];
            data.design(i, row.condition) = 1;
            if (intercept)
                data.design(i, 0) = 1;
            data.design(i, conditions_) = row.bSecond ? 0.5 : -0.5;
            data.successes(i) = row.choseB;
        }
        return data;
    }

    void addModels(Values& values) const {
        const GlmFit glm = fitGlm(data(true));
        values["trials.glm_coef"] = golden::listOf(glm.coefficients);
        values["trials.glm_loglik"] = {glm.logLikelihood};
        std::vector<int> people;
        for (const Row& row : rows_)
            people.push_back(row.person);
        const MixedFit mixed = fitMixed(data(false), people);
        values["trials.glmm15_coef"] = golden::listOf(mixed.coefficients);
        values["trials.glmm15_sd"] = {mixed.sd};
        values["trials.glmm15_loglik"] = {mixed.logLikelihood};
    }

    void addTimes(Values& values) const {
        std::vector<double> times;
        for (const Row& row : rows_)
            times.push_back(row.decisionMs);
        if (const auto s = summary(times))
            values["rt.mean_sd_median_mad_geo_trim10"] = {
                s->mean,       valueOf(s->sd), s->median, s->mad, valueOf(s->geometricMean),
                s->trimmedMean};
        for (const FlagRule rule : {FlagRule::fast, FlagRule::sd, FlagRule::sdLog, FlagRule::mad,
                                    FlagRule::madLog, FlagRule::tukey}) {
            const std::vector<bool> flagged = flags(times, rule);
            values["rt.flagged_counts"].push_back(
                static_cast<double>(std::count(flagged.begin(), flagged.end(), true)));
        }
    }

    std::vector<Row> rows_;
    AnswerTable answers_;
    int conditions_ = 0;
};

// Values whose key has numbers; nothing when it is none of these.
std::optional<std::vector<double>> byNumbers(const std::string& key, const Thesis& thesis,
                                             const Trials& trials) {
    std::smatch parts;
    const auto is = [&](const char* pattern) {
        return std::regex_match(key, parts, std::regex(pattern));
    };
    const auto number = [&](std::size_t i) { return std::stod(parts[i]); };
    if (is(R"(thesis\.(tost_p_d|rope|bf10_beta)(\d{1,4}))"))
        return thesis.withNumber(parts[1], number(2));
    if (is(R"(trials\.mcnemar_(\d{1,4})v(\d{1,4}))"))
        return trials.mcNemar(std::stoi(parts[1]), std::stoi(parts[2]));
    // N80 and N90: how many people give that power; other N: the power that so many give.
    if (is(R"(power\.exact\.N(80|90)\.p(\d\d))"))
        return std::vector{
            static_cast<double>(sampleSize(exactP, number(2) / 100, number(1) / 100).value_or(0))};
    if (is(R"(power\.exact\.N(\d{1,6})\.p(\d\d))"))
        return std::vector{power(exactP, std::stoi(parts[1]), number(2) / 100)};
    if (is(R"(power\.tost\.N(80|90)\.d(\d\d))"))
        return std::vector{static_cast<double>(
            equivalenceSampleSize(number(2) / 100, 0.5, number(1) / 100).value_or(0))};
    return std::nullopt;
}

// "key[2]" is the key and 1; "key" is 0.
std::pair<std::string, std::size_t> elementOf(const std::string& key) {
    std::smatch parts;
    if (std::regex_match(key, parts, std::regex(R"((.*)\[([1-9]\d{0,5})\])")))
        return {parts[1], std::stoul(parts[2]) - 1};
    return {key, 0};
}

void addStatistics(const fs::path& folder, std::vector<GoldenValue>& all) {
    const GoldenTable expected(folder / "golden_values.csv");
    const Thesis thesis(folder);
    const Trials trials(folder);
    Values values;
    thesis.add(values);
    trials.add(values);
    golden::addTournament(folder, values);
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const auto [key, element] = elementOf(expected.text(i, "key"));
        if (!values.contains(key))
            if (const auto computed = byNumbers(key, thesis, trials))
                values[key] = *computed;
        const auto found = values.find(key);
        const bool known = found != values.end() && element < found->second.size();
        all.push_back({expected.text(i, "key"), known ? found->second[element] : none,
                       expected.number(i, "value"), expected.number(i, "abs_tol")});
    }
}

} // namespace

bool GoldenValue::holds() const {
    return std::isnan(expected) ? std::isnan(computed) : std::abs(computed - expected) <= tolerance;
}

std::vector<GoldenValue> goldenValues(const fs::path& folder) {
    std::vector<GoldenValue> all;
    if (fs::exists(folder / "golden_values.csv"))
        addStatistics(folder, all);
    for (const fs::path& human : {folder, folder / "human"})
        if (fs::exists(human / "jod.csv"))
            golden::addJods(human, all);
    if (all.empty())
        throw Error({folder.string(), 0, 0, {}},
                    "expected golden_values.csv with its data files, or jod.csv with wins.csv, "
                    "found neither");
    return all;
}

int printGolden(const fs::path& folder) {
    const std::vector<GoldenValue> all = goldenValues(folder);
    const auto spell = [](double value) {
        return std::isnan(value) ? std::string("absent") : fmt::format("{:.12g}", value);
    };
    fmt::print("{:<40} {:>20} {:>20} {:>10}\n", "key", "value", "expected", "difference");
    for (const GoldenValue& one : all)
        fmt::print("{:<40} {:>20} {:>20} {:>10.2g}  {}\n", one.key, spell(one.computed),
                   spell(one.expected), one.computed - one.expected,
                   one.holds() ? "within" : fmt::format("NOT WITHIN {:g}", one.tolerance));
    const auto wrong =
        std::count_if(all.begin(), all.end(), [](const GoldenValue& one) { return !one.holds(); });
    fmt::print("\n{} of {} values are within their tolerance\n",
               all.size() - static_cast<std::size_t>(wrong), all.size());
    return wrong ? 1 : 0;
}

} // namespace obscura
