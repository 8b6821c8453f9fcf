#include "measurements/envi_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/envi_header.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// In small letters, words apart by one blank: some programs write `wavelength_units`.
std::string key_in(std::string_view text) {
    std::string key;
    for (const char c : lower_case(trimmed(text))) {
        const bool blank = c == ' ' || c == '\t' || c == '_';
        if (!blank) {
            key += c;
        } else if (!key.ends_with(' ')) {
            key += ' ';
        }
    }
    return key;
}

/// A value on one line, without a comment behind it.
std::string_view without_comment(std::string_view text) {
    const std::string_view value = trimmed(text);
    if (value.starts_with('{')) return value;
    for (std::size_t at = value.find(';'); at != std::string_view::npos; at = value.find(';', at + 1)) {
        if (at == 0 || value[at - 1] == ' ' || value[at - 1] == '\t') return trimmed(value.substr(0, at));
    }
    return value;
}

/// The first line from `from` on that is neither empty nor a comment.
std::size_t next_with_text(const std::vector<std::string_view>& lines, std::size_t from) {
    while (from < lines.size() && (trimmed(lines[from]).empty() || trimmed(lines[from]).starts_with(';'))) ++from;
    return from;
}

/// The cells of a list: between commas, or between blanks where it has no comma. Lines of comments are left out.
std::vector<std::string> cells_in(std::string_view list) {
    std::string text;
    for (const std::string_view line : split_lines(list)) {
        if (!trimmed(line).starts_with(';')) text += std::string(line) + ' ';
    }
    const bool commas = text.find(',') != std::string::npos;
    if (!commas) std::ranges::replace(text, '\t', ' ');
    std::vector<std::string> cells;
    for (const std::string_view cell : split(text, commas ? ',' : ' ')) {
        if (commas || !cell.empty()) cells.emplace_back(cell);
    }
    if (!cells.empty() && cells.back().empty()) cells.pop_back();
    return cells;
}

/// A cell of numbers with units, without quotes and taken apart; the cell of a plain number has no unit.
struct NumberWithUnit {
    std::optional<double> number;
    std::string unit;
};

NumberWithUnit taken_apart(std::string cell) {
    std::erase_if(cell, [](char c) { return c == '"' || c == '\''; });
    if (const std::optional<double> plain = parse_number(trimmed(cell))) return {.number = plain, .unit = {}};
    const std::string_view text = trimmed(cell);
    const std::size_t size = std::min(text.find_first_not_of("0123456789.+-"), text.size());
    return {.number = parse_number(text.substr(0, size)), .unit = std::string(trimmed(text.substr(size)))};
}

}  // namespace

EnviFields::EnviFields(std::string_view text, const std::string& source) : source_(source) {
    text = without_byte_order_mark(text);
    if (!is_envi_header(text)) {
        throw InputError({.where = source + ":1",
                          .problem = "does not begin with the line ENVI",
                          .why = "every ENVI header does",
                          .remedy = "name an ENVI header or its data file"});
    }
    const std::vector<std::string_view> lines = split_lines(text);
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const std::size_t equals = lines[i].find('=');
        if (equals == std::string_view::npos || trimmed(lines[i]).starts_with(';')) continue;
        const std::size_t key_line = i + 1;
        const std::string key = key_in(lines[i].substr(0, equals));
        std::string_view value = without_comment(lines[i].substr(equals + 1));
        if (value.empty()) {
            const std::size_t brace = next_with_text(lines, i + 1);
            if (brace < lines.size() && trimmed(lines[brace]).starts_with('{')) value = trimmed(lines[i = brace]);
        }
        if (value.starts_with('{')) {
            value.remove_prefix(1);
            std::size_t end = value.find('}');
            while (end == std::string_view::npos && ++i < lines.size()) {
                const auto before = static_cast<std::size_t>(lines[i].data() - value.data());
                value = std::string_view(value.data(), before + lines[i].size());
                end = value.find('}', before);
            }
            if (end == std::string_view::npos) {
                throw InputError({.where = fmt::format("{}:{}", source, key_line),
                                  .problem = fmt::format("{} opens a brace", in_quotes(key)),
                                  .why = "no later line closes it",
                                  .remedy = "check that the header is complete"});
            }
            value = trimmed(value.substr(0, end));
        }
        fields_.emplace(key, EnviField{.line = key_line, .value = value});
    }
}

