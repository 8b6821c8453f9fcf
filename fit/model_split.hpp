#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fit/result.hpp"

namespace skinfit {

/// Two parameters between which the model divides one amount, where the spectrum does not say how it is divided.
struct ModelSplit {
    std::string_view first;
    std::string_view second;
    std::string_view use;  ///< the quantity of the tissue that does not depend on the division
    double correlation;    ///< of the two
};

/// Where both are adjusted, and either their correlation is -0.5 or below, so that the sum is known better than either;
/// or the prior says more of one than the spectrum (`ParameterUncertainty::decided_by_prior`); or one is not
/// identifiable: blood of the papillary and the reticular dermis, bilirubin in blood and outside it. Not of several
/// spectra with parameters of their own.
[[nodiscard]] std::vector<ModelSplit> model_splits(const FitResult& result);

/// Whether `parameter` is one of two such.
[[nodiscard]] bool is_split_by_model(const std::vector<ModelSplit>& splits, std::string_view parameter);

/// Each as a sentence of the reports.
[[nodiscard]] std::string in_words(const ModelSplit& split);

}  // namespace skinfit
