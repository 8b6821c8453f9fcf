#include "explore/fit_order.hpp"

#include <fmt/format.h>

#include "explore/configuration_request.hpp"
#include "fit/file_settings.hpp"
#include "fit/fit.hpp"
#include "fit/inspection.hpp"
#include "fit/report.hpp"
#include "measurements/spectrum_file.hpp"
#include "report/fit_report.hpp"

namespace skinfit {
namespace {

/// What the program knows of the fit's origin: the page has sent spectra and the names of their files, no more.
std::string origin_in_words(const FitOrder& order) {
    const bool is_one = order.spectra.size() == 1;
    return fmt::format(
        "skinfit explore, to which a page sent {} of {}. A command repeats it: skinfit fit {} --config result.json, "
        "where result.json is the block below and FILE {}",
        is_one ? "a spectrum" : fmt::format("{} spectra", order.spectra.size()), order.source,
        is_one ? "FILE" : "FILE...",
        is_one ? "that file; --column picks the spectrum where it holds several"
               : "each of the files; --column picks the spectra where one holds several");
}

}  // namespace

FitOrder fit_order(const Json& request) {
    const Json named = request.value("source", Json());
    const std::string source = named.is_string() ? named.get<std::string>() : "measured";
    const Configuration configuration =
        requested_configuration(explore_configuration(), request.value("configuration", Json::object()));
    const Json measured = {{"spectra", request.value("measured", Json::array())}};
    const std::string text = measured.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::vector<Spectrum> spectra = parse_spectra(text, source, {.window = window_of(configuration)}, "json").spectra;
    return {
        .configuration = with_file_settings(configuration, spectra), .source = source, .spectra = std::move(spectra)};
}

FitResult fitted(const FitOrder& order, const DiskCache& cache, const FitWatch& watch) {
    const FitInput input = fit_input(order.configuration, order.spectra);
    return fit_spectra(input, {.cache = cache, .findings = findings_before_fit(input), .watch = watch});
}

Json fitted_documents(const FitResult& result) {
    return {{"report", json_report(result)}, {"text", text_report(result)}};
}

std::string fitted_page(const FitOrder& order, const FitResult& result) {
    return html_report(result, {.command_line = "", .other = origin_in_words(order)});
}

}  // namespace skinfit
