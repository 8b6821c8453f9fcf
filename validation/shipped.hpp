#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "measurements/spectrum.hpp"
#include "validation/figure.hpp"

namespace skinfit {

/// The figures of configs/, compiled into the program, by ascending number.
[[nodiscard]] std::vector<Figure> shipped_figures();

/// The spectrum of that name: a shipped specimen such as `ncsu_113.csv`, or `shared/...`, a file below
/// `shared_folder`; nothing where the latter is absent. Throws InputError for an unknown or malformed one.
[[nodiscard]] std::optional<Spectrum> measured_spectrum(const std::string& name,
                                                        const std::filesystem::path& shared_folder);

}  // namespace skinfit
