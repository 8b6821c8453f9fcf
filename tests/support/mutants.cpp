#include "tests/support/mutants.hpp"

namespace skinfit::test {

std::string mutated(std::string text, std::string_view marks, std::mt19937_64& random) {
    if (text.empty()) return text;
    const std::size_t at = random() % text.size();
    switch (random() % 4) {
        case 0:
            text.erase(at, 1);
            break;
        case 1:
            text.insert(at, text.substr(at, 1 + random() % 30));
            break;
        case 2:
            text[at] = static_cast<char>(random() % 256);
            break;
        default:
            text[at] = marks[random() % marks.size()];
    }
    return text;
}

}  // namespace skinfit::test
