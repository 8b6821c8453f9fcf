#include "study/manifest_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "core/utf8.hpp"
#include "measurements/cells.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

using Words = std::vector<std::string>;

[[noreturn]] void refuse_manifest(const std::string& where, const std::string& problem, const std::string& why) {
    throw InputError({.where = where,
                      .problem = problem,
                      .why = why,
                      .remedy = R"(a manifest has a header with a column "file", perhaps "spectrum", and metadata)"});
}

char separator_of(std::string_view header) {
    constexpr std::array marks = {',', ';', '\t'};
    return *std::ranges::max_element(marks, {}, [header](char c) { return CellCutter(c).cut(header).size(); });
}

Words words_in(CellCutter& cutter, std::string_view line) {
    Words words;
    for (const std::string_view cell : cutter.cut(line)) words.push_back(unescaped(cell));
    return words;
}

/// What a name means in any case: `File` is `file`.
std::string column_name(const std::string& name) {
    const std::string plain = lower_case(name);
    return plain == "file" || plain == "spectrum" ? plain : name;
}

/// Columns that say how a spectrum is to be read would have no effect. Throws InputError where one is there.
void refuse_settings(const Words& names, const std::string& where) {
    struct Setting {
        std::string_view name;
        std::string_view place;
    };
    static constexpr std::string_view in_files = "state it in the files themselves or in the configuration";
    static constexpr std::string_view in_input = R"(state it beside "manifest" in the study, an input for each)";
    static constexpr std::array<Setting, 10> settings = {{{"unit", in_input},
                                                          {"reader", in_input},
                                                          {"quantity", in_files},
                                                          {"specular", in_files},
                                                          {"incidence_deg", in_files},
                                                          {"viewing_cone_deg", in_files},
                                                          {"sigma", in_files},
                                                          {"noise", in_files},
                                                          {"exclude_nm", in_files},
                                                          {"scale", in_files}}};
    for (const std::string& name : names) {
        const auto* const setting = std::ranges::find(settings, std::string_view(name), &Setting::name);
        if (setting == settings.end()) continue;
        throw InputError({.where = where,
                          .problem = fmt::format("has a column \"{}\"", name),
                          .why = "a manifest holds metadata, and how spectra are read would not change",
                          .remedy = fmt::format("{}; rename the column if it is metadata", setting->place)});
    }
}

/// Tables of R number their rows in front, without a name for that: 1, 2, 3, ...
bool is_row_number(const std::string& cell, std::size_t rows_before) {
    return cell == std::to_string(rows_before + 1) || cell == std::to_string(rows_before);
}

void check_header(const Words& names, const std::string& where) {
    for (std::size_t i = 0; i < names.size(); ++i) {
        const bool in_front = i == 0 && names.size() > 1;  // numbers of rows, as pandas writes them
        if (names[i].empty() && !in_front)
            refuse_manifest(where, fmt::format("column {} has no name", i + 1), "it says nothing");
        if (std::ranges::count(names, names[i]) > 1) {
            refuse_manifest(where, fmt::format("names \"{}\" twice", names[i]), "only one could be meant");
        }
    }
    if (std::ranges::find(names, "file") == names.end()) {
        refuse_manifest(where, "has no column \"file\"", "nothing says where the spectra are");
    }
}

ManifestRow row_of(const Words& names, Words cells, std::size_t rows_before, const std::string& where) {
    const bool is_numbered = cells.size() == names.size() + 1 && is_row_number(cells.front(), rows_before);
    if (is_numbered) cells.erase(cells.begin());
    if (cells.size() != names.size()) {
        refuse_manifest(where, fmt::format("has {} {}", cells.size(), cells.size() == 1 ? "cell" : "cells"),
                        fmt::format("the header names {} columns", names.size()));
    }
    ManifestRow row{.file = {}, .selected = {.spectrum = {}, .metadata = {}, .where = where}};
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i] == "file") {
            row.file = cells[i];
        } else if (names[i] == "spectrum") {
            row.selected.spectrum = cells[i];
        } else if (!names[i].empty()) {
            row.selected.metadata.emplace_back(names[i], cells[i]);
        }
    }
    if (row.file.empty()) refuse_manifest(where, "names no file", "nothing can be read");
    return row;
}

/// The names of the columns; that of row numbers in front is empty.
Words header_of(CellCutter& cutter, std::string_view line, const std::string& where) {
    Words names = words_in(cutter, line);
    if (names.front() == "Unnamed: 0") names.front().clear();
    std::ranges::transform(names, names.begin(), column_name);
    check_header(names, where);
    refuse_settings(names, where);
    return names;
}

}  // namespace

std::vector<ManifestRow> parse_manifest(std::string_view text, const std::string& source) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    refuse_binary(text, source);
    std::vector<ManifestRow> rows;
    Words names;
    CellCutter cutter(',');
    std::size_t number = 0;
    for (const std::string_view line : split_lines(text)) {
        ++number;
        if (trimmed(line).empty() || trimmed(line).starts_with('#')) continue;
        const std::string where = fmt::format("{}:{}", source, number);
        if (!is_utf8(line)) {
            throw InputError({.where = where,
                              .problem = "is not UTF-8",
                              .why = "words of other encodings cannot be told apart",
                              .remedy = "export the table as CSV in UTF-8"});
        }
        if (names.empty() && lower_case(line).starts_with("sep=")) continue;  // a hint for spreadsheets
        if (names.empty()) {
            cutter = CellCutter(separator_of(line));
            names = header_of(cutter, line, where);
        } else {
            rows.push_back(row_of(names, words_in(cutter, line), rows.size(), where));
        }
    }
    if (rows.empty()) refuse_manifest(source, "lists no spectrum", "it has no line below the header");
    return rows;
}

}  // namespace skinfit
