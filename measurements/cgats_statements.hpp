#pragma once

#include <span>
#include <string>

#include "measurements/cgats_bands.hpp"
#include "measurements/cgats_table.hpp"
#include "measurements/spectrum.hpp"

namespace skinfit {

/// Throws InputError where keywords of the table, such as MEAS_TYPE, say that its values are no shares of light.
void refuse_other_quantities(const CgatsTable& table, const std::string& source);

/// A spectrum without numbers of which the keywords of the table, the names of the fields `bands` and the labels among
/// `cells`, those of one set, say this: name (empty where there is none), line, quantity, geometry, instrument, notes.
[[nodiscard]] Spectrum cgats_statements(const CgatsTable& table, const CgatsBands& bands,
                                        std::span<const CgatsToken> cells);

}  // namespace skinfit
