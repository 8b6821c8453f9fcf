#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "fit/result.hpp"

/// What a fit says in quantities that do not depend on how its model divides the skin.
namespace skinfit {

/// A quantity of the tissue, computed from parameters:
///   dermal_hemoglobin_umol_per_l: tetramers in a litre of dermis, each depth z weighted by exp(-z / 0.03 cm), as far
///   as green light goes; the blood fractions of two layers are the model's, their sum is hardly told by a spectrum;
///   epidermal_melanin_optical_depth: of the melanosomes at 500 nm, by natural logarithm;
///   tissue_bilirubin_mg_per_dl, tissue_bilirubin_umol_per_l: in a volume of dermis, in its blood and outside it,
///   weighted likewise.
struct TissueQuantity {
    std::string_view name;  ///< JSON key and report row
    std::string_view unit;
    double (*value)(const Skin&);
};

/// All of them.
[[nodiscard]] std::span<const TissueQuantity> tissue_quantities();

/// One of them with its 95 % interval.
struct TissueEstimate {
    const TissueQuantity* quantity;
    double value;
    /// From the draws of the posterior; else from the intervals of the parameters, whose effects on its logarithm are
    /// added with their correlations. None where a parameter that counts is not identifiable.
    std::optional<Bounds> interval_95;
};

/// Of the specimen of a fit that adjusts something of them; none of skin without dermis or of several spectra with
/// parameters of their own.
[[nodiscard]] std::vector<TissueEstimate> tissue_estimates(const FitResult& result);

}  // namespace skinfit
