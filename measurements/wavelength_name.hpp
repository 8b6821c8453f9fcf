#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace skinfit {

/// The name of a column that a wavelength stands in, taken apart: of `R_400nm_SCI` these are 400, `nm`, `R SCI`.
struct WavelengthName {
    double number;
    std::string unit;   ///< empty, `nm`, `um`, `cm-1`, `1/cm`, `thz`, `ev`
    std::string about;  ///< what the name says about the values, such as `R`, `SCI`, `sd`, `R_sd`, `%`, or nothing
};

/// Reads `360`, `360 nm`, `nm360`, `SPEC_360`, `X360`, `WL360`, `R_360nm`, `sd_360`, `360 nm [%]`; nothing for names in
/// which other words stand, as `subject 401`. `decimal_comma` allows `360,5`.
[[nodiscard]] std::optional<WavelengthName> wavelength_named(std::string_view name, bool decimal_comma);

}  // namespace skinfit
