// Scales of studies of pairs: through the rows, the rules and the tallies.
#include "analysis/findings.h"
#include "analysis/scales/scale_table.h"
#include "analysis/scales/scale_words.h"
#include "tests/analysis/sample_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace obscura {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

const ScaleResult& resultOf(const ScaleFindings& scales, std::string_view kind,
                            const std::string& level = "moderate") {
    for (const Scaled& one : scales.all)
        if (one.kind->id == kind && one.result.group.level == level)
            return one.result;
    ADD_FAILURE() << "no scale " << kind;
    static const ScaleResult none{};
    return none;
}

const ScaleDiagnostic& diagnosticOf(const ScaleResult& result, const std::string& begin) {
    for (const ScaleDiagnostic& one : result.diagnostics)
        if (one.name.starts_with(begin))
            return one;
    ADD_FAILURE() << "no diagnostic " << begin;
    static const ScaleDiagnostic none{};
    return none;
}

// Of two techniques, what each person in turn chose: '1' the second of them.
struct Pair {
    std::string a, b, chosen;
};

Findings study(const std::filesystem::path& folder, const std::vector<Pair>& pairs) {
    std::vector<Response> rows;
    for (std::size_t pair = 0; pair < pairs.size(); ++pair)
        for (std::size_t person = 0; person < pairs[pair].chosen.size(); ++person) {
            Response row =
                test::sampleResponse(static_cast<int>(person) + 1, fmt::format("c{}", pair + 1),
                                     pairs[pair].chosen[person] == '1');
            row.techniqueA = pairs[pair].a;
            row.techniqueB = pairs[pair].b;
            row.chosenTechnique = row.choseB ? row.techniqueB : row.techniqueA;
            row.trialIndex = static_cast<int>(pair) + 1;
            rows.push_back(row);
        }
    const std::filesystem::path file[] = {test::writeRows(folder / "rows.csv", rows)};
    return findingsOf(collectAnswers(file, {}), std::nullopt);
}

// The tournament of psychophysics.md 5.3: 24 people, all pairs of four; golden values by R 4.2.2.
const std::vector<Pair> tournament = {
    {"None", "Crytek24", "111111000000110011110110"},
    {"None", "Blizzard24", "111010111011110011111011"},
    {"None", "RayMarching30", "001101111111011110111011"},
    {"Crytek24", "Blizzard24", "000100110111111001111010"},
    {"Crytek24", "RayMarching30", "111111110001111011111110"},
    {"Blizzard24", "RayMarching30", "101010110001101101100010"},
};

void expectScale(const ScaleResult& result, const std::vector<double>& values,
                 const std::vector<double>& errors) {
    ASSERT_EQ(result.items.size(), values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_NEAR(result.items[i].value, values[i], 1e-6) << result.items[i].name;
        if (i == 0)
            continue;
        EXPECT_NEAR(*result.items[i].standardError, errors[i - 1], 1e-5);
        EXPECT_NEAR(*result.items[i].interval.low, values[i] - 1.959964 * errors[i - 1], 1e-4);
    }
}

TEST(ScalesOfPairs, AreRsOfTheTournamentWhereNobodyIsTold) {
    const test::Folder folder;
    const Findings people = study(folder.path(), tournament);
    const Findings counts = findingsOf("counts", people.tallies);
    expectScale(resultOf(counts.scales, "thurstone"),
                {0, 0.292984169, 0.905972342467, 1.11868732395},
                {0.277891298122, 0.282629656221, 0.287145220569});
    const ScaleResult& worths = resultOf(counts.scales, "bradley-terry");
    expectScale(worths, {0, 0.324988554951, 0.993611338547, 1.22529014542},
                {0.306670737463, 0.315879398478, 0.323729584049});
    EXPECT_NEAR(*diagnosticOf(worths, "does the scale fit").test->statistic, 1.88306065926, 1e-6);
    EXPECT_THAT(worths.intervals, HasSubstr("nobody knows who answered what"));
}

TEST(ScalesOfPairs, HaveAgreementAndResampledIntervalsOfPeople) {
    const test::Folder folder;
    const Findings findings = study(folder.path(), tournament);
    const ScaleResult& scale = resultOf(findings.scales, "thurstone");
    EXPECT_NEAR(scale.items[3].value, 1.11868732395, 1e-6);
    EXPECT_THAT(scale.intervals, HasSubstr("bootstrap over 24 people"));
    EXPECT_NEAR(*scale.items[3].standardError, 0.29, 0.08); // near the likelihood's 0.287
    EXPECT_LT(*scale.items[3].interval.low, 1.1);
    EXPECT_GT(*scale.items[3].interval.low, 0.3);
    EXPECT_EQ(*diagnosticOf(scale, "circular triads, of 24 people").value, 25);
    EXPECT_NEAR(*diagnosticOf(scale, "Kendall's u").value, 0.11231884058, 1e-9);
    const ScaleDiagnostic& friedman = diagnosticOf(scale, "Kendall's W");
    EXPECT_NEAR(*friedman.value, 0.246359223301, 1e-9);
    EXPECT_NEAR(*friedman.test->statistic, 17.7378640777, 1e-8);
    EXPECT_NEAR(friedman.test->p, 0.000498136648414, 1e-9);
}

