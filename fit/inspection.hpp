#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fit/resolution.hpp"
#include "fit/settings.hpp"
#include "measurements/quality.hpp"
#include "measurements/spectrum_file.hpp"

namespace skinfit {

/// What is to be known of a file before its spectra are fitted. What is optional is what all spectra share.
struct Inspection {
    SpectrumFile file;
    double first_nm;  ///< of all spectra
    double last_nm;
    std::optional<double> step_nm;  ///< none where the wavelengths are not evenly spaced, or only one
    std::size_t fewest_readings;    ///< of one spectrum
    std::size_t most_readings;
    double smallest;  ///< of all values
    double largest;
    std::string unit_rule;  ///< all in use
    std::string sigma_source;
    std::optional<Quantity> quantity;
    Geometry geometry;
    std::string instrument;  ///< all that are named
    std::optional<double> aperture_mm;
    std::optional<Bandpass> bandpass;
    std::vector<Finding> findings;
};

/// The wavelengths that a fit uses which is not told otherwise: 400 to 700 nm.
[[nodiscard]] WavelengthWindow usual_window();

/// The findings on spectra of one set, by the tables of the model: first those on what lies in `usual_window`, then, as
/// notes, those to which only the rest gives cause. Of a spectrum that has nothing in that window all counts.
[[nodiscard]] std::vector<Finding> findings_in(std::span<const Spectrum> spectra);

/// The findings on what the fit uses of its spectra, with quantity and geometry as they are resolved; hemoglobin is
/// looked for where there are four layers. Of a spectrum of which nothing is used: whether it lies outside the tables.
[[nodiscard]] std::vector<Finding> findings_before_fit(const FitInput& input);

/// The same of one spectrum of which the fit uses something, decided alike for many.
[[nodiscard]] std::vector<Finding> findings_before_fit(const ResolvedConfiguration& configuration,
                                                       const Spectrum& spectrum);

/// The same of `fit_input`.
[[nodiscard]] std::vector<Finding> findings_before_fit(const Configuration& configuration,
                                                       std::span<const Spectrum> spectra);

/// What `file` states, and what the quality checks say of it.
[[nodiscard]] Inspection inspected(SpectrumFile file);

/// For people, with a plot.
[[nodiscard]] std::string inspection_text(const Inspection& inspection);

/// For programs.
[[nodiscard]] Json inspection_json(const Inspection& inspection);

/// Findings as the reports of programs list them.
[[nodiscard]] Json findings_json(const std::vector<Finding>& findings);

/// Findings as the reports for people list them: each kind once, with the spectra that have it.
[[nodiscard]] std::string findings_text(const std::vector<Finding>& findings, std::size_t spectra);

}  // namespace skinfit
