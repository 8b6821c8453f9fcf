#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fit/result.hpp"

/// What a fit says in quantities that do not depend on how its model divides the skin.
namespace skinfit {

/// A quantity of the tissue, computed from parameters:
///   dermal_hemoglobin_umol_per_l: tetramers in a litre of dermis, each depth z weighted by exp(-z / 0.03 cm), as far
///   as green light goes; the blood fractions of two layers are the model's, their sum is hardly told by a spectrum.
///   Of the preset `skin` by calibration (`calibrated_hemoglobin_umol_per_l`), else as the model has it;
///   epidermal_melanin_optical_depth: of the melanosomes at 500 nm, by natural logarithm;
///   tissue_bilirubin_mg_per_dl, tissue_bilirubin_umol_per_l: in a volume of dermis, in its blood and outside it,
///   weighted likewise.
struct TissueQuantity {
    std::string_view name;  ///< JSON key and report row
    std::string_view unit;
    double (*value)(const Skin&);  ///< as the model has it
};

/// All of them, in the order of reports.
[[nodiscard]] std::span<const TissueQuantity> tissue_quantities();

/// The quantity of that name; null where there is none.
[[nodiscard]] const TissueQuantity* find_tissue_quantity(std::string_view name);

/// Whether fits with these settings adjust something that the quantity is computed from.
[[nodiscard]] bool is_adjusted(const TissueQuantity& quantity, const FitSettings& settings);

/// One of them with its 95 % interval.
struct TissueEstimate {
    const TissueQuantity* quantity;
    double value;
    /// From the draws of the posterior; else from the intervals of the parameters, whose effects on its logarithm are
    /// added with their correlations. None where a parameter that counts is not identifiable.
    std::optional<Bounds> interval_95;
    double (*value_of)(const Skin&) = nullptr;  ///< what `value` is of the skin of the answer
    bool is_calibrated = false;  ///< on skins of another physics: the interval allows for the model's error
    Eigen::RowVectorXd draws{};  ///< of the posterior, one for each of its draws; empty where it was not sampled
};

/// "8.1 to 17"; "-" without an interval.
[[nodiscard]] std::string interval_words(const TissueEstimate& estimate);

/// What the reports say of those that are calibrated; empty where none is.
[[nodiscard]] std::string calibration_words(const std::vector<TissueEstimate>& estimates);

/// Of the specimen of a fit that adjusts something of them; none of skin without dermis or of several spectra with
/// parameters of their own.
[[nodiscard]] std::vector<TissueEstimate> tissue_estimates(const FitResult& result);

}  // namespace skinfit
