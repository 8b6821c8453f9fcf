#pragma once

#include <string>
#include <vector>

#include "fit/configuration.hpp"
#include "fit/fit_watch.hpp"
#include "fit/settings.hpp"
#include "measurements/spectrum.hpp"
#include "model/ensemble_cache.hpp"

namespace skinfit {

/// A fit as a page asks for it.
struct FitOrder {
    Configuration configuration;
    std::vector<Spectrum> spectra;  ///< at least one, explained together
};

/// The order in {"configuration": {...}, "source": name, "measured": [spectra of `spectra_json`]}. What the spectra
/// state of edition, layers and base holds where the configuration does not state it. Throws InputError.
[[nodiscard]] FitOrder fit_order(const Json& request);

/// The order, carried out: the documents made of its result, each of which the page offers for download. "report" is
/// `json_report`, "text" `text_report`. A report of another form is added here, under the ending of its files.
[[nodiscard]] Json fitted_documents(const FitOrder& order, const EnsembleCache& cache, const FitWatch& watch);

}  // namespace skinfit
