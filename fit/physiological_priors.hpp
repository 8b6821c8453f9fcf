#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "fit/configuration.hpp"

namespace skinfit {

/// What is known of a parameter of healthy skin or of a usual instrument.
struct PhysiologicalPrior {
    Parameter parameter;
    Prior prior;
    std::string_view source;
    std::optional<Bounds> healthy{};  ///< the range published for healthy skin, where there is one
};

/// What is known of a derived quantity.
struct PhysiologicalDerivedPrior {
    Derived quantity;
    Prior prior;
    std::string_view source;
};

/// The physiological set, meant to be weak: a published range becomes the median +/- one standard deviation, not two,
/// so that skin a decade outside it is unlikely but not excluded. Parameters that are not listed stay uniform.
[[nodiscard]] std::span<const PhysiologicalPrior> physiological_priors();
/// The row of `parameter`, if it is listed.
[[nodiscard]] std::optional<PhysiologicalPrior> known_of(Parameter parameter);
[[nodiscard]] std::span<const PhysiologicalDerivedPrior> physiological_derived_priors();

}  // namespace skinfit
