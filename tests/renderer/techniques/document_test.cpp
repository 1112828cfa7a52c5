#include "base/files.h"
#include "renderer/techniques/document.h"

#include <gtest/gtest.h>

namespace obscura {
namespace {

TEST(Document, IsWhatTheTableSays) {
    EXPECT_TRUE(readFile(OBSCURA_SOURCE "/docs/techniques.md") == techniquesDocument())
        << "docs/techniques.md is stale; renew it: build/bin/obscura-render --document > "
           "docs/techniques.md";
}

TEST(Document, HasEveryRowAndParameter) {
    const std::string text = techniquesDocument();
    for (const Technique& row : techniques()) {
        const std::size_t begin = text.find(std::string("### `") + std::string(row.id) + "`");
        ASSERT_NE(begin, std::string::npos) << row.id;
        const std::string section = text.substr(begin, text.find("\n### ", begin) - begin);
        EXPECT_NE(section.find(row.citation), std::string::npos) << row.id;
        for (const Parameter& parameter : row.parameters) {
            EXPECT_NE(section.find("| `" + std::string(parameter.name) + "` |"), std::string::npos);
            EXPECT_NE(section.find(parameter.meaning), std::string::npos);
            EXPECT_NE(section.find(parameter.source), std::string::npos);
        }
    }
}

// A bar would end a cell.
TEST(Document, NoCellBreaksItsTable) {
    for (const Technique& row : techniques())
        for (const Parameter& parameter : row.parameters)
            for (const std::string_view cell : {parameter.meaning, parameter.source})
                EXPECT_EQ(cell.find_first_of("|\n"), std::string_view::npos)
                    << row.id << " " << parameter.name;
}

} // namespace
} // namespace obscura