TEST(ScalesOfPairs, CorrectTheStepsBetweenNeighboursByHolm) {
    const test::Folder folder;
    const Findings findings = findingsOf("counts", study(folder.path(), tournament).tallies);
    const ScaleResult& scale = resultOf(findings.scales, "thurstone");
    ASSERT_EQ(scale.steps.size(), 3u);
    EXPECT_EQ(scale.items[scale.steps[1].from].name, "Crytek24");
    EXPECT_EQ(scale.items[scale.steps[1].to].name, "Blizzard24");
    std::vector<double> p, adjusted;
    for (const ScaleStep& step : scale.steps) {
        p.push_back(*step.p);
        adjusted.push_back(*step.holm);
    }
    const double least = *std::min_element(p.begin(), p.end());
    EXPECT_NEAR(*std::min_element(adjusted.begin(), adjusted.end()), 3 * least, 1e-12);
}

// From whichever technique a scale begins, two of them are as far apart.
TEST(ScalesOfPairs, HaveTheIntervalOfEveryDifference) {
    const test::Folder folder;
    std::vector<Pair> turned; // begins at the last one
    for (auto pair = tournament.rbegin(); pair != tournament.rend(); ++pair) {
        std::string chosen = pair->chosen;
        for (char& one : chosen)
            one = one == '1' ? '0' : '1';
        turned.push_back({pair->b, pair->a, chosen});
    }
    const Findings one = study(folder / "one", tournament), other = study(folder / "other", turned);
    const ScaleResult &scale = resultOf(one.scales, "thurstone"),
                      &fromLast = resultOf(other.scales, "thurstone");
    ASSERT_EQ(scale.pairs.size(), 6u);
    ASSERT_EQ(fromLast.items[0].name, "RayMarching30");
    for (std::size_t i = 1; i < fromLast.items.size(); ++i) {
        const ScaleItem& item = fromLast.items[i];
        std::size_t same = 0;
        while (scale.items[same].name != item.name)
            ++same;
        const auto step = differenceOf(scale, 3, same);
        ASSERT_TRUE(step) << item.name;
        EXPECT_NEAR(step->difference, item.value, 1e-6);
        EXPECT_NEAR(*step->standardError, *item.standardError, 1e-6);
        EXPECT_NEAR(*step->interval.low, *item.interval.low, 1e-6);
        EXPECT_NEAR(*step->interval.high, *item.interval.high, 1e-6);
    }
    EXPECT_FALSE(differenceOf(scale, 2, 2));
}

TEST(ScalesOfPairs, SayWhoWasNeverCompared) {
    const test::Folder folder;
    const Findings findings =
        study(folder.path(),
              {{"a", "b", "1101100101"}, {"b", "c", "1101111101"}, {"x", "y", "1010101010"}});
    const ScaleResult& scale = resultOf(findings.scales, "thurstone");
    EXPECT_EQ(scale.items.size(), 3u);
    EXPECT_THAT(scale.notes, Contains(HasSubstr("{a, b, c} and {x, y} were never compared")));
}

TEST(ScalesOfPairs, SayItAlsoWhereNoScaleIsLeft) {
    const test::Folder folder;
    const Findings findings =
        study(folder.path(), {{"a", "b", "1101100101"}, {"x", "y", "1010101010"}});
    const ScaleResult& scale = resultOf(findings.scales, "thurstone");
    EXPECT_TRUE(scale.items.empty());
    EXPECT_THAT(scaleSentences(findings.scales),
                Contains(HasSubstr("no scale, for {a, b} and {x, y} were never compared")));
}

