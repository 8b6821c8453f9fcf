#include "study/manifest.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/version.hpp"
#include "fit/measurement.hpp"

namespace skinfit {
namespace {

std::string subject_name(const Cohort& cohort, const SimulatedSubject& subject) {
    return fmt::format("{}_{:04}", cohort.groups[subject.group].name, subject.number);
}

/// `repeat` is counted from 1.
std::string spectrum_name(const Cohort& cohort, const SimulatedSubject& subject, std::size_t repeat) {
    const std::string name = subject_name(cohort, subject);
    return cohort.repeats == 1 ? name : fmt::format("{}_{}", name, repeat);
}

/// As the row reader understands it.
std::string description(const Cohort& cohort) {
    const ResolvedConfiguration complete = resolved(cohort.configuration);
    std::string text = fmt::format("# skinfit {} simulated cohort {}\n", version, cohort.name);
    const auto put = [&text](std::string_view key, const auto& value) {
        text += fmt::format("# {}: {}\n", key, value);
    };
    put("quantity", quantity_names[static_cast<std::size_t>(complete.quantity)]);
    put("unit", "fraction");
    if (cohort.transport && cohort.transport->port_diameter_mm) put("aperture_mm", *cohort.transport->port_diameter_mm);
    put("incidence_deg", complete.incidence_deg);
    put("specular", specular_names[static_cast<std::size_t>(complete.specular)]);
    if (complete.viewing_cone_deg) put("viewing_cone_deg", *complete.viewing_cone_deg);
    if (const std::optional<Bandpass> band = bandpass_of(complete)) {
        put("bandpass_shape", bandpass_shape_names[static_cast<std::size_t>(band->shape)]);
        put("bandpass_width_nm", band->width_nm);
    }
    return text;
}

}  // namespace

std::vector<std::string> manifest_columns(const Cohort& cohort) {
    std::vector<std::string> columns = {"file", "spectrum", "subject", "repeat", "group"};
    columns.insert(columns.end(), cohort.metadata_names.begin(), cohort.metadata_names.end());
    for (const CohortLabel& label : cohort.labels) columns.push_back(label.name);
    for (const Parameter parameter : varying_parameters(cohort)) {
        columns.push_back(fmt::format("true_{}", info(parameter).name));
    }
    if (cohort.transport && cohort.transport->scattering_at_500_nm_per_cm.varies()) {
        columns.emplace_back("true_scattering_at_500_nm_per_cm");
    }
    if (cohort.transport && cohort.transport->scattering_power.varies()) {
        columns.emplace_back("true_scattering_power");
    }
    return columns;
}

std::string manifest_csv(const Cohort& cohort, const SimulatedCohort& simulated) {
    const std::vector<Parameter> varying = varying_parameters(cohort);
    std::string text = fmt::format("{}\n", fmt::join(manifest_columns(cohort), ","));
    for (const SimulatedSubject& subject : simulated.subjects) {
        const CohortGroup& group = cohort.groups[subject.group];
        std::string truth = group.name;
        for (const std::string& cell : group.metadata) truth += "," + cell;
        for (const CohortLabel& label : cohort.labels) truth += label.holds(subject.values) ? ",yes" : ",no";
        for (const Parameter parameter : varying) truth += fmt::format(",{}", value_of(subject.values, parameter));
        if (cohort.transport && cohort.transport->scattering_at_500_nm_per_cm.varies()) {
            truth += fmt::format(",{}", subject.scattering->at_500_nm_per_cm);
        }
        if (cohort.transport && cohort.transport->scattering_power.varies()) {
            truth += fmt::format(",{}", subject.scattering->power);
        }
        for (std::size_t repeat = 1; repeat <= subject.reading.size(); ++repeat) {
            text += fmt::format("{},{},{},{},{}\n", spectra_file, spectrum_name(cohort, subject, repeat),
                                subject_name(cohort, subject), repeat, truth);
        }
    }
    return text;
}

std::string cohort_spectra_csv(const Cohort& cohort, const SimulatedCohort& simulated) {
    std::string text = description(cohort);
    text += fmt::format("id,{}\n", fmt::join(simulated.wavelength_nm, ","));
    for (const SimulatedSubject& subject : simulated.subjects) {
        for (std::size_t repeat = 1; repeat <= subject.reading.size(); ++repeat) {
            text += fmt::format("{},{}\n", spectrum_name(cohort, subject, repeat),
                                fmt::join(subject.reading[repeat - 1], ","));
        }
    }
    return text;
}

}  // namespace skinfit
