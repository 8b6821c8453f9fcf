#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "measurements/spectrum.hpp"

namespace skinfit {

/// A number computed from a reflectance spectrum without a model.
struct IndexInfo {
    std::string_view name;  ///< JSON key, CSV column and report row
    std::string_view unit;
    std::string_view meaning;
    std::string_view source;
};

/// All indices:
///   melanin_index = 100 log10(1 / R(655 nm)) [SHRIVER00]
///   erythema_index = 100 log10(R(655 nm) / R(568 nm)) [SHRIVER00]
///   individual_typology_angle_deg = arctan((L* - 50) / b*), D65, 2 degree observer [CHARDON91]
[[nodiscard]] std::span<const IndexInfo> index_table();

/// The value of an index and its standard deviation from the noise of the readings, to first order.
struct IndexValue {
    std::string_view name;  ///< as in `index_table`
    double value;
    double sigma;
};

/// The indices that a spectrum has, readings between its wavelengths interpolated; `noise` is the standard uncertainty
/// of a reading where the spectrum states none, fraction. A transmittance has none; a spectrum that does not reach 568
/// and 655 nm, or is not above zero there, lacks the first two; one that does not reach from 420 to 680 nm, or is
/// bluish (b* not above zero), the third.
[[nodiscard]] std::vector<IndexValue> indices_of(const Spectrum& spectrum, double noise);

}  // namespace skinfit
