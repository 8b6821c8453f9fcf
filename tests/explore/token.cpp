#include "explore/token.hpp"

#include <gtest/gtest.h>

#include <set>

namespace skinfit {
namespace {

TEST(Token, IsOf128BitsAndNeverTheSame) {
    std::set<std::string> tokens;
    for (int i = 0; i < 1000; ++i) {
        const std::string token = random_token();
        EXPECT_EQ(token.size(), 128U / 4U);
        EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos);
        tokens.insert(token);
    }
    EXPECT_EQ(tokens.size(), 1000U);
}

TEST(Token, OnlyTheSecretItselfIsTheSame) {
    const std::string secret = random_token();
    EXPECT_TRUE(same_secret(secret, secret));
    for (std::size_t i = 0; i < secret.size(); ++i) {
        std::string other = secret;
        other[i] = static_cast<char>(other[i] ^ 1);
        EXPECT_FALSE(same_secret(other, secret)) << i;
    }
    EXPECT_FALSE(same_secret("", secret));
    EXPECT_FALSE(same_secret(secret + "0", secret));
    EXPECT_FALSE(same_secret(secret.substr(1), secret));
}

}  // namespace
}  // namespace skinfit
