#include "measurements/envi_fields.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/envi_header.hpp"
#include "measurements/words.hpp"

namespace skinfit {

EnviFields::EnviFields(std::string_view text, const std::string& source) : source_(source) {
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
        const std::string key = lower_case(trimmed(lines[i].substr(0, equals)));
        std::string_view value = trimmed(lines[i].substr(equals + 1));
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

std::vector<double> EnviFields::numbers(const std::string& key, std::size_t size) const {
    const std::optional<EnviField> field = find(key);
    if (!field) return {};
    std::vector<std::string_view> cells = split(field->value, ',');
    if (cells.back().empty()) cells.pop_back();
    const std::string where = fmt::format("{}:{}", source_, field->line);
    if (cells.size() != size) {
        throw InputError(
            {.where = where,
             .problem = fmt::format("{} has {} number{}", in_quotes(key), cells.size(), cells.size() == 1 ? "" : "s"),
             .why = fmt::format("the cube has {} band{}", size, size == 1 ? "" : "s"),
             .remedy = "give one number per band"});
    }
    std::vector<double> values;
    for (const std::string_view cell : cells) {
        const std::optional<double> value = parse_number(cell);
        if (!value || !std::isfinite(*value)) {
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
