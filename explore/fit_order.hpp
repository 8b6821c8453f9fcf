#pragma once

#include <string>
#include <vector>

#include "fit/configuration.hpp"
#include "fit/fit_watch.hpp"
#include "fit/result.hpp"
#include "fit/settings.hpp"
#include "measurements/spectrum.hpp"
#include "model/disk_cache.hpp"

namespace skinfit {

/// A fit as a page asks for it.
struct FitOrder {
    Configuration configuration;
    std::string source;             ///< the files of the spectra, as the page names them
    std::vector<Spectrum> spectra;  ///< at least one, explained together
};

/// The order in `json`, a `MeasuredRequest`. Throws InputError as `fit_configuration`, and where nothing is measured.
[[nodiscard]] FitOrder fit_order(const Json& json);

/// The order, carried out.
[[nodiscard]] FitResult fitted(const FitOrder& order, const DiskCache& cache, const FitWatch& watch);

/// The documents of a result that the page has at once, and offers for download: "report" is `json_report`, "text"
/// `text_report`.
[[nodiscard]] Json fitted_documents(const FitResult& result);

/// The document of a result that takes a second to draw: `html_report`, which says how a command repeats the fit.
/// Throws InputError when gnuplot is missing or fails.
[[nodiscard]] std::string fitted_page(const FitOrder& order, const FitResult& result);

}  // namespace skinfit
