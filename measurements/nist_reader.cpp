#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <span>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/cell_numbers.hpp"
#include "measurements/cells.hpp"
#include "measurements/columns.hpp"
#include "measurements/description.hpp"
#include "measurements/readers.hpp"
#include "measurements/spectrum_building.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// `,Subject 1,,,,Subject 3,...`
bool names_subjects(std::string_view line) {
    CellCutter cutter(',');
    const std::span<const std::string_view> cells = cutter.cut(line);
    return cells.size() > 1 && cells[0].empty() && lower_case(cells[1]).starts_with("subject ");
}

/// The columns of one subject.
struct Subject {
    std::string name;
    std::vector<std::size_t> repeats;
    std::vector<std::size_t> means;
};

/// What the two lines of the header say: the subject of a column is the last one named at or before it.
std::vector<Subject> subjects_in(const Columns& columns) {
    CellCutter cutter(',');
    const std::span<const std::string_view> titles = cutter.cut(columns.preamble.back().text);
    std::vector<Subject> subjects;
    for (std::size_t c = 1; c < columns.width; ++c) {
        if (c < titles.size() && !titles[c].empty()) {
            subjects.push_back({.name = lower_case(titles[c]), .repeats = {}, .means = {}});
        }
        if (subjects.empty()) continue;
        const std::string label = lower_case(columns.names[c]);
        (label.starts_with("average") || label.starts_with("mean") ? subjects.back().means : subjects.back().repeats)
            .push_back(c);
    }
    return subjects;
}

/// The standard uncertainty of the mean of readings with `decimals_step` between neighbouring numbers: the readings'
/// own scatter, and the rounding of the mean, without which equal readings would be taken for perfect ones.
double sigma_of_mean(std::span<const double> readings, double decimals_step) {
    const auto n = static_cast<double>(readings.size());
    const double mean = std::accumulate(readings.begin(), readings.end(), 0.0) / n;
    double squares = 0.0;
    for (const double reading : readings) squares += (reading - mean) * (reading - mean);
    return std::sqrt(squares / (n - 1) / n + decimals_step * decimals_step / 12);
}

class NistTable {
public:
    NistTable(const Columns& columns, const NumberTable& numbers) : columns_(columns), numbers_(numbers) {
        const std::vector<double> nm = column(0);
        grid_ = make_grid(nm, [&columns](std::size_t i) {
            const std::size_t line = columns.rows[i].line;
            return GridPlace{.where = at_line(columns, line), .which = fmt::format("line {}", line)};
        });
    }

    [[nodiscard]] std::vector<double> column(std::size_t c) const {
        std::vector<double> values;
        for (std::size_t at = c; at < numbers_.cells.size(); at += numbers_.width) values.push_back(numbers_.cells[at]);
        return values;
    }

    [[nodiscard]] Spectrum spectrum(std::size_t c, const UnitStatements& statements) const {
        Spectrum spectrum;
        spectrum.source = columns_.source;
        spectrum.line = columns_.header_line;
        spectrum.notes = notes_in(columns_.preamble);
        take_readings(spectrum, grid_, {.value = column(c)}, statements);
        return spectrum;
    }

private:
    const Columns& columns_;
    const NumberTable& numbers_;
    Grid grid_;
};

/// Each standard uncertainty pooled with those of its neighbours, root mean square: a few repeats cross each other here
/// and there by chance, which is no certainty. What lies in the window and what does not say nothing of each other.
std::vector<double> pooled(const std::vector<double>& sigma, const std::vector<double>& wavelength_nm,
                           const WavelengthWindow& window) {
    constexpr double reach_nm = 50;  // wider than a band of hemoglobin
    std::vector<double> smooth;
    for (const double centre_nm : wavelength_nm) {
        double sum = 0;
        double count = 0;
        for (std::size_t i = 0; i < sigma.size(); ++i) {
            if (std::abs(wavelength_nm[i] - centre_nm) > reach_nm || std::isnan(sigma[i])) continue;
            if (window.contains(wavelength_nm[i]) != window.contains(centre_nm)) continue;
            sum += sigma[i] * sigma[i];
            ++count;
        }
        smooth.push_back(std::sqrt(sum / count));  // NaN where none is known
    }
    return smooth;
}

