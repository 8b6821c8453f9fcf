#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// JCAMP-DX files before their numbers are decoded: labelled records in blocks. All throw InputError.
namespace skinfit {

/// A line of a record, without its comment.
struct JcampTextLine {
    std::size_t number;  ///< counted from 1
    std::string_view text;
};

/// `##LABEL= value`, the value running on to the next label.
struct JcampRecord {
    std::vector<JcampTextLine> lines;  ///< at least one: what stands behind the label
    [[nodiscard]] std::string_view value() const { return lines.front().text; }
    [[nodiscard]] std::size_t line() const { return lines.front().number; }
};

/// What stands between ##TITLE and ##END, without the blocks inside it.
class JcampBlock {
public:
    explicit JcampBlock(std::string source) : source_(std::move(source)) {}

    /// The record with this label, written as `normalised_label` gives it; null where there is none.
    [[nodiscard]] const JcampRecord* record(std::string_view label) const;
    /// Its value; empty where there is none.
    [[nodiscard]] std::string text(std::string_view label) const;
    /// True where a record of numbers, such as ##FIRSTX=, is written with a decimal comma.
    [[nodiscard]] bool has_decimal_commas() const;
    /// Its value as a finite number, perhaps with a decimal comma; `otherwise`, where given, if there is none.
    [[nodiscard]] double number(std::string_view label, std::optional<double> otherwise = {}) const;
    /// The line of the record, or of ##TITLE where there is none.
    [[nodiscard]] std::size_t line_of(std::string_view label) const;
    [[nodiscard]] const std::map<std::string, JcampRecord, std::less<>>& records() const { return records_; }
    [[nodiscard]] const std::string& source() const { return source_; }
    [[nodiscard]] JcampRecord& add(const std::string& label) { return records_[label]; }

private:
    std::string source_;
    std::map<std::string, JcampRecord, std::less<>> records_;
};

/// Labels are alike in upper and lower case and with or without blanks, dashes, slashes and underscores.
[[nodiscard]] std::string normalised_label(std::string_view label);

/// `line` without what stands after `$$`, trimmed.
[[nodiscard]] std::string_view without_jcamp_comment(std::string_view line);

/// The line with each comma between two digits as a point: the decimal comma of those who write it. Beside it a comma
/// with a blank, a semicolon or a blank separates numbers.
[[nodiscard]] std::string with_decimal_points(std::string_view line);

/// The blocks in the order in which they begin; a LINK block and those inside it are all among them.
[[nodiscard]] std::vector<JcampBlock> jcamp_blocks(std::string_view text, const std::string& source);

/// Throws InputError at that line.
[[noreturn]] void refuse_jcamp(const std::string& source, std::size_t line, const std::string& problem,
                               const std::string& why, const std::string& remedy);

}  // namespace skinfit
