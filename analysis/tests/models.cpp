#include "analysis/tests/tests.h"

#include "inference/gee.h"
#include "inference/mixed.h"
#include "inference/tails.h"
#include <Eigen/Cholesky>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace obscura {

namespace {

constexpr std::size_t mostRows = 200'000; // for a model of single answers that is fitted at once
constexpr std::size_t mostNumbers = 5'000'000; // of its design

// From so many people on the likelihood ratio of 7 conditions keeps its promise (docs/validity.md):
// where nothing differed, p < .05 in 5.6 to 5.9 % of 10,000 studies of 28 people, in 5.2 % of 56.
constexpr std::size_t manyPeople = 56;

// The conditions with votes, and which of their answers are of which order. The place of b can be
// told from the conditions only where one of them was shown in both orders.
struct Cells {
    std::unordered_map<std::uint32_t, Eigen::Index> columns; // of conditions, by symbol
    std::vector<std::array<Votes, 2>> votes;                 // b second, b first
    bool positionTold = false;

    Eigen::Index conditions() const { return static_cast<Eigen::Index>(votes.size()); }
    Eigen::Index columnOf(const Vote& row) const { return columns.at(row.conditionId.number()); }
};

constexpr std::array<double, 2> placeOf = {0.5, -0.5}; // b second, b first

Cells cellsOf(const StudyData& data) {
    Cells cells;
    for (const Tally& tally : data.tallies)
        if (tally.votes.total() > 0)
            cells.columns.try_emplace(Symbol(tally.condition).number(),
                                      static_cast<Eigen::Index>(cells.columns.size()));
    cells.votes.resize(cells.columns.size());
    for (const Answer& answer : *data.answers) {
        Votes& votes = cells.votes[static_cast<std::size_t>(cells.columnOf(answer.row))]
                                  [answer.row.aFirst ? 0 : 1];
        ++(answer.row.choseB ? votes.b : votes.a);
    }
    for (const auto& [second, first] : cells.votes)
        cells.positionTold = cells.positionTold || (second.total() > 0 && first.total() > 0);
    return cells;
}

// One column for each condition, or one for all, and then the place of b where it can be told.
struct Columns {
    bool conditions, position;
    Eigen::Index first(const Cells& cells) const { return conditions ? cells.conditions() : 1; }
    Eigen::Index count(const Cells& cells) const { return first(cells) + position; }
};

BinomialData emptyModel(Eigen::Index rows, Eigen::Index columns) {
    return {Eigen::MatrixXd::Zero(rows, columns), Eigen::VectorXd::Zero(rows),
            Eigen::VectorXd::Ones(rows)};
}

// A row for each condition and order.
BinomialData tallied(const Cells& cells, Columns columns) {
    BinomialData model = emptyModel(2 * cells.conditions(), columns.count(cells));
    for (Eigen::Index i = 0; i < model.successes.size(); ++i) {
        const auto order = static_cast<std::size_t>(i % 2);
        const Votes votes = cells.votes[static_cast<std::size_t>(i / 2)][order];
        model.design(i, columns.conditions ? i / 2 : 0) = 1;
        if (columns.position)
            model.design(i, columns.first(cells)) = placeOf[order];
        model.successes(i) = static_cast<double>(votes.b);
        model.trials(i) = static_cast<double>(votes.total());
    }
    return model;
}

// A row for each answer.
BinomialData singly(const StudyData& data, const Cells& cells, Columns columns) {
    const auto rows = static_cast<Eigen::Index>(data.answers->size());
    BinomialData model = emptyModel(rows, columns.count(cells));
    for (Eigen::Index i = 0; i < rows; ++i) {
        const Vote& row = (*data.answers)[static_cast<std::size_t>(i)].row;
        model.design(i, columns.conditions ? cells.columnOf(row) : 0) = 1;
        if (columns.position)
            model.design(i, columns.first(cells)) = placeOf[row.aFirst ? 0 : 1];
        model.successes(i) = row.choseB;
    }
    return model;
}

std::vector<int> personsOf(const StudyData& data) {
    std::unordered_map<std::uint64_t, int> numbers;
    std::vector<int> persons;
    for (const Answer& answer : *data.answers)
        persons.push_back(numbers.try_emplace(answer.row.person(), static_cast<int>(numbers.size()))
                              .first->second);
    return persons;
}

bool tooLarge(const StudyData& data, const Cells& cells) {
    return data.answers->size() > mostRows ||
           data.answers->size() * (cells.votes.size() + 1) > mostNumbers;
}

StudyTest notFitted() {
    return {"all conditions", std::nullopt,
            fmt::format("not fitted to more than {} votes, or {} votes times conditions", mostRows,
                        mostNumbers)};
}

const char* const conditionsDiffer = "do the conditions differ in the share of b? ({})";

std::string positionNote(const Cells& cells) {
    return cells.positionTold ? ""
                              : "each condition had b always in the same place: what is the "
                                "condition's and what is the place's cannot be told";
}

// That b is second rather than first: Wald's test of the last coefficient, by Student's t where
// there are degrees of freedom.
StudyTest positionTest(double beta, double variance, std::optional<double> df, std::string note) {
    const double z = beta / std::sqrt(variance);
    return {fmt::format("position: b second multiplies its odds by {:.2f} (Wald)", std::exp(beta)),
            Test{z, df, df ? studentP(z, *df) : normalP(z)}, std::move(note)};
}

// Wald's test that the first coefficients are equal, by Fisher's F; absent where the covariance has
// no inverse.
std::optional<Test> equalCoefficients(const Eigen::VectorXd& coefficients,
                                      const Eigen::MatrixXd& covariance, Eigen::Index count,
                                      double denominatorDf) {
    const Eigen::Index df = count - 1;
    Eigen::MatrixXd contrasts = Eigen::MatrixXd::Zero(df, coefficients.size());
    contrasts.col(0).setConstant(-1);
    contrasts.block(0, 1, df, df).setIdentity();
    const Eigen::VectorXd differences = contrasts * coefficients;
    const Eigen::LDLT<Eigen::MatrixXd> factor(contrasts * covariance * contrasts.transpose());
    if (factor.info() != Eigen::Success || factor.vectorD().minCoeff() <= 1e-12)
        return std::nullopt;
    const double statistic = differences.dot(factor.solve(differences)) / static_cast<double>(df);
    return Test{statistic, static_cast<double>(df),
                fisherFP(statistic, static_cast<double>(df), denominatorDf)};
}

} // namespace

