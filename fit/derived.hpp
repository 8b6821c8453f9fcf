#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "model/parameters.hpp"

namespace skinfit {

/// Quantities computed from parameters, on which a prior may be put.
enum class Derived : std::size_t { total_blood_fraction, pheomelanin_eumelanin_ratio };
inline constexpr std::size_t derived_count = 2;

/// The name of a derived quantity, and what it is.
struct DerivedInfo {
    std::string_view name;  ///< JSON key and report row
    std::string_view meaning;
};

/// All derived quantities, in the order of `Derived`.
[[nodiscard]] std::span<const DerivedInfo, derived_count> derived_table();

/// The quantity at `values`:
///   total_blood_fraction: volume fraction of blood in the whole dermis, the mean of the papillary and the reticular
///   fraction weighted by the thickness of their layers;
///   pheomelanin_eumelanin_ratio: by mass, in a melanosome.
[[nodiscard]] double derived_value(Derived quantity, const ParameterValues& values);

/// Whether the quantity is computed from `parameter`.
[[nodiscard]] bool depends_on(Derived quantity, Parameter parameter);

/// The derivative of the quantity by `parameter`; zero where it does not depend on it.
[[nodiscard]] double derived_slope(Derived quantity, const ParameterValues& values, Parameter parameter);

}  // namespace skinfit
