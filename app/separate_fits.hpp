#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "fit/result.hpp"

/// Several spectra, each fitted by itself.
namespace skinfit {

/// What became of one of them.
struct SeparateFit {
    std::string file;
    std::optional<FitResult> result;
    std::string problem;  ///< why there is no result
};

/// A table for people, a row each, and below it the reasons of doubt.
[[nodiscard]] std::string separate_fits_text(std::span<const SeparateFit> fits);

/// A list for programs: of each the report of its fit, or its file and error.
[[nodiscard]] Json separate_fits_json(std::span<const SeparateFit> fits);

/// The worst of what each alone would end with.
[[nodiscard]] int exit_code_of(std::span<const SeparateFit> fits);

}  // namespace skinfit
