#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "study/answers.hpp"

/// Rows of a ledger as fits give them.
namespace skinfit::test {

/// Of a parameter between 0 and 1, away from both.
[[nodiscard]] inline ParameterEstimate example_estimate(const std::string& name, double value, double sigma) {
    constexpr double normal_95 = 1.959963984540054;
    return {.name = name,
            .value = value,
            .sigma = sigma,
            .interval_95 = {.lower = value - normal_95 * sigma, .upper = value + normal_95 * sigma},
            .bounds = {.lower = 0.0, .upper = 1.0},
            .status = Status::free};
}

/// An answer with numbers that no short decimal states.
[[nodiscard]] inline StudiedSpectrum example_answer() {
    StudiedSpectrum studied{.status = FitStatus::suspect, .verdict = "suspect", .reason = "AT BOUND: a | MISFIT: b"};
    studied.parameters = {example_estimate("melanosome_fraction", 1.0 / 3.0, 0.1 / 7.0),
                          example_estimate("oxygen_saturation", 5e-324, 1.0 / 11.0)};
    studied.parameters[1].sigma.reset();
    studied.parameters[1].status = Status::at_lower_bound;
    studied.parameters[0].prior = LogNormalPrior{.median = 0.1 / 3.0, .sigma_log = 1.0 / 7.0};
    studied.parameters[0].decided_by_prior = true;
    studied.parameters[0].quantiles = {0.1 + 0.2, 1.0 / 3.0, 0.7};
    studied.parameters[0].split_by_model = true;
    studied.tissue = {{.name = "dermal_hemoglobin_umol_per_l",
                       .value = 100.0 / 7.0,
                       .interval_95 = Bounds{.lower = 10.0 / 7.0, .upper = 1000.0 / 7.0},
                       .quantiles = {0.1 + 0.2, 100.0 / 7.0}},
                      {.name = "tissue_bilirubin_mg_per_dl", .value = 0.0, .interval_95 = {}}};
    studied.correlation = {-2.0 / 3.0};
    studied.indices = {{.name = index_table()[0].name, .value = 100.0 / 3.0, .sigma = 1.0 / 9.0}};
    studied.rmse = 1e-3 / 3.0;
    studied.chi2 = std::numeric_limits<double>::max();
    studied.degrees_of_freedom = 29.0 + 1.0 / 3.0;
    studied.seconds = 0.1;
    return studied;
}

/// A fitted spectrum with the words of `metadata` and one parameter.
[[nodiscard]] inline LedgerRow example_row(const std::string& name, Metadata metadata, ParameterEstimate estimate) {
    LedgerRow row{.key = {.source = "a.csv", .number = 1, .name = name},
                  .metadata = std::move(metadata),
                  .input_hash = "input",
                  .configuration_hash = "settings",
                  .studied = {}};
    row.studied.status = FitStatus::fitted;
    row.studied.verdict = "consistent";
    row.studied.parameters = {std::move(estimate)};
    return row;
}

}  // namespace skinfit::test
