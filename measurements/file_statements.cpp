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

/// Letters and digits alone: `Y Units`, `y_units` and `YUNITS` are one key.
std::string bare(std::string_view key) {
    std::string letters = lower_case(key);
    std::erase_if(letters, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
    return letters;
}

bool is_one_of(std::string_view key, Keys keys) {
    return std::ranges::find(keys, key) != keys.end();
}

bool is_abscissa_key(std::string_view key) {
    static constexpr std::array<std::string_view, 14> keys = {
        "xunits",    "xunit",        "xlabel",     "xaxis",          "xaxisunit",       "xaxisunits", "xaxistitle",
        "abscissa",  "abscissaunit", "xmode",      "wavelengthunit", "wavelengthunits", "xtitle",     "horizontalaxis"};
    return is_one_of(bare(key), keys);
}

std::string_view meaning_of(std::string_view key) {
    static constexpr std::array<std::string_view, 13> counts = {
        "npoints", "numberofpoints", "noofpoints", "nrofpoints", "numberofdatapoints", "datapoints", "points",
        "numpoints", "numberofpixelsinprocessedspectrum", "numberofpixelsinspectrum", "channels", "numberofchannels",
        "numberofbands"};
    struct Meaning {
        std::string_view key;
        std::string_view meaning;
    };
    static constexpr std::array<Meaning, 5> others = {{{"firstx", "first x"},
                                                       {"lastx", "last x"},
                                                       {"firsty", "first y"},
                                                       {"maxy", "largest y"},
                                                       {"miny", "smallest y"}}};
    const std::string plain = bare(key);
    if (is_one_of(plain, counts)) return "count";
    const auto found = std::ranges::find(others, std::string_view(plain), &Meaning::key);
    return found == others.end() ? std::string_view{} : found->meaning;
}

/// 0.01 for `12.34`; of numbers in powers of ten, the step of their mantissa.
double last_decimal(std::string_view number) {
    const std::size_t exponent = number.find_first_of("eE");
    const std::string_view mantissa = number.substr(0, exponent);
    const std::size_t point = mantissa.find('.');
    const auto decimals = point == std::string_view::npos ? 0.0 : static_cast<double>(mantissa.size() - point - 1);
    double power = 0;
    if (exponent != std::string_view::npos) power = parse_number(number.substr(exponent + 1)).value_or(0);
    return std::pow(10.0, power - decimals);
}

/// A multiplier, a scale or an offset.
void take_scale(FileStatements& statements, const std::string& source, std::size_t line, const KeyedLine& keyed,
                bool is_comment) {
    static constexpr std::array<std::string_view, 5> multipliers = {"yfactor", "multiplier", "multiplyby",
                                                                    "multiplication", "multiplicationfactor"};
    static constexpr std::array<std::string_view, 4> divisors = {"divisor", "divideby", "dividedby", "denominator"};
    static constexpr std::array<std::string_view, 10> ambiguous = {
        "scale", "scalefactor", "scalingfactor", "reflectancescalefactor", "datascale",
        "datascalefactor", "xfactor", "datagainvalues", "yscale", "yscalefactor"};
    static constexpr std::array<std::string_view, 2> gains = {"gain", "datagain"};
    static constexpr std::array<std::string_view, 5> offsets = {"offset", "addoffset", "yoffset", "dataoffset",
                                                                "dataoffsetvalues"};
    const std::string key = bare(keyed.key);
    const bool multiplies = is_one_of(key, multipliers);
    const bool divides = is_one_of(key, divisors);
    const bool scales = is_one_of(key, ambiguous) || (is_comment && is_one_of(key, gains));
    const bool shifts = is_one_of(key, offsets) && (is_comment || key != "offset");
    if (!multiplies && !divides && !scales && !shifts) return;
    const std::string where = fmt::format("{}:{}", source, line);
    const std::optional<double> number = parse_number(keyed.value);
    if (number && *number == (shifts ? 0 : 1)) return;
    if ((multiplies || divides) && number && *number > 0 && std::isfinite(*number)) {
        statements.factor *= multiplies ? *number : 1 / *number;
        statements.remarks.push_back(fmt::format("line {}: the values are {} by {}, as {} states", line,
                                                 multiplies ? "multiplied" : "divided", *number, in_quotes(keyed.key)));
        return;
    }
    throw InputError({.where = where,
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
        if (is_comment_ && is_one_of(keyed->key, known)) return;
        if (is_ordinate_key(keyed->key)) take_values(*keyed);
        if (is_abscissa_key(keyed->key)) take_abscissa(*keyed);
        take_scale(statements_, source_, comment_.line, *keyed, is_comment_);
        take_declared(*keyed);
    }

private:
    [[nodiscard]] std::string where() const { return fmt::format("{}:{}", source_, comment_.line); }

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
        for (const std::string_view word : {"absorbance", "log(1/r)", "optical density", "fluorescence", "irradiance"}) {
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
        const ValueStatement stated = values_stated_by_letter(keyed.value);
        if (stated.quantity || stated.unit || !stated.unusable.empty()) set_values(stated);
    }

    void take_abscissa(const KeyedLine& keyed) {
        const std::optional<Abscissa> stated = abscissa_stated(keyed.value);
        if (!stated || statements_.abscissa) return;
        statements_.abscissa = stated;
        statements_.abscissa_where = where();
    }

    void take_declared(const KeyedLine& keyed) {
        const std::string_view meaning = meaning_of(keyed.key);
        const std::string_view word = keyed.value.substr(0, keyed.value.find_first_of(" \t(,;"));
        const std::optional<double> number = parse_number(word);
        if (meaning.empty() || !number || !std::isfinite(*number)) return;
        statements_.declared.push_back({.line = comment_.line,
                                        .key = std::string(keyed.key),
                                        .meaning = std::string(meaning),
                                        .number = *number,
                                        .step = last_decimal(word)});
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
    static constexpr std::array<std::string_view, 36> keys = {
        "yunits",          "yunit",         "ylabel",         "yaxis",           "yaxisunit",       "yaxisunits",
        "yaxistitle",      "ytitle",        "ymode",          "ordinate",        "ordinatemode",    "ordinateunit",
        "ordinateunits",   "datatype",      "datamode",       "dataunits",       "measurementmode", "measurementtype",
        "measurement",     "mode",          "type",           "quantity",        "measurand",       "units",
        "unit",            "spectrumtype",  "spectraltype",   "spectraldatatype", "photometricmode", "measuringmode",
        "valuetype",       "scantype",      "acquisitionmode", "signaltype",     "spectrometermode", "measuredquantity"};
    return is_one_of(bare(key), keys);
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

void check_declared(const std::string& source, std::span<const Declared> declared, std::span<const double> x,
                    std::span<const double> y) {
    for (const Declared& each : declared) {
        std::optional<double> found;
        if (each.meaning == "count") found = static_cast<double>(x.size());
        if (each.meaning == "first x") found = x.front();
        if (each.meaning == "last x") found = x.back();
        if (each.meaning == "first y" && !y.empty()) found = y.front();
        if (each.meaning == "largest y" && !y.empty()) found = std::ranges::max(y);
        if (each.meaning == "smallest y" && !y.empty()) found = std::ranges::min(y);
        if (!found || std::isnan(*found)) continue;
        const double tolerance = each.step + 1e-4 * std::abs(*found);  // of numbers that are rounded for people
        if (std::abs(*found - each.number) <= (each.meaning == "count" ? 0 : tolerance)) continue;
        throw InputError({.where = fmt::format("{}:{}", source, each.line),
                          .problem = fmt::format("{} is {}", each.key, each.number),
                          .why = each.meaning == "count" ? fmt::format("the table has {} readings", *found)
                                                         : fmt::format("the {} of the table is {}", each.meaning, *found),
                          .remedy = "check that the file is complete and unchanged, or delete this line"});
    }
}

}  // namespace skinfit
