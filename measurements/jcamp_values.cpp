#include "measurements/jcamp_values.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

[[noreturn]] void refuse(const std::string& where, std::string_view text, const std::string& why) {
    throw InputError({.where = where,
                      .problem = fmt::format("holds {} among its numbers", in_quotes(text)),
                      .why = why,
                      .remedy = "check that the file is complete and unchanged"});
}

bool is_separator(char c) {
    return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\v' || c == '\f';
}
/// What a character that starts a number says.
enum class Form { plain, squeezed, difference, duplicate };
struct Lead {
    Form form;
    int digit = 0;  ///< with its sign
};

std::optional<Lead> lead_of(char c) {
    if (is_digit(c) || c == '.' || c == '+' || c == '-' || c == '?') {
        return Lead{.form = Form::plain};
    }
    if (c == '@') return Lead{.form = Form::squeezed, .digit = 0};
    if (c >= 'A' && c <= 'I') return Lead{.form = Form::squeezed, .digit = c - 'A' + 1};
    if (c >= 'a' && c <= 'i') return Lead{.form = Form::squeezed, .digit = -(c - 'a' + 1)};
    if (c == '%') return Lead{.form = Form::difference, .digit = 0};
    if (c >= 'J' && c <= 'R') return Lead{.form = Form::difference, .digit = c - 'J' + 1};
    if (c >= 'j' && c <= 'r') return Lead{.form = Form::difference, .digit = -(c - 'j' + 1)};
    if (c >= 'S' && c <= 'Z') return Lead{.form = Form::duplicate, .digit = c - 'S' + 1};
    if (c == 's') return Lead{.form = Form::duplicate, .digit = 9};
    return std::nullopt;
}

/// Takes numbers off the front of a line.
class Scanner {
public:
    Scanner(std::string_view line, const std::string& where) : rest_(line), where_(where) { skip_separators(); }

    [[nodiscard]] bool at_end() const { return rest_.empty(); }
    [[nodiscard]] std::string_view rest() const { return rest_; }
    [[nodiscard]] char front() const { return rest_.front(); }

    /// A number in ordinary digits; NaN for `?`, a missing one. E is an exponent before a sign only: else it is a
    /// digit.
    [[nodiscard]] double plain() {
        if (rest_.front() == '?') {
            advance_to(rest_.data() + 1);
            return std::numeric_limits<double>::quiet_NaN();
        }
        std::size_t size = rest_.front() == '+' || rest_.front() == '-' ? 1 : 0;
        while (size < rest_.size() && (is_digit(rest_[size]) || rest_[size] == '.')) ++size;
        if (size + 2 < rest_.size() && (rest_[size] == 'E' || rest_[size] == 'e') &&
            (rest_[size + 1] == '+' || rest_[size + 1] == '-')) {
            size += 2;
            while (size < rest_.size() && is_digit(rest_[size])) ++size;
        }
        const std::optional<double> number = parse_number(rest_.substr(0, size));
        if (!number || !std::isfinite(*number)) refuse(where_, rest_, "a number is needed");
        advance_to(rest_.data() + size);
        return *number;
    }

    /// A number whose first digit is the character `lead` and whose others are ordinary.
    [[nodiscard]] double after(const Lead& lead) {
        std::string digits = std::to_string(std::abs(lead.digit));
        std::size_t size = 1;
        while (size < rest_.size() && (is_digit(rest_[size]) || rest_[size] == '.')) ++size;
        digits += rest_.substr(1, size - 1);
        const std::optional<double> number = parse_number(digits);
        if (!number || !std::isfinite(*number)) refuse(where_, rest_, "a number is needed");
        advance_to(rest_.data() + size);
        return lead.digit < 0 ? -*number : *number;
    }

private:
    void advance_to(const char* at) {
        rest_.remove_prefix(static_cast<std::size_t>(at - rest_.data()));
        skip_separators();
    }
    void skip_separators() {
        while (!rest_.empty() && is_separator(rest_.front())) rest_.remove_prefix(1);
    }

    std::string_view rest_;
    const std::string& where_;
};

/// The ordinates of one line, as they are found.
class Ordinates {
public:
    Ordinates(JcampLine& line, const std::string& where) : line_(line), where_(where) {}

    void add(double ordinate) {
        line_.ordinates.push_back(ordinate);
        is_difference_ = false;
    }
    void add_difference(double difference, std::string_view text) {
        if (line_.ordinates.empty() || std::isnan(line_.ordinates.back()))
            refuse(where_, text, "a difference needs an ordinate before it on its line");
        line_.ordinates.push_back(line_.ordinates.back() + difference);
        difference_ = difference;
        is_difference_ = true;
    }
    /// What came last stands `times` times in all.
    void duplicate(double times, std::string_view text) {
        constexpr double most = 1e6;
        if (line_.ordinates.empty()) refuse(where_, text, "a count of duplicates needs an ordinate before it");
        if (!(times >= 1 && times + static_cast<double>(line_.ordinates.size()) <= most) ||
            times != std::floor(times)) {
            refuse(where_, text, "duplicates are counted from 1, up to a million ordinates to a line");
        }
        for (int i = 1; i < static_cast<int>(times); ++i)
            line_.ordinates.push_back(line_.ordinates.back() + (is_difference_ ? difference_ : 0));
    }
    [[nodiscard]] bool end_in_difference() const { return is_difference_; }

private:
    JcampLine& line_;
    const std::string& where_;
    double difference_ = 0.0;
    bool is_difference_ = false;  ///< what came last was a difference
};

}  // namespace

JcampLine decode_jcamp_line(std::string_view text, const std::string& where) {
    Scanner scanner(text, where);
    if (scanner.at_end()) return {};
    JcampLine line;
    const std::optional<Lead> first = lead_of(scanner.front());
    if (!first || first->form == Form::difference || first->form == Form::duplicate) {
        refuse(where, scanner.rest(), "a line starts with its abscissa");
    }
    line.abscissa = first->form == Form::plain ? scanner.plain() : scanner.after(*first);
    Ordinates ordinates(line, where);
    while (!scanner.at_end()) {
        const std::string_view rest = scanner.rest();
        const std::optional<Lead> lead = lead_of(rest.front());
        if (!lead) refuse(where, rest, "it has none of the forms AFFN, PAC, SQZ, DIF and DUP");
        switch (lead->form) {
            case Form::plain:
                ordinates.add(scanner.plain());
                break;
            case Form::squeezed:
                ordinates.add(scanner.after(*lead));
                break;
            case Form::difference:
                ordinates.add_difference(scanner.after(*lead), rest);
                break;
            case Form::duplicate:
                ordinates.duplicate(scanner.after(*lead), rest);
                break;
        }
    }
    line.ends_in_difference = ordinates.end_in_difference();
    return line;
}

std::vector<double> decode_affn(std::string_view line, const std::string& where) {
    std::vector<double> numbers;
    Scanner scanner(line, where);
    while (!scanner.at_end()) numbers.push_back(scanner.plain());
    return numbers;
}

}  // namespace skinfit
