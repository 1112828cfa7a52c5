#pragma once

#include "base/error.h"

#include <gtest/gtest.h>

#include <string>

namespace obscura::test {

// What `run` throws.
template <typename Run>
std::string errorOf(Run run) {
    try {
        run();
    } catch (const Error& error) {
        return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

} // namespace obscura::test
