#include "analysis/results.h"
#include "analysis/statistics.h"
#include "base/csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>

namespace obscura {
namespace {

using testing::HasSubstr;

Findings thesis() {
    Claim claim;
    claim.name = "Accuracy matters, \"much\"";
    claim.conditions = {"3"};
    std::vector<Tally> counts = readCounts(OBSCURA_SOURCE "/analysis/thesis_table4.csv");
    claim.conditions = {counts[2].condition};
    return findingsOf("The thesis", std::move(counts), {claim});
}

// Each number of the tidy file, by what it is of.
std::map<std::string, double> tidy(const Findings& findings) {
    std::map<std::string, double> values;
    const auto records = splitCsv(resultsCsv(findings));
    for (std::size_t i = 1; i < records.size(); ++i) {
        const auto& cells = records[i].cells;
        EXPECT_EQ(cells.size(), 4u);
        const bool isNew =
            values.emplace(cells[0] + "/" + cells[1] + "/" + cells[2], std::stod(cells[3])).second;
        EXPECT_TRUE(isNew) << cells[1] << " " << cells[2];
    }
    return values;
}

TEST(Results, AreTheSameInBothFiles) {
    const Findings findings = thesis();
    const auto values = tidy(findings);
    const auto json = nlohmann::json::parse(resultsJson(findings, nlohmann::ordered_json()));
    std::size_t numbers = 0;
    const auto compare = [&](const std::string& of, const std::string& subject,
                             const nlohmann::json& statistics) {
        for (const auto& [name, value] : statistics.items()) {
            EXPECT_EQ(values.at(of + "/" + subject + "/" + name), value.get<double>());
            ++numbers;
        }
    };
    for (const auto& claim : json["claims"])
        compare("claim", claim["name"], claim["statistics"]);
    for (const auto& condition : json["conditions"])
        compare("condition", condition["condition"], condition["statistics"]);
    for (const auto& test : json["tests"])
        compare("test", test["test"].get<std::string>() + ": " + test["about"].get<std::string>(),
                test["statistics"]);
    for (const auto& scale : json["scales"])
        for (const auto& item : scale["items"])
            compare("scale",
                    scale["subject"].get<std::string>() + ": " + item["name"].get<std::string>(),
                    item["statistics"]);
    EXPECT_EQ(numbers, values.size());
    EXPECT_EQ(json["claims"][0]["outcome"], "supported");
    EXPECT_EQ(json["conditions"][2]["family"], "Accuracy matters, \"much\"");
}

// psychophysics.md 5.1, condition 3: by the keys of R's golden values.
TEST(Results, HaveTheKeysOfTheGoldenValues) {
    const Findings findings = thesis();
    const auto values = tidy(findings);
    const std::string condition = "condition/" + findings.tallies[2].condition + "/";
    EXPECT_NEAR(values.at(condition + "chisq"), 5.44444444444, 1e-9);
    EXPECT_NEAR(values.at(condition + "exact_p"), 0.0288167196559, 1e-10);
    EXPECT_NEAR(values.at(condition + "jod"), 0.754, 5e-4);
    for (const CountStatistic& statistic : countStatistics())
        EXPECT_TRUE(values.contains(
            condition + std::string(statistic.golden.empty() ? statistic.id : statistic.golden)))
            << statistic.id;
}

TEST(Results, NameTheExcludedAndStayShort) {
    Findings findings = thesis();
    for (int i = 0; i < 1000; ++i)
        findings.exclusions.push_back({fmt::format("P{}", i), "1", "late, and \"tired\"", 7});
    EXPECT_EQ(splitCsv(exclusionsCsv(findings)).size(), 1001u);
    const Table table = exclusionTable(findings.exclusions);
    EXPECT_EQ(table.rows.size(), 21u);
    EXPECT_THAT(table.rows.back()[1], HasSubstr("980 more"));
    EXPECT_EQ(table.rows.back()[2], "7000");
    EXPECT_EQ(claimTable(findings.claims).rows[0][1], "supported");
}

} // namespace
} // namespace obscura
