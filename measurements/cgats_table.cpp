#include "measurements/cgats_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/cells.hpp"
#include "measurements/columns.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// Where the words of a line go.
enum class Section { keywords, fields, data };

/// Takes the tables of a file apart, line by line.
class TableReader {
public:
    explicit TableReader(std::vector<CgatsTable>& tables) : tables_(tables) {}

    void take(const Row& row) {
        const std::span<const std::string_view> words = blanks_.cut(row.text);
        const std::string_view first = words.front();
        if (first == "BEGIN_DATA_FORMAT") {
            section_ = Section::fields;
            if (!tables_.back().fields.empty()) tables_.emplace_back();
        } else if (first == "BEGIN_DATA") {
            section_ = Section::data;
        } else if (first == "END_DATA_FORMAT") {
            section_ = Section::keywords;
        } else if (first == "END_DATA") {
            section_ = Section::keywords;
            tables_.emplace_back();
        } else if (section_ == Section::fields) {
            take_fields(row);
        } else if (section_ == Section::data) {
            take_data(row);
        } else if (words.size() > 1) {
            take_keyword(row, words);
        }
    }
    [[nodiscard]] bool is_inside() const { return section_ != Section::keywords; }

private:
    void take_keyword(const Row& row, std::span<const std::string_view> words) {
        CgatsKeyword keyword{.line = row.line, .value = unescaped(words[1])};
        for (const std::string_view word : words.subspan(2)) keyword.value += " " + unescaped(word);
        tables_.back().keywords.insert_or_assign(std::string(words.front()), std::move(keyword));
    }

    void take_fields(const Row& row) {
        CgatsTable& table = tables_.back();
        const std::optional<double> promised = table.number("NUMBER_OF_FIELDS");
        const std::span<const std::string_view> at_tabs = between_tabs(row.text);
        const bool by_tabs = promised && static_cast<double>(at_tabs.size()) == *promised;
        for (const std::string_view word : by_tabs ? at_tabs : blanks_.cut(row.text)) {
            table.fields.push_back({.line = row.line, .text = word});
        }
    }

    void take_data(const Row& row) {
        CgatsTable& table = tables_.back();
        std::span<const std::string_view> words = between_tabs(row.text);
        const bool by_tabs = row.text.find('\t') != std::string_view::npos && words.size() == table.fields.size();
        if (!by_tabs) words = blanks_.cut(row.text);
        for (const std::string_view word : words) table.cells.push_back({.line = row.line, .text = word});
        if (words.size() == table.fields.size() || table.uneven) return;
        table.uneven = CgatsToken{.line = row.line, .text = row.text};
        table.words_of_uneven = words.size();
    }

    /// Without what a tab at the end of the line makes.
    std::span<const std::string_view> between_tabs(std::string_view line) {
        std::span<const std::string_view> cells = tabs_.cut(line);
        const std::size_t fields = tables_.back().fields.size();
        while (cells.size() > std::max<std::size_t>(fields, 1) && cells.back().empty()) {
            cells = cells.first(cells.size() - 1);
        }
        return cells;
    }

    std::vector<CgatsTable>& tables_;
    Section section_ = Section::keywords;
    CellCutter blanks_{' '};
    CellCutter tabs_{'\t'};
};

std::string bare(std::string_view name) {
    std::string text = lower_case(name);
    std::erase_if(text, [](char c) { return c == '_' || c == ' '; });
    return text;
}

}  // namespace

std::string_view CgatsTable::keyword(std::string_view name) const {
    const auto found = keywords.find(name);
    return found == keywords.end() ? std::string_view{} : std::string_view(found->second.value);
}

std::optional<double> CgatsTable::number(std::string_view name) const {
    return parse_number(keyword(name));
}

std::optional<std::size_t> CgatsTable::field_called(std::string_view name) const {
    const std::string wanted = bare(name);
    const auto found =
        std::ranges::find_if(fields, [&wanted](const CgatsToken& field) { return bare(field.text) == wanted; });
    if (found == fields.end()) return std::nullopt;
    return static_cast<std::size_t>(found - fields.begin());
}

std::vector<CgatsTable> cgats_tables(std::string_view text, const std::string& source) {
    std::vector<CgatsTable> tables(1);
    TableReader reader(tables);
    for (const Row& row : split_comments(text, source).rows) reader.take(row);
    if (reader.is_inside()) refuse_cgats(source, 0, "ends inside its data", "END_DATA is missing");
    return tables;
}

void refuse_cgats(const std::string& source, std::size_t line, const std::string& problem, const std::string& why,
                  const std::string& remedy) {
    throw InputError({.where = line > 0 ? fmt::format("{}:{}", source, line) : source,
                      .problem = problem,
                      .why = why,
                      .remedy = remedy});
}

}  // namespace skinfit
