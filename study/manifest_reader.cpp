#include "study/manifest_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "core/utf8.hpp"
#include "measurements/cells.hpp"

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

void check_header(const Words& names, const std::string& where) {
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i].empty()) refuse_manifest(where, fmt::format("column {} has no name", i + 1), "it says nothing");
        if (std::ranges::count(names, names[i]) > 1) {
            refuse_manifest(where, fmt::format("names \"{}\" twice", names[i]), "only one could be meant");
        }
    }
    if (std::ranges::find(names, "file") == names.end()) {
        refuse_manifest(where, "has no column \"file\"", "nothing says where the spectra are");
    }
}

ManifestRow row_of(const Words& names, const Words& cells, const std::string& where) {
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
        } else {
            row.selected.metadata.emplace_back(names[i], cells[i]);
        }
    }
    if (row.file.empty()) refuse_manifest(where, "names no file", "nothing can be read");
    return row;
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
        if (names.empty()) {
            cutter = CellCutter(separator_of(line));
            names = words_in(cutter, line);
            check_header(names, where);
        } else {
            rows.push_back(row_of(names, words_in(cutter, line), where));
        }
    }
    if (rows.empty()) refuse_manifest(source, "lists no spectrum", "it has no line below the header");
    return rows;
}

}  // namespace skinfit
