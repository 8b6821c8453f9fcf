#include "core/hash.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace skinfit {
namespace {

/// As `xxh128sum` of an empty file prints it.
TEST(Hash, IsThatOfXxHash) {
    EXPECT_EQ(content_hash(""), "99aa06d3014798d86001c324468d497f");
}

TEST(Hash, EveryBitCounts) {
    const std::string text(300, 'a');
    std::set<std::string> hashes = {content_hash(text)};
    for (std::size_t i = 0; i < text.size(); ++i) {
        for (int bit = 0; bit < 8; ++bit) {
            std::string other = text;
            other[i] = static_cast<char>(other[i] ^ (1 << bit));
            const std::string hash = content_hash(other);
            EXPECT_EQ(hash.size(), 32U);
            EXPECT_EQ(hash.find_first_not_of("0123456789abcdef"), std::string::npos);
            EXPECT_TRUE(hashes.insert(hash).second);
        }
    }
    EXPECT_EQ(content_hash(text), content_hash(std::string(300, 'a')));
    EXPECT_NE(content_hash(std::string(1, '\0')), content_hash(""));
}

}  // namespace
}  // namespace skinfit