/// The values of `reading` at these wavelengths, NaN where it has none.
std::vector<double> values_at(const Spectrum& reading, const std::vector<double>& wavelength_nm) {
    if (reading.wavelength_nm == wavelength_nm) return reading.value;
    std::vector<double> values;
    for (const double nm : wavelength_nm) {
        const auto found = std::ranges::lower_bound(reading.wavelength_nm, nm);
        const bool has = found != reading.wavelength_nm.end() && *found == nm;
        values.push_back(has ? reading.value[static_cast<std::size_t>(found - reading.wavelength_nm.begin())]
                             : std::numeric_limits<double>::quiet_NaN());
    }
    return values;
}

/// Gives the mean its readings and the uncertainty that follows from them, where all of them have all its wavelengths
/// in the window.
void take_repeats(Spectrum& mean, const std::vector<Spectrum>& readings, const WavelengthWindow& window) {
    constexpr double decimals_step = 1e-4;  // "4 digits after the decimal", says the file
    if (readings.size() < 2) return;
    std::vector<std::vector<double>> repeats;
    for (const Spectrum& reading : readings) {
        repeats.push_back(values_at(reading, mean.wavelength_nm));
        for (std::size_t i = 0; i < mean.wavelength_nm.size(); ++i) {
            if (std::isnan(repeats.back()[i]) && window.contains(mean.wavelength_nm[i])) return;
        }
    }
    mean.repeats = std::move(repeats);
    std::vector<double> sigma;
    for (std::size_t i = 0; i < mean.value.size(); ++i) {
        std::vector<double> at_once;
        for (const std::vector<double>& repeat : mean.repeats) at_once.push_back(repeat[i]);
        sigma.push_back(sigma_of_mean(at_once, decimals_step));
    }
    mean.sigma = pooled(sigma, mean.wavelength_nm, window);
    mean.sigma_source = fmt::format("from {} repeats, pooled over 50 nm to either side", readings.size());
}

std::optional<Quantity> measurand(const Columns& columns) {
    for (const Comment& prose : columns.preamble) {
        if (const auto quantity = quantity_named(prose.text)) return quantity;
    }
    return std::nullopt;
}

}  // namespace

bool holds_nist_m38597(std::string_view text) {
    constexpr std::size_t most_lines = 100;  // of prose
    LineReader reader(text);
    bool after_subjects = false;
    for (std::size_t i = 0; i < most_lines; ++i) {
        const auto line = reader.next();
        if (!line) return false;
        if (after_subjects && lower_case(line->substr(0, 10)) == "wavelength") return true;
        after_subjects = names_subjects(*line);
    }
    return false;
}

std::vector<Spectrum> read_nist_m38597(std::string_view text, const std::string& source, const ReadOptions& options) {
    const Columns columns = split_columns(text, source);
    if (columns.preamble.empty() || columns.names.empty() || !names_subjects(columns.preamble.back().text)) {
        throw InputError({.where = source,
                          .problem = "has no line of subjects above the names of its columns",
                          .why = "the form of NIST M38597 has both, as in \",Subject 1,,,,Subject 2\"",
                          .remedy = "choose another --reader, or leave the option out"});
    }
    std::vector<std::size_t> all(columns.width);
    std::iota(all.begin(), all.end(), std::size_t{0});
    const NumberTable numbers = read_number_table(columns, all);
    const NistTable table(columns, numbers);
    const std::string header = columns.names.front();
    const UnitStatements statements{
        .option = options.unit, .comment = std::nullopt, .header = header, .window = options.window};
    const std::optional<Quantity> quantity = measurand(columns);

    std::vector<Spectrum> spectra;
    for (const Subject& subject : subjects_in(columns)) {
        std::vector<Spectrum> readings;
        for (const std::size_t c : subject.repeats) {
            if (numbers.holds_words[c]) continue;
            readings.push_back(table.spectrum(c, statements));
            readings.back().name = fmt::format("{} {}", subject.name, columns.names[c]);
        }
        std::vector<Spectrum> means;
        for (const std::size_t c : subject.means) {
            if (numbers.holds_words[c]) continue;
            means.push_back(table.spectrum(c, statements));
            means.back().name = fmt::format("{} mean", subject.name);
            take_repeats(means.back(), readings, options.window);
        }
        std::ranges::move(readings, std::back_inserter(spectra));
        std::ranges::move(means, std::back_inserter(spectra));
    }
    for (Spectrum& spectrum : spectra) spectrum.quantity = quantity;
    return spectra;
}

}  // namespace skinfit
