#pragma once

#include "gl/context.h"

#include <gtest/gtest.h>

#include <memory>

namespace obscura {

// One headless context for all tests of a program; a test that asks for nothing special shares it.
class GlTest : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        if (!context)
            context = std::make_unique<gl::Context>();
    }
    void TearDown() override { EXPECT_NO_THROW(gl::throwMessages()); }

    inline static std::unique_ptr<gl::Context> context;
};

} // namespace obscura
