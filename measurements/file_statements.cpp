#include "measurements/file_statements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

using Keys = std::span<const std::string_view>;

/// `file:line`; the file alone where the line is 0.
std::string place(const std::string& source, std::size_t line) {
    return line > 0 ? fmt::format("{}:{}", source, line) : source;
}

bool is_key_in(std::string_view key, Keys keys) {
    return std::ranges::find(keys, key) != keys.end();
}

bool is_abscissa_key(std::string_view key) {
    static constexpr std::array<std::string_view, 14> keys = {
        "xunits",   "xunit",        "xlabel", "xaxis",          "xaxisunit",       "xaxisunits", "xaxistitle",
        "abscissa", "abscissaunit", "xmode",  "wavelengthunit", "wavelengthunits", "xtitle",     "horizontalaxis"};
    return is_key_in(bare_key(key), keys);
}

/// A multiplier, a scale or an offset.
void take_scale(FileStatements& statements, const std::string& source, std::size_t line, const KeyedLine& keyed,
                bool is_comment) {
    static constexpr std::array<std::string_view, 5> multipliers = {"yfactor", "multiplier", "multiplyby",
                                                                    "multiplication", "multiplicationfactor"};
    static constexpr std::array<std::string_view, 4> divisors = {"divisor", "divideby", "dividedby", "denominator"};
    static constexpr std::array<std::string_view, 10> ambiguous = {
        "scale",     "scalefactor",     "scalingfactor", "reflectancescalefactor",
        "datascale", "datascalefactor", "xfactor",       "datagainvalues",
        "yscale",    "yscalefactor"};
    static constexpr std::array<std::string_view, 2> gains = {"gain", "datagain"};
    static constexpr std::array<std::string_view, 5> offsets = {"offset", "addoffset", "yoffset", "dataoffset",
                                                                "dataoffsetvalues"};
    const std::string key = bare_key(keyed.key);
    const bool multiplies = is_key_in(key, multipliers);
    const bool divides = is_key_in(key, divisors);
    const bool scales = is_key_in(key, ambiguous) || (is_comment && is_key_in(key, gains));
    const bool shifts = is_key_in(key, offsets) && (is_comment || key != "offset");
    if (!multiplies && !divides && !scales && !shifts) return;
    const std::optional<double> number = parse_number(keyed.value);
    if (number && *number == (shifts ? 0 : 1)) return;
    if ((multiplies || divides) && number && *number > 0 && std::isfinite(*number)) {
        statements.factor *= multiplies ? *number : 1 / *number;
        statements.remarks.push_back(fmt::format("the values are {} by {}, as {} states",
                                                 multiplies ? "multiplied" : "divided", *number, in_quotes(keyed.key)));
        return;
    }
    throw InputError({.where = place(source, line),
                      .problem = fmt::format("states {} of {}", in_quotes(keyed.key), in_quotes(keyed.value)),
                      .why = shifts ? "offsets of text files are not applied, and the values would be wrong without it"
                                    : "whether values are to be multiplied or divided by it, or have been, is not said",
                      .remedy = "apply it to the values and delete this line, or call it multiplier or divisor"});
}

std::size_t words_in(std::string_view line) {
    const std::vector<std::string_view> words = split(line, ' ');
    return static_cast<std::size_t>(std::ranges::count_if(words, [](std::string_view word) { return !word.empty(); }));
}

/// What one line states.
class Line {
public:
    Line(FileStatements& statements, const std::string& source, const Comment& comment, bool is_comment)
        : statements_(statements), source_(source), comment_(comment), is_comment_(is_comment) {}

    void take() {
        const std::optional<KeyedLine> keyed = keyed_line(comment_.text);
        if (!keyed) {
            take_prose();
            return;
        }
        static constexpr std::array<std::string_view, 2> known = {"quantity", "unit"};  // of `Description`
        if (is_comment_ && is_key_in(keyed->key, known)) return;
        if (is_ordinate_key(keyed->key)) take_values(*keyed);
        if (is_abscissa_key(keyed->key)) take_abscissa(*keyed);
        take_scale(statements_, source_, comment_.line, *keyed, is_comment_);
        if (const auto declared = declared_by(comment_.line, keyed->key, keyed->value)) {
            statements_.declared.push_back(*declared);
        }
    }

private:
    [[nodiscard]] std::string where() const { return place(source_, comment_.line); }

