#pragma once

#include "base/csv.h"
#include "base/files.h"
#include "protocols/reader/study_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace obscura::test {

// Every protocol that is a study of people: those of techniques have no conditions.
inline std::vector<std::filesystem::path> shippedStudies() {
    std::vector<std::filesystem::path> studies;
    for (const std::filesystem::directory_entry& entry :
         std::filesystem::directory_iterator(OBSCURA_SOURCE "/protocols")) {
        const std::filesystem::path& path = entry.path();
        if (path.extension() == ".toml" &&
            parseToml(readFile(path), path.string()).contains("conditions"))
            studies.push_back(path);
    }
    std::sort(studies.begin(), studies.end());
    return studies;
}

// The same study in less time: fixed times and least views are cut short, and nothing is repeated.
inline std::string hastened(std::string protocol) {
    for (const auto& [key, value] : {std::pair("seconds = ", "0.3"), std::pair("mask = ", "0.3"),
                                     std::pair("atLeast = ", "0"), std::pair("minimumView = ", "0"),
                                     std::pair("repeats = ", "1"), std::pair("reversals = ", "3")})
        protocol = std::regex_replace(protocol, std::regex(std::string("\\b") + key + "[0-9.]+"),
                                      std::string(key) + value);
    return std::regex_replace(protocol, std::regex("breakEvery = [0-9]+"), "breakEvery = 5");
}

// A line of a long table, by column.
using Row = std::map<std::string, std::string>;

inline std::vector<Row> rowsOf(const std::filesystem::path& path) {
    const std::string text = readFile(path);
    const std::vector<CsvRecord> records = splitCsv(text);
    std::vector<Row> rows;
    for (std::size_t i = 1; i < records.size(); ++i) {
        const CsvRecord &record = records[i], &header = records.front();
        EXPECT_EQ(faultOf(record, header.cells.size()), "") << path << ", line " << record.line;
        Row row;
        for (std::size_t cell = 0; cell < record.cells.size(); ++cell)
            row[header.cells.at(cell)] = record.cells[cell];
        rows.push_back(std::move(row));
    }
    return rows;
}

inline std::string caseName(const testing::TestParamInfo<std::filesystem::path>& protocol) {
    std::string name = protocol.param.stem().string();
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

} // namespace obscura::test
