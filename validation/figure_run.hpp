#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "measurements/spectrum.hpp"
#include "validation/colour_claims.hpp"
#include "validation/curve.hpp"
#include "validation/figure.hpp"
#include "validation/finding.hpp"

namespace skinfit {

/// How figures are computed.
struct FigureOptions {
    std::optional<std::uint64_t> rays;      ///< per wavelength of the walk, instead of the figure's own
    std::optional<std::uint64_t> seed;      ///< of the walk, instead of the figure's own
    std::filesystem::path shared_folder{};  ///< of measurements that are not shipped; empty: none
};

/// A panel under one variant: its curves, and what became of its claims.
struct VariantResult {
    FigureVariant variant;
    std::vector<SpectralCurve> spectra;   ///< one per series of a figure of spectra or extinctions, else none
    std::vector<RenderedColour> colours;  ///< of the spectra, where the panel or a claim asks for them
    std::vector<AngularCurve> lobes;      ///< one per series of a goniophotometer's figure, else none
    std::vector<ClaimFinding> findings;   ///< one per claim of the panel
};

/// A panel under all variants of its figure.
struct PanelResult {
    std::optional<Spectrum> measured;
    std::vector<VariantResult> variants;
};

/// A figure, computed.
struct FigureResult {
    Figure figure;
    std::vector<PanelResult> panels;    ///< one per panel of the figure
    std::vector<std::string> messages;  ///< what was left out, and why
};

/// Computes a figure; the result does not depend on the number of threads. Throws InputError as its parts do.
[[nodiscard]] FigureResult run_figure(const Figure& figure, const FigureOptions& options);

}  // namespace skinfit
