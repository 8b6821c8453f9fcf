#include "core/memory.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/input_error.hpp"

namespace skinfit {
namespace {

TEST(Memory, WhatIsMoreThanAvailableIsRefused) {
    EXPECT_GT(available_memory_bytes(), 0.0);
    EXPECT_NO_THROW(refuse_beyond_memory(0.0, "here", "ask for less"));
    try {
        refuse_beyond_memory(1e18, "here", "ask for less");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with("here: needs 1e+09 GB of memory (")) << error.what();
    }
}

}  // namespace
}  // namespace skinfit
