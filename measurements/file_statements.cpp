#include "measurements/file_statements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "core/text.hpp"
#include "measurements/stated_scale.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// `file:line`; the file alone where the line is 0.
std::string place(const std::string& source, std::size_t line) {
    return line > 0 ? fmt::format("{}:{}", source, line) : source;
}

/// How much what states the values weighs against another line that does.
enum class StatementWeight { none, prose, key, ordinate };

/// The number of `# missing value: -1` and its kin.
std::optional<double> declared_fill(const KeyedLine& keyed) {
    static constexpr std::array<std::string_view, 16> keys = {
        "missingvalue", "missingvaluecode", "missingcode",     "missingdatavalue", "missingdatacode",
        "nodata",       "nodatavalue",      "nodatacode",      "fillvalue",        "fill",
        "navalue",      "nullvalue",        "dataignorevalue", "ignorevalue",      "invalidvalue",
        "badvalue"};
    if (std::ranges::find(keys, bare_key(keyed.key)) == keys.end()) return std::nullopt;
    const std::optional<double> number = parse_number(keyed.value.substr(0, keyed.value.find_first_of(" ,;(")));
    return number && std::isfinite(*number) ? number : std::nullopt;
}

std::size_t words_in(std::string_view text) {
    const std::vector<std::string_view> words = split(text, ' ');
    return static_cast<std::size_t>(std::ranges::count_if(words, [](std::string_view word) { return !word.empty(); }));
}

/// Whether a line is of several cells, each of which may speak of its own column: more than a key and its value.
bool is_of_cells(std::string_view line) {
    if (line.find_first_of(":=") != std::string_view::npos) return false;
    constexpr std::string_view separators = ",;\t";
    const std::size_t last = line.find_last_not_of(",;\t ");
    return std::ranges::count_if(line.substr(0, last == std::string_view::npos ? 0 : last), [&](char c) {
               return contains(separators, {&c, 1});
           }) > 1;
}

/// What the lines of a file state, one after the other.
class StatedLines {
public:
    StatedLines(const std::string& source, bool is_compared) : source_(source), is_compared_(is_compared) {}

    void take(const Comment& line, bool is_comment) {
        const std::optional<KeyedLine> keyed = keyed_line(line.text);
        const Clauses clauses = !is_comment && is_of_cells(line.text) ? Clauses::cells : Clauses::of_prose;
        if (!keyed || is_title(*keyed, line.text)) {
            take_prose(line, clauses);
            take_scale_in_prose(statements_, source_, line.line, line.text, is_comment);
            return;
        }
        static constexpr std::array<std::string_view, 2> known = {"quantity", "unit"};  // of `Description`
        if (is_comment && contains(line.text, ":") && std::ranges::find(known, keyed->key) != known.end()) return;
        take_keyed(*keyed, line.line, clauses);
        take_scale(statements_, source_, line.line, *keyed, is_comment);
        if (const auto fill = declared_fill(*keyed)) statements_.fill.push_back(*fill);
        if (const auto declared = declared_by(line.line, keyed->key, keyed->value)) {
            statements_.declared.push_back(*declared);
        }
        if (const auto scan = scan_declared_by(keyed->key, keyed->value)) statements_.scans.push_back(*scan);
    }

    /// What a key states of the values and the abscissa.
    void take_keyed(const KeyedLine& keyed, std::size_t line, Clauses clauses = Clauses::of_prose) {
        ValueStatement stated = values_stated_under(keyed.key, keyed.value, clauses);
        if (!stated.unusable.empty()) stated.unusable = fmt::format("{} {}", keyed.key, keyed.value);
        set_values(stated, is_ordinate_key(keyed.key) ? StatementWeight::ordinate : StatementWeight::key, line);
        set_abscissa(abscissa_stated_under(keyed.key, keyed.value), line);
    }

    FileStatements end() {
        for (Declared& declared : statements_.declared) declared.factor = statements_.factor;
        return std::move(statements_);
    }

private:
    /// `Absorbance, forearm`: the name of a quantity, and no number of it.
    static bool is_title(const KeyedLine& keyed, std::string_view line) {
        return line.find_first_of(":=") == std::string_view::npos && !values_stated_wholly(keyed.key).is_empty() &&
               !starts_like_a_number(keyed.value);
    }

    void take_prose(const Comment& line, Clauses clauses) {
        const ValueStatement stated = values_stated_in_prose(line.text, clauses);
        if (stated.is_signal && is_compared_) {
            statements_.remarks.push_back(
                fmt::format("line {} speaks of raw data; they are read as the reflectance to which the file says they "
                            "were compared",
                            line.line));
            return;
        }
        set_values(stated, StatementWeight::prose, line.line);
        set_abscissa(abscissa_stated_in_prose(line.text), line.line);
        if (stated.is_empty()) remark_on_tale(line);
    }

    /// Prose that names another quantity without stating that the values are it.
    void remark_on_tale(const Comment& line) {
        const std::string plain = plain_text(line.text);
        if (values_stated(line.text).unusable.empty() || values_stated(line.text).quantity) return;
        for (const std::string_view word :
             {"absorbance", "log(1/r)", "optical density", "fluorescence", "irradiance"}) {
            if (!contains(plain, word) || contains(plain, "reflectance") || contains(plain, "transmittance")) continue;
            statements_.remarks.push_back(
                fmt::format("line {} speaks of {}; the values are read as what the names of their columns say, else as "
                            "reflectance",
                            line.line, word));
            return;
        }
    }

