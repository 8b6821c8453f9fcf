#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fit/configuration.hpp"
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

/// The findings on spectra of one set, by the tables of the model.
[[nodiscard]] std::vector<Finding> findings_in(std::span<const Spectrum> spectra);

/// The findings on spectra that are to be fitted, with quantity and geometry as `configuration` resolves them;
/// hemoglobin is looked for where there are four layers.
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
