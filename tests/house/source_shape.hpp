#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace skinfit::house {

/// A function in a source file that clang-format has laid out.
struct FunctionLength {
    std::string first_line;
    int lines;  ///< from there to the one that closes the body
};

/// The functions of namespaces, and the member functions of classes of namespaces.
[[nodiscard]] std::vector<FunctionLength> functions_in(std::string_view source);

/// The first lines of declarations of a header that no `///` explains: what a namespace declares, and the public member
/// functions of its classes but for constructors, operators and what is defaulted. A comment explains the declarations
/// below it up to the next empty line; one above the namespace explains them all.
[[nodiscard]] std::vector<std::string> undocumented_in(std::string_view header);

/// The names of the types that the namespaces of a header define, aliases too; not those that it only declares.
[[nodiscard]] std::vector<std::string> types_in(std::string_view header);

}  // namespace skinfit::house
