#include "explore/fit_order.hpp"

#include <fmt/format.h>

#include "core/input_error.hpp"
#include "explore/measured_request.hpp"
#include "fit/fit.hpp"
#include "fit/inspection.hpp"
#include "fit/report.hpp"
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
        is_one ? "FILE" : "--joint FILE...",
        is_one ? "that file; --column picks the spectrum where it holds several"
               : "each of the files; --column picks the spectra where one holds several");
}

}  // namespace

FitOrder fit_order(const Json& json) {
    MeasuredRequest request = measured_request(json);
    if (request.spectra.empty()) {
        throw InputError({.where = request.source,
                          .problem = "there is no spectrum to fit",
                          .why = "\"measured\" lists none",
                          .remedy = "send at least one; see docs/explore.md"});
    }
    return {.configuration = fit_configuration(request),
            .source = std::move(request.source),
            .spectra = std::move(request.spectra)};
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