std::optional<EnviField> EnviFields::find(std::string_view key) const {
    const auto [first, end] = fields_.equal_range(key);
    if (first == end) return std::nullopt;
    const auto second = std::next(first);
    if (second != end) {
        throw InputError({.where = fmt::format("{}:{}", source_, second->second.line),
                          .problem = fmt::format("repeats {}", in_quotes(key)),
                          .why = fmt::format("line {} has it already", first->second.line),
                          .remedy = "keep the one that is right"});
    }
    return first->second;
}

EnviField EnviFields::get(const std::string& key) const {
    const std::optional<EnviField> field = find(key);
    if (field) return *field;
    throw InputError({.where = source_,
                      .problem = fmt::format("has no {}", in_quotes(key)),
                      .why = "without it the data cannot be read",
                      .remedy = fmt::format("add a line \"{} = ...\"", key)});
}

std::uint64_t EnviFields::count(const std::string& key, std::uint64_t lowest, std::uint64_t highest) const {
    const EnviField field = get(key);
    const bool digits = field.value.find_first_not_of("0123456789") == std::string_view::npos;
    const std::optional<std::uint64_t> value = digits ? parse_count(field.value) : std::nullopt;
    if (!value || *value < lowest || *value > highest) {
        refuse(key, field, fmt::format("it must be a whole number from {} to {}", lowest, highest));
    }
    return *value;
}

std::optional<double> EnviFields::number(const std::string& key) const {
    const std::optional<EnviField> field = find(key);
    if (!field) return std::nullopt;
    const std::optional<double> value = parse_number(field->value);
    if (!value) refuse(key, *field, "it must be a number");
    return value;
}

std::vector<double> EnviFields::numbers(const std::string& key, std::size_t size, std::string* unit) const {
    const std::optional<EnviField> field = find(key);
    if (!field) return {};
    const std::vector<std::string> cells = cells_in(field->value);
    const std::string where = fmt::format("{}:{}", source_, field->line);
    if (cells.size() != size) {
        throw InputError(
            {.where = where,
             .problem = fmt::format("{} has {} number{}", in_quotes(key), cells.size(), cells.size() == 1 ? "" : "s"),
             .why = fmt::format("the cube has {} band{}", size, size == 1 ? "" : "s"),
             .remedy = "give one number per band"});
    }
    std::vector<double> values;
    for (const std::string& cell : cells) {
        const NumberWithUnit found = unit != nullptr ? taken_apart(cell) : NumberWithUnit{parse_number(cell), {}};
        const std::optional<double>& value = found.number;
        if (unit != nullptr && values.empty()) *unit = found.unit;
        if (!value || !std::isfinite(*value) || (unit != nullptr && found.unit != *unit)) {
            throw InputError(
                {.where = where,
                 .problem = fmt::format("number {} of {} is {}", values.size() + 1, in_quotes(key), in_quotes(cell)),
                 .why = "a number is needed for every band",
                 .remedy = "correct it"});
        }
        values.push_back(*value);
    }
    return values;
}

void EnviFields::refuse(const std::string& key, const EnviField& field, const std::string& why) const {
    throw InputError({.where = fmt::format("{}:{}", source_, field.line),
                      .problem = fmt::format("{} is {}", in_quotes(key), in_quotes(field.value)),
                      .why = why,
                      .remedy = "correct the header, or export the data in another way"});
}

}  // namespace skinfit
