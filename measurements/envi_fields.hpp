#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skinfit {

/// What stands behind a key of an ENVI header.
struct EnviField {
    std::size_t line;        ///< of the key, counted from 1
    std::string_view value;  ///< trimmed, without braces; views into the header's text
};

/// The fields of an ENVI header, before their meaning is read.
class EnviFields {
public:
    /// Keys are read in any case, with blanks or underscores between their words. A brace may open on the line below
    /// its key. Lines that begin with a semicolon, and what stands behind one after a blank, are comments. Throws
    /// InputError where the text does not begin with ENVI or a brace is not closed.
    EnviFields(std::string_view text, const std::string& source);

    /// The field called `key`, in lower case. Throws InputError where it is given twice.
    [[nodiscard]] std::optional<EnviField> find(std::string_view key) const;

    /// The same for a key without which the data cannot be read.
    [[nodiscard]] EnviField get(const std::string& key) const;

    /// The field as a whole number from `lowest` to `highest`, written in digits only.
    [[nodiscard]] std::uint64_t count(const std::string& key, std::uint64_t lowest, std::uint64_t highest) const;

    /// The field as a number, not necessarily finite.
    [[nodiscard]] std::optional<double> number(const std::string& key) const;

    /// The field as a list of `size` finite numbers, between commas or, where there are none, blanks; empty where it is
    /// not given. Where `unit` is not null, a word may stand behind each, the same in all as in `"400 nm"`, and is put
    /// there.
    [[nodiscard]] std::vector<double> numbers(const std::string& key, std::size_t size,
                                              std::string* unit = nullptr) const;

    /// All keys with their fields, by the alphabet.
    [[nodiscard]] const std::multimap<std::string, EnviField, std::less<>>& all() const { return fields_; }

    /// Throws the InputError that the field is not what it must be.
    [[noreturn]] void refuse(const std::string& key, const EnviField& field, const std::string& why) const;

private:
    std::string source_;
    std::multimap<std::string, EnviField, std::less<>> fields_;
};

}  // namespace skinfit
