#pragma once

#include <optional>

#include "fit/identifiability.hpp"
#include "fit/minimum.hpp"
#include "fit/posterior.hpp"
#include "fit/profile.hpp"
#include "fit/uncertainty.hpp"

namespace skinfit {

/// What is known of the free parameters after a fit.
struct Inference {
    Minimum minimum;  ///< as given, or a better one that profiling has met
    Uncertainty uncertainty;
    Identifiability identifiability;
    std::optional<Profile> profile;      ///< in values; where asked for
    std::optional<Posterior> posterior;  ///< in values; where asked for
};

/// Uncertainty at `minimum` by `method`. Sigmas and correlations are those of `estimate_uncertainty`; intervals come
/// from `method`, and with them what is not identifiable: by profile a parameter that may lie at either bound, by
/// posterior one without a prior whose variance is more than half of what it was without the spectrum.
[[nodiscard]] Inference infer(const Objective& objective, const Minimum& minimum, UncertaintyMethod method,
                              std::uint64_t seed);

/// Draws as CSV: a column per free parameter (`names`), chain and draw in front; chains one after the other.
[[nodiscard]] std::string samples_csv(const Posterior& posterior, const std::vector<std::string>& names);

}  // namespace skinfit
