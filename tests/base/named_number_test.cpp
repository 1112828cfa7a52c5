#include "base/named_number.h"

#include <gtest/gtest.h>

namespace obscura {
namespace {

TEST(NamedNumberTest, IsANameAndAWholeNumberAfterIt) {
    const auto read = readNamedNumber("angleBias=-1.5e-1");
    ASSERT_TRUE(read);
    EXPECT_EQ(read->name, "angleBias");
    EXPECT_EQ(read->value, -0.15);
}

TEST(NamedNumberTest, IsNothingElse) {
    for (const char* text :
         {"", "blur", "=", "=1", "blur=", "blur=yes", "blur=10abc", "blur=1=2", "blur= 1",
          "blur=1 ", "blur=0,5", "blur=nan", "blur=inf", "blur=-inf", "blur=1e999", "blur=0x10"})
        EXPECT_FALSE(readNamedNumber(text)) << text;
}

} // namespace
} // namespace obscura
