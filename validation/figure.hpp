#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fit/configuration.hpp"
#include "fit/settings.hpp"
#include "validation/claim.hpp"

namespace skinfit {

/// The light a goniophotometer's panel shows.
enum class FigureLight { reflected, subsurface, transmitted };

/// A reading of the paper: every figure is computed for each of its own.
struct FigureVariant {
    Edition edition = Edition::revised;
    double fibril_radius_nm = 25.0;
};

/// One curve.
struct FigureSeries {
    std::string name;             ///< for legends and tables
    Configuration configuration;  ///< complete but for the variant
};

/// One plot, and what is claimed about it.
struct FigurePanel {
    std::string title;
    FigureLight light = FigureLight::reflected;  ///< of a goniophotometer
    bool has_swatches = false;                   ///< of a spectrum: rendered colours are shown too
    std::vector<FigureSeries> series;            ///< at least one, in the order the claims speak of
    std::optional<std::string> measured;         ///< a shipped file, or one below `shared/`
    std::vector<Claim> claims;                   ///< may be none
};

/// A figure of the paper, as configs/figure_*.json describe it.
struct Figure {
    int number = 0;
    std::string title;
    std::string shows;  ///< what the paper shows there
    FigureKind kind = FigureKind::spectrum;
    std::vector<FigureVariant> variants;  ///< at least one
    std::vector<FigurePanel> panels;      ///< at least one
    Json sources;                         ///< of every value set: the paper's or chosen
};

/// Reads a figure from JSON text, comments allowed. `configuration` in the figure, in a panel and in a series hold the
/// settings of a fit's configuration, each over the one before. Throws InputError for anything unknown, naming the
/// closest known name; for a claim that the panel cannot be judged by; and for a value without a source.
[[nodiscard]] Figure parse_figure(std::string_view text, const std::string& where);

/// The JSON Schema (draft 7) of a figure.
[[nodiscard]] Json figure_schema();

}  // namespace skinfit
