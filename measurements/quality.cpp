#include "measurements/quality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "core/input_error.hpp"
#include "measurements/quality_checks.hpp"

namespace skinfit {

std::vector<Finding> quality_findings(std::span<const Spectrum> spectra, const ModelledRange& modelled) {
    constexpr std::array checks = {
        unit_conflict,   outside_0_1, offset,     dark_everywhere, missing_values,       spikes,
        collapse_at_end, falling_end, saturation, no_haemoglobin,  noise_against_repeats};
    std::vector<Finding> findings;
    for (const Spectrum& spectrum : spectra) {
        for (const auto check : checks) {
            if (std::optional<Finding> finding = check(spectrum)) findings.push_back(std::move(*finding));
        }
        if (std::optional<Finding> finding = outside_tables(spectrum, modelled)) {
            findings.push_back(std::move(*finding));
        }
    }
    std::ranges::move(duplicates(spectra), std::back_inserter(findings));
    std::ranges::move(reflectance_plus_transmittance(spectra), std::back_inserter(findings));
    return findings;
}

std::vector<Finding> findings_on(std::string_view name, const std::vector<Finding>& findings) {
    std::vector<Finding> chosen;
    std::ranges::copy_if(findings, std::back_inserter(chosen),
                         [&](const Finding& finding) { return finding.spectrum == name; });
    return chosen;
}

std::string_view name_of(Severity severity) {
    return severity == Severity::note ? "note" : "warning";
}

void refuse_findings(const std::vector<Finding>& findings, const std::string& source) {
    if (findings.empty()) return;
    const Finding& first = findings.front();
    const std::string others = findings.size() == 1 ? "" : fmt::format(", first of {} findings", findings.size());
    throw InputError({.where = fmt::format("{}: {}", source, first.spectrum),
                      .problem = fmt::format("{}: {}", first.name, first.message),
                      .why = fmt::format("--strict makes findings errors{}", others),
                      .remedy = first.remedy});
}

}  // namespace skinfit
