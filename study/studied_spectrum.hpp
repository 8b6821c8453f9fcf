#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/json.hpp"
#include "fit/configuration.hpp"
#include "fit/uncertainty.hpp"
#include "study/fit_status.hpp"
#include "study/indices.hpp"

namespace skinfit {

/// What a fit says of one free parameter.
struct ParameterEstimate {
    std::string name;
    double value;
    std::optional<double> sigma;
    Bounds interval_95;
    Bounds bounds;  ///< of the fit
    Status status;
    std::vector<double> quantiles{};  ///< of the posterior at 0, 1, ..., 100 %, where it was sampled
    std::optional<Prior> prior{};     ///< unset: uniform within the bounds
    bool decided_by_prior = false;    ///< `ParameterUncertainty::decided_by_prior`
    bool split_by_model = false;      ///< `is_split_by_model`
};

/// What a fit says of one quantity of the tissue (`TissueEstimate`).
struct TissueValue {
    std::string name;
    double value;
    std::optional<Bounds> interval_95;
    std::vector<double> quantiles{};  ///< of the posterior at 0, 1, ..., 100 %, where it was sampled
};

/// What became of one spectrum of a study.
struct StudiedSpectrum {
    FitStatus status = FitStatus::pending;
    std::string verdict{};  ///< of the fit; empty without one
    std::string reason{};   ///< why it is suspect, rejected or failed, worst first; empty when fitted
    std::vector<ParameterEstimate> parameters{};  ///< in the order of the parameter table; empty without a fit
    std::vector<double> correlation{};            ///< of each parameter with those before it, row after row
    std::vector<TissueValue> tissue{};            ///< in the order of `tissue_quantities`
    std::vector<IndexValue> indices{};
    std::optional<double> rmse{};
    std::optional<double> chi2{};
    std::optional<double> degrees_of_freedom{};
    std::optional<double> p_value{};
    double seconds = 0.0;  ///< that it took; no part of the answer
};

/// The parts of the answer that are lists, as the ledger keeps them; exact to the last bit.
[[nodiscard]] Json parameters_json(const std::vector<ParameterEstimate>& parameters);
[[nodiscard]] std::vector<ParameterEstimate> parameters_from_json(const Json& json);
[[nodiscard]] Json tissue_json(const std::vector<TissueValue>& tissue);
[[nodiscard]] std::vector<TissueValue> tissue_from_json(const Json& json);
[[nodiscard]] Json indices_json(const std::vector<IndexValue>& indices);
[[nodiscard]] std::vector<IndexValue> indices_from_json(const Json& json);

/// All of it, exact to the last bit.
[[nodiscard]] Json to_json(const StudiedSpectrum& spectrum);
[[nodiscard]] StudiedSpectrum studied_from_json(const Json& json);

/// The status of that name. Throws std::out_of_range where there is none.
[[nodiscard]] FitStatus fit_status_named(std::string_view name);

}  // namespace skinfit
