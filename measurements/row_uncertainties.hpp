#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measurements/spectrum.hpp"
#include "measurements/unit_rule.hpp"

namespace skinfit {

/// One spectrum of a table of rows: without numbers, and these in the order of the file.
struct ReadRow {
    Spectrum spectrum;
    std::size_t block = 0;         ///< of the header
    std::vector<double> values{};  ///< NaN where one is missing
    std::vector<double> sigma{};   ///< empty where not given
    std::optional<Unit> unit{};    ///< that its labels state
    std::string told_apart{};      ///< what its labels state of quantity and specular
    std::string statistic{};       ///< what a label says the row is: `mean`, `sd`
};

/// True for the name of a label such as `stat`, which says whether a row is a mean or an uncertainty.
[[nodiscard]] bool names_statistics(std::string_view label);

/// Takes the rows of uncertainties out of `rows` and gives them to those they belong to: to the row that their name
/// names, as `forearm_sd` beside `forearm`; to the row of the same name where a label says that they are some; or,
/// called `sd` alone, to the row before that is called a mean, a reflectance or a transmittance, or is the only one.
/// Those that are no standard uncertainties are left out with a remark.
void take_uncertainty_rows(std::vector<ReadRow>& rows);

}  // namespace skinfit