std::vector<StudyTest> logisticTests(const StudyData& data) {
    if (!data.answers)
        return {};
    const Cells cells = cellsOf(data);
    if (cells.conditions() < 2)
        return {};
    const bool position = cells.positionTold;
    const char* trust = "takes every vote for another person's: trust the mixed model";
    const GlmFit full = fitGlm(tallied(cells, {true, position}));
    const GlmFit equal = fitGlm(tallied(cells, {false, position}));
    std::vector<StudyTest> tests = {
        {fmt::format(fmt::runtime(conditionsDiffer), "likelihood ratio"),
         likelihoodRatio(equal.logLikelihood, full.logLikelihood,
                         static_cast<int>(cells.conditions()) - 1),
         joined({trust, positionNote(cells)})}};
    if (!position)
        return tests;
    const GlmFit without = fitGlm(tallied(cells, {true, false}));
    const double beta = full.coefficients(cells.conditions());
    tests.push_back({full.separated
                         ? "position: the odds of b when it is second (likelihood ratio)"
                         : fmt::format("position: b second multiplies its odds by {:.2f} "
                                       "(likelihood ratio)",
                                       std::exp(beta)),
                     likelihoodRatio(without.logLikelihood, full.logLikelihood, 1), trust});
    return tests;
}

std::vector<StudyTest> geeTests(const StudyData& data) {
    if (!data.answers)
        return {};
    const Cells cells = cellsOf(data);
    const auto people = static_cast<int>(data.people.size());
    if (cells.conditions() < 2 || people < 2)
        return {};
    if (tooLarge(data, cells))
        return {notFitted()};
    const GeeFit fit = fitGee(singly(data, cells, {true, cells.positionTold}), personsOf(data));
    const std::string about = fmt::format(fmt::runtime(conditionsDiffer), "Wald");
    if (fit.separated)
        return {{about, std::nullopt, "a condition is unanimous: there is no finite estimate"}};
    const auto df = static_cast<double>(people - fit.coefficients.size());
    if (df < 1 || !fit.corrected)
        return {{about, std::nullopt,
                 fmt::format("of {} people the errors of {} coefficients cannot be told", people,
                             fit.coefficients.size())}};
    const std::string note =
        joined({fmt::format("correlation of two answers of a person {:.3f}", fit.correlation),
                fit.converged ? "" : "no correlation fits: fitted as if there were none"});
    const Eigen::MatrixXd& covariance = *fit.corrected;
    const Eigen::Index last = cells.conditions();
    std::vector<StudyTest> tests = {
        {about, equalCoefficients(fit.coefficients, covariance, last, df),
         joined({fmt::format("Fisher's F with {} and {:g} degrees of freedom", last - 1, df), note,
                 positionNote(cells)})}};
    if (cells.positionTold && covariance(last, last) > 0)
        tests.push_back(positionTest(fit.coefficients(last), covariance(last, last), df, note));
    return tests;
}

std::vector<StudyTest> mixedTests(const StudyData& data) {
    if (!data.answers)
        return {};
    const Cells cells = cellsOf(data);
    if (cells.conditions() < 2)
        return {};
    if (tooLarge(data, cells))
        return {notFitted()};
    const bool position = cells.positionTold;
    const std::vector<int> person = personsOf(data);
    const MixedFit full = fitMixed(singly(data, cells, {true, position}), person);
    const MixedFit equal = fitMixed(singly(data, cells, {false, position}), person);
    const std::string people = full.identified
                                   ? fmt::format("between people: sd {:.2f} (logit)", full.sd)
                                   : "nobody answered twice: how people differ cannot be told";
    std::vector<StudyTest> tests = {
        {fmt::format(fmt::runtime(conditionsDiffer), "likelihood ratio"),
         likelihoodRatio(equal.logLikelihood, full.logLikelihood,
                         static_cast<int>(cells.conditions()) - 1),
         joined({data.people.size() < manyPeople
                     ? fmt::format("of {} people this p is a little too small: near .05 do not "
                                   "believe it",
                                   data.people.size())
                     : "",
                 people, positionNote(cells)})}};
    const Eigen::Index last = cells.conditions();
    if (position && full.converged && !full.separated)
        tests.push_back(
            positionTest(full.coefficients(last), full.covariance(last, last), {}, people));
    return tests;
}

} // namespace obscura
