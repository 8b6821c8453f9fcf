#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace skinfit {

/// What the name of a column of uncertainties says.
struct UncertaintyName {
    std::string base{};  ///< the column it belongs to, as `plain_base` writes its name; empty where it names none
    /// Of several about one column the lowest is used: 0 sigma, u, uncertainty; 1 a standard error; 2 a standard
    /// deviation of single readings; 3 an error.
    int rank = 0;
    bool is_standard = true;  ///< false for expanded and relative ones, variances
};

/// Reads `sigma`, `R_sd`, `u(R)`, `reflectance_se`, `std. dev.`, `SD of R`, `+/- R` and the like; nothing for other
/// names. Not standard are `U`, `2 sigma`, `uncertainty (k=2)`, `95% CI`, `R_var`, `RSD`.
[[nodiscard]] std::optional<UncertaintyName> uncertainty_named(std::string_view name);

/// Reads `sigmaR`, `stdR` and, of a reflectance R or transmittance T, `uR` and `dR`, where `base` is the column R.
[[nodiscard]] std::optional<UncertaintyName> uncertainty_glued_to(std::string_view base, std::string_view name);

/// A column's name without case, marks, units and the word mean, to compare with `UncertaintyName::base`.
[[nodiscard]] std::string plain_base(std::string_view name);

}  // namespace skinfit
