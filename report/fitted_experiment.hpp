#pragma once

#include <cstddef>

#include "fit/result.hpp"
#include "model/spectrophotometer.hpp"

namespace skinfit {

/// The specimen and the instrument of spectrum `number` of `result`, counted from 0, with the fitted values.
[[nodiscard]] Experiment fitted_experiment(const FitResult& result, std::size_t number);

}  // namespace skinfit
