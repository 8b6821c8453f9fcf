#include "measurements/quality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <iterator>

#include "core/input_error.hpp"
#include "measurements/quality_checks.hpp"

namespace skinfit {

std::vector<Finding> quality_findings(std::span<const Spectrum> spectra, const ModelledRange& modelled) {
    std::vector<Finding> findings;
    for (const Spectrum& spectrum : spectra) {
        if (spectrum.value.empty()) continue;
        for (const SpectrumCheck& each : spectrum_checks) {
            if (std::optional<Finding> finding = each.check(spectrum)) findings.push_back(std::move(*finding));
        }
        if (std::optional<Finding> finding = outside_tables(spectrum, modelled)) {
            findings.push_back(std::move(*finding));
        }
    }
    std::ranges::move(duplicates(spectra), std::back_inserter(findings));
    std::ranges::move(reflectance_plus_transmittance(spectra), std::back_inserter(findings));
    assert(std::ranges::all_of(findings, [](const Finding& finding) {
        return std::ranges::find(quality_check_names, finding.name) != quality_check_names.end();
    }));
    return findings;
}

std::string_view name_of(Severity severity) {
    return severity == Severity::note ? "note" : "warning";
}

void refuse_warnings(const std::vector<Finding>& findings, const std::string& source) {
    const auto is_warning = [](const Finding& finding) { return finding.severity == Severity::warning; };
    const auto first = std::ranges::find_if(findings, is_warning);
    if (first == findings.end()) return;
    const auto count = std::ranges::count_if(findings, is_warning);
    throw InputError(
        {.where = fmt::format("{}: {}", source, first->spectrum),
         .problem = fmt::format("{}: {}", first->name, first->message),
         .why = fmt::format("--strict makes it an error{}", count == 1 ? "" : fmt::format(", the first of {}", count)),
         .remedy = first->remedy});
}

}  // namespace skinfit