    /// A line of up to three words may be the only one that tells: `Absorbance`, `Raw counts`.
    void take_prose() {
        constexpr std::size_t most_words = 3;
        const ValueStatement stated = values_stated(comment_.text);
        if (words_in(comment_.text) <= most_words) {
            if (!stated.unusable.empty()) set_values(stated);
            return;
        }
        if (stated.unusable.empty() || stated.quantity) return;
        const std::string plain = plain_text(comment_.text);
        for (const std::string_view word :
             {"absorbance", "log(1/r)", "optical density", "fluorescence", "irradiance"}) {
            if (!contains(plain, word) || contains(plain, "reflectance") || contains(plain, "transmittance")) continue;
            statements_.remarks.push_back(
                fmt::format("line {} speaks of {}; the values are read as what the names of their columns say, else as "
                            "reflectance",
                            comment_.line, word));
            return;
        }
    }

    void set_values(const ValueStatement& stated) {
        if (!statements_.values.unusable.empty()) return;
        if (!stated.unusable.empty() || !statements_.values.quantity) {
            const std::optional<Unit> unit = stated.unit ? stated.unit : statements_.values.unit;
            statements_.values = stated;
            statements_.values.unit = unit;
            statements_.values_where = where();
        }
    }

    void take_values(const KeyedLine& keyed) {
        ValueStatement stated = values_stated_by_letter(keyed.value);
        if (!stated.unusable.empty()) stated.unusable = fmt::format("{} {}", keyed.key, keyed.value);
        if (stated.quantity || stated.unit || !stated.unusable.empty()) set_values(stated);
    }

    void take_abscissa(const KeyedLine& keyed) {
        const std::optional<Abscissa> stated = abscissa_stated(keyed.value);
        if (!stated || statements_.abscissa) return;
        statements_.abscissa = stated;
        statements_.abscissa_where = where();
    }

    FileStatements& statements_;
    const std::string& source_;
    const Comment& comment_;
    bool is_comment_;
};

/// The one that the lines state; a remark where they state both.
void take_specular(FileStatements& statements, std::span<const Comment> lines) {
    bool both = false;
    for (const Comment& line : lines) {
        const std::optional<KeyedLine> keyed = keyed_line(line.text);
        if (keyed && keyed->key == "specular") continue;  // of `Description`
        auto stated = keyed ? specular_stated(keyed->key, keyed->value) : std::nullopt;
        if (!stated && !keyed) stated = specular_stated(line.text);
        if (!stated) continue;
        both = both || (statements.specular && statements.specular != stated);
        statements.specular = stated;
    }
    if (!both) return;
    statements.specular = std::nullopt;
    statements.remarks.emplace_back("the file states specular included and excluded; neither is taken for all spectra");
}

}  // namespace

std::optional<KeyedLine> keyed_line(std::string_view line) {
    line = trimmed(line);
    if (line.size() > 1 && line.front() == '"' && line.back() == '"') line = trimmed(line.substr(1, line.size() - 2));
    std::size_t at = line.find('\t');
    if (at == std::string_view::npos) at = line.find_first_of(":=");
    if (at == std::string_view::npos) at = line.find_first_of(",;");
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

bool is_ordinate_key(std::string_view key) {
    static constexpr std::array<std::string_view, 40> keys = {"technique",
                                                              "modeunit",
                                                              "viewmode",
                                                              "displaymode",
                                                              "yunits",
                                                              "yunit",
                                                              "ylabel",
                                                              "yaxis",
                                                              "yaxisunit",
                                                              "yaxisunits",
                                                              "yaxistitle",
                                                              "ytitle",
                                                              "ymode",
                                                              "ordinate",
                                                              "ordinatemode",
                                                              "ordinateunit",
                                                              "ordinateunits",
                                                              "datatype",
                                                              "datamode",
                                                              "dataunits",
                                                              "measurementmode",
                                                              "measurementtype",
                                                              "measurement",
                                                              "mode",
                                                              "type",
                                                              "quantity",
                                                              "measurand",
                                                              "units",
                                                              "unit",
                                                              "spectrumtype",
                                                              "spectraltype",
                                                              "spectraldatatype",
                                                              "photometricmode",
                                                              "measuringmode",
                                                              "valuetype",
                                                              "scantype",
                                                              "acquisitionmode",
                                                              "signaltype",
                                                              "spectrometermode",
                                                              "measuredquantity"};
    return is_key_in(bare_key(key), keys);
}

bool is_statement_key(std::string_view key) {
    return is_ordinate_key(key) || is_abscissa_key(key) || declared_by(0, key, "1").has_value();
}

FileStatements statements_in(const std::string& source, std::span<const Comment> comments,
                             std::span<const Comment> prose) {
    FileStatements statements;
    for (const Comment& comment : comments) Line(statements, source, comment, true).take();
    for (const Comment& line : prose) Line(statements, source, line, false).take();
    std::vector<Comment> all(comments.begin(), comments.end());
    all.insert(all.end(), prose.begin(), prose.end());
    take_specular(statements, all);
    return statements;
}

}  // namespace skinfit