    /// Of lines that weigh the same, what is unusable counts, else the first.
    void set_values(const ValueStatement& stated, StatementWeight weight, std::size_t line) {
        if (stated.is_empty()) return;
        ValueStatement& values = statements_.values;
        const bool more = weight > weight_ && (stated.quantity || !stated.unusable.empty());
        const bool as_much =
            weight == weight_ && values.unusable.empty() && (!stated.unusable.empty() || !values.quantity);
        if (more || as_much) {
            const std::optional<Unit> unit = stated.unit ? stated.unit : values.unit;
            values = stated;
            values.unit = unit;
            weight_ = weight;
            statements_.values_where = place(source_, line);
        } else if (!values.unit && values.unusable.empty()) {
            values.unit = stated.unit;
        }
    }

    void set_abscissa(const std::optional<Abscissa>& stated, std::size_t line) {
        if (!stated || statements_.abscissa) return;
        statements_.abscissa = stated;
        statements_.abscissa_where = place(source_, line);
    }

    const std::string& source_;
    bool is_compared_;  ///< the file says that its data are compared to a white reference
    FileStatements statements_{};
    StatementWeight weight_ = StatementWeight::none;
};

/// The one that the lines state; a remark where they state both. What one of several cells states is of its column.
void take_specular(FileStatements& statements, std::span<const Comment> comments, std::span<const Comment> prose) {
    bool both = false;
    std::vector<Comment> lines(comments.begin(), comments.end());
    std::ranges::copy_if(prose, std::back_inserter(lines), [](const Comment& line) { return !is_of_cells(line.text); });
    for (const Comment& line : lines) {
        const std::optional<KeyedLine> keyed = keyed_line(line.text);
        if (keyed && keyed->key == "specular" && contains(line.text, ":")) continue;  // of `Description`
        auto stated = keyed ? specular_stated(keyed->key, keyed->value) : std::nullopt;
        const bool is_one_phrase = !keyed || line.text.find_first_of(":=\t") == std::string_view::npos;
        if (!stated && is_one_phrase) stated = specular_stated(line.text);
        if (!stated) continue;
        both = both || (statements.specular && statements.specular != stated);
        statements.specular = stated;
    }
    if (!both) return;
    statements.specular = std::nullopt;
    statements.remarks.emplace_back("the file states specular included and excluded; neither is taken for all spectra");
}

/// Whether a line says that the data are compared to a white reference, as ASD's ViewSpec writes it.
bool says_compared(std::span<const Comment> lines) {
    return std::ranges::any_of(lines, [](const Comment& line) {
        const std::string text = lower_case(line.text);
        return contains(text, "compared to a white reference") && !contains(text, "not compared");
    });
}

/// The line below which PerkinElmer's ASCII files, which begin with `PE`, hold the units of abscissa and ordinate; 0
/// where there is none.
std::size_t line_of_perkin_elmer(std::span<const Comment> comments, std::span<const Comment> prose) {
    if (prose.empty() || !prose.front().text.starts_with("PE ")) return 0;
    const auto found = std::ranges::find(comments, std::string_view("GR"), &Comment::text);
    return found == comments.end() ? 0 : found->line;
}

}  // namespace

std::optional<KeyedLine> keyed_line(std::string_view line) {
    constexpr std::size_t most_words = 4;  // of either side of a comma: more is prose
    line = trimmed(line);
    if (line.size() > 1 && line.front() == '"' && line.back() == '"') line = trimmed(line.substr(1, line.size() - 2));
    std::size_t at = line.find('\t');
    if (at == std::string_view::npos) at = line.find_first_of(":=");
    if (at == std::string_view::npos) {
        at = line.find_first_of(",;");
        const bool is_long = at != std::string_view::npos &&
                             (words_in(line.substr(0, at)) >= most_words || words_in(line.substr(at + 1)) > most_words);
        const bool is_prose = is_long || contains(line, " in ") || contains(line, " is ") || contains(line, " as ");
        if (is_prose) return std::nullopt;
    }
    if (at == std::string_view::npos) at = line.find("  ");
    if (at == std::string_view::npos || at == 0) return std::nullopt;
    const auto bare_part = [](std::string_view part) {
        const auto is_mark = [](char c) { return c == ':' || c == '=' || c == '"' || c == ',' || c == ';'; };
        part = trimmed(part);
        while (!part.empty() && is_mark(part.back())) part = trimmed(part.substr(0, part.size() - 1));
        while (!part.empty() && is_mark(part.front())) part = trimmed(part.substr(1));
        return part;
    };
    return KeyedLine{.key = bare_part(line.substr(0, at)), .value = bare_part(line.substr(at + 1))};
}

bool is_statement_key(std::string_view key) {
    return is_ordinate_key(key) || is_abscissa_key(key) || declared_by(0, key, "1").has_value();
}

FileStatements statements_in(const std::string& source, std::span<const Comment> comments,
                             std::span<const Comment> prose) {
    std::vector<Comment> all(comments.begin(), comments.end());
    all.insert(all.end(), prose.begin(), prose.end());
    StatedLines lines(source, says_compared(all));
    const std::size_t units = line_of_perkin_elmer(comments, prose);
    for (const Comment& comment : comments) lines.take(comment, true);
    for (const Comment& line : prose) {
        if (units > 0 && (line.line == units + 1 || line.line == units + 2)) {
            lines.take_keyed({.key = line.line == units + 1 ? "abscissa" : "ordinate", .value = line.text}, line.line);
        } else {
            lines.take(line, false);
        }
    }
    FileStatements statements = lines.end();
    take_specular(statements, comments, prose);
    return statements;
}

}  // namespace skinfit
