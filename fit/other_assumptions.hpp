#pragma once

#include <optional>
#include <vector>

#include "fit/minimum.hpp"
#include "fit/result.hpp"

namespace skinfit {

/// Fits again under other assumptions that are as reasonable, one at a time, each from the answer `minimum` on:
///   scale free (log-normal about its value, 0.05), offset free (normal about its value, 0.005);
///   specular as the other of included and excluded, where only the default decides it;
///   hemoglobin of [PRAHL98] or of [BOSSCHAART14] alone;
///   melanin_slope 0, lateral_loss_per_cm 0, fibril_radius_nm 25 [KA04, Table 1], where these are free; where melanin's
///   slope and the loss are fixed, each free with the prior of preset skin;
///   bilirubin outside the vessels, where only that of the blood is free.
/// `result` holds the answer, whose parameters and intervals are described already; `models` are those of `objective`.
/// None of a joint fit and by the angular solver, where each would take as long as the fit; one that the model cannot
/// compute is left out. Throws Cancelled.
[[nodiscard]] std::optional<OtherAssumptions> try_other_assumptions(const FitResult& result, const Objective& objective,
                                                                    const std::vector<ForwardModel>& models,
                                                                    const Minimum& minimum);

/// The answers that move out of their intervals under an alternative that predicts bands left out clearly better than
/// the fit itself, with an error smaller by a fifth or more: places in `OtherAssumptions::answers`.
[[nodiscard]] std::vector<std::size_t> answers_moved(const OtherAssumptions& assumptions,
                                                     const OtherAssumptions::Alternative& alternative);

}  // namespace skinfit
