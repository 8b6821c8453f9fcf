#include "explore/fit_order.hpp"

#include "explore/configuration_request.hpp"
#include "fit/file_settings.hpp"
#include "fit/fit.hpp"
#include "fit/inspection.hpp"
#include "fit/report.hpp"
#include "measurements/spectrum_file.hpp"

namespace skinfit {

FitOrder fit_order(const Json& request) {
    const Json named = request.value("source", Json());
    const std::string source = named.is_string() ? named.get<std::string>() : "measured";
    const Json measured = {{"spectra", request.value("measured", Json::array())}};
    const std::string text = measured.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::vector<Spectrum> spectra = parse_spectra(text, source, {}, "json").spectra;
    const Json stated = request.value("configuration", Json::object());
    Configuration configuration = requested_configuration(with_file_settings(explore_configuration(), spectra), stated);
    return {.configuration = std::move(configuration), .spectra = std::move(spectra)};
}

Json fitted_documents(const FitOrder& order, const EnsembleCache& cache, const FitWatch& watch) {
    const FitResult result = fit_spectra(
        order.configuration, order.spectra,
        {.cache = cache, .findings = findings_before_fit(order.configuration, order.spectra), .watch = watch});
    return {{"report", json_report(result)}, {"text", text_report(result)}};
}

}  // namespace skinfit