TEST(ScalesOfPairs, StayFiniteWhereAllAgreeAndSayThatAPriorDoesIt) {
    const test::Folder folder;
    const Findings findings =
        study(folder.path(),
              {{"a", "b", "1101100101"}, {"a", "c", "1111111111"}, {"b", "c", "1111111111"}});
    const ScaleResult& scale = resultOf(findings.scales, "thurstone");
    ASSERT_EQ(scale.items.size(), 3u);
    EXPECT_THAT(scale.notes, Contains(AllOf(HasSubstr("{c} over {a, b} in every comparison"),
                                            HasSubstr("pwcmp's Gaussian prior"))));
    EXPECT_EQ(*diagnosticOf(scale, "of them unanimous").value, 2);
    EXPECT_GT(scale.items[2].value, scale.items[1].value + 1);
    EXPECT_LT(scale.items[2].value, 10);
    EXPECT_THAT(resultOf(findings.scales, "bradley-terry").notes,
                Contains(HasSubstr("normal prior of standard deviation 3 logits")));
}

TEST(ScalesOfPairs, OfOnePersonHaveTheLikelihoodsIntervals) {
    const test::Folder folder;
    const Findings findings =
        study(folder.path(), {{"a", "b", "1"}, {"b", "c", "1"}, {"a", "c", "0"}});
    const ScaleResult& scale = resultOf(findings.scales, "thurstone");
    EXPECT_THAT(scale.intervals, HasSubstr("1 people are too few to resample"));
    EXPECT_NEAR(scale.items[2].value, 0, 1e-6); // a circle
}

TEST(ScalesOfPairs, AreReadByProgramsWithEveryDigit) {
    const test::Folder folder;
    const Findings findings = findingsOf("counts", study(folder.path(), tournament).tallies);
    const std::string csv = scalesCsv(findings.scales, "published counts");
    EXPECT_THAT(csv, HasSubstr("published counts,none,thurstone,,atrium,moderate,item,None,,0,,,,"
                               "JOD,"));
    EXPECT_THAT(csv, HasSubstr("item,Crytek24,,0.29298416"));
    EXPECT_THAT(csv, HasSubstr("step,Blizzard24,Crytek24,0.61298817"));
}

// The mean occlusion of b less that of a is what choices are held against.
TEST(ScalesOfPairs, HoldChoicesAgainstTheStimuli) {
    std::vector<Tally> tallies;
    Manifest stimuli;
    const double difference[] = {-0.2, -0.1, 0, 0.1, 0.2};
    const int chosen[] = {10, 25, 50, 75, 90}; // a curve through one half at 0
    for (int i = 0; i < 5; ++i) {
        Tally tally;
        tally.condition = fmt::format("c{}", i);
        tally.level = "sky";
        tally.scene = "atrium";
        tally.techniqueA = "none";
        tally.techniqueB = fmt::format("t{}", i);
        tally.votes = {100 - chosen[i], chosen[i]};
        tallies.push_back(tally);
        ConditionRecord record;
        record.condition = tally.condition;
        record.image("a").meanOcclusion = 0.5;
        record.image("b").meanOcclusion = 0.5 + difference[i];
        stimuli.conditions.push_back(record);
    }
    const ScaleFindings scales = scaleFindings(tallies, nullptr, &stimuli);
    const ScaleResult& curve = resultOf(scales, "psychometric", "sky");
    ASSERT_TRUE(curve.curve) << curve.notes.front();
    EXPECT_EQ(curve.unit, "difference in mean occlusion");
    EXPECT_NEAR(curve.items[0].value, 0, 1e-3);
    EXPECT_LT(*curve.items[0].interval.low, -0.01);
    EXPECT_GT(*curve.items[0].interval.high, 0.01);
    // Where they tell how far each image is from the reference, that counts instead.
    for (int i = 0; i < 5; ++i) {
        ConditionRecord& record = stimuli.conditions[static_cast<std::size_t>(i)];
        record.image("a").quality = ImageQuality{0.2, 8, {}};
        record.image("b").quality = ImageQuality{0.2 - difference[i], 8 + 10 * difference[i], {}};
    }
    std::vector<std::string> axes;
    std::vector<double> thresholds;
    for (const Scaled& one : scaleFindings(tallies, nullptr, &stimuli).all)
        if (one.result.curve) {
            axes.push_back(one.result.unit);
            thresholds.push_back(one.result.items[0].value);
        }
    EXPECT_THAT(axes, testing::ElementsAre("difference in predicted JOD",
                                           "difference in RMSE from the reference"));
    EXPECT_THAT(thresholds, testing::Each(testing::DoubleNear(0, 1e-3)));
    stimuli.conditions[2].image("b").derived = Derivation(); // boosted: no longer so far
    EXPECT_EQ(stimulusMeasures(&stimuli).size(), 1u);
    EXPECT_TRUE(scaleFindings(tallies, nullptr, nullptr).all.empty() ||
                !scaleFindings(tallies, nullptr, nullptr).all.back().result.curve);
}

} // namespace
} // namespace obscura
