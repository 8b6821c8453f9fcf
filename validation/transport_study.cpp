#include "validation/transport_study.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <span>

#include "core/embedded_file.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/stop.hpp"
#include "fit/configuration_json.hpp"
#include "fit/fit.hpp"
#include "fit/json_reading.hpp"
#include "fit/model_cache.hpp"
#include "fit/simulation.hpp"
#include "fit/tissue.hpp"
#include "study/cohort_names.hpp"

namespace skinfit {

namespace cohort_files {
std::span<const EmbeddedFile> embedded_files();
}  // namespace cohort_files

namespace {

constexpr auto hemoglobin_place = static_cast<std::size_t>(SharedQuantity::dermal_hemoglobin_umol_per_l);

Json cohort_json(const std::string& name) {
    const std::string example = "configs/cohort_transport_natural.json, which comes with skinfit, is an example";
    for (const EmbeddedFile& file : cohort_files::embedded_files()) {
        if (file.name == fmt::format("cohort_transport_{}.json", name)) {
            return parsed_json(file.text, std::string(file.name), example);
        }
    }
    Json json = parsed_json(read_input(name), name, example);
    require_object(json, name, example);
    return json;
}

/// `groups` with `spectra` subjects in all; groups that get none are left out.
Json shared_out(const Json& groups, std::uint64_t spectra) {
    std::uint64_t all = 0;
    for (const Json& group : groups) all += group["subjects"].get<std::uint64_t>();
    Json shared = Json::array();
    std::uint64_t before = 0;
    std::uint64_t given = 0;
    for (Json group : groups) {
        before += group["subjects"].get<std::uint64_t>();
        const std::uint64_t until = before * spectra / all;
        if (until > given) {
            group["subjects"] = until - given;
            shared.push_back(group);
        }
        given = until;
    }
    return shared;
}

double truth_of(std::size_t place, const SimulatedSubject& subject) {
    if (place != hemoglobin_place)
        return value_of(subject.values, find_parameter(shared_quantity_names[place]).value());
    return find_tissue_quantity(shared_quantity_names[place])->value(subject.values.skin);
}

std::optional<TransportFit::Estimate> estimate_of(std::size_t place, const FitResult& result) {
    if (result.verdict == Verdict::failed) return std::nullopt;
    if (place == hemoglobin_place) {
        for (const TissueEstimate& estimate : tissue_estimates(result)) {
            if (estimate.quantity->name != shared_quantity_names[place]) continue;
            return TransportFit::Estimate{.value = estimate.value, .interval_95 = estimate.interval_95};
        }
        return std::nullopt;
    }
    const auto found = std::ranges::find(result.free, shared_quantity_names[place], &FittedParameter::name);
    if (found == result.free.end()) return std::nullopt;
    TransportFit::Estimate estimate{.value = found->value, .interval_95 = {}};
    if (found->uncertainty.status != Status::not_identifiable) estimate.interval_95 = found->uncertainty.interval_95;
    return estimate;
}

}  // namespace

Cohort transport_cohort(const std::string& name, std::optional<std::uint64_t> spectra) {
    Json json = cohort_json(name);
    const Cohort cohort = read_cohort(json, name);
    if (!cohort.transport) {
        throw InputError({.where = name,
                          .problem = "is no cohort by transport",
                          .why = "its spectra would be those of the model that is fitted",
                          .remedy = "give it an entry \"transport\"; see docs/studies.md"});
    }
    if (!spectra) return cohort;
    json["groups"] = shared_out(json["groups"], *spectra);
    return read_cohort(json, name);
}

Cohort measured_as(const Cohort& cohort, const Configuration& configuration, std::optional<double> port_diameter_mm) {
    Json json = cohort.resolved;
    const Json stated = to_json(configuration);
    for (const char* key : {"seed", "wavelengths", "noise"}) json[key] = stated[key];
    for (const std::string_view key : reading_settings()) json["model"][std::string(key)] = stated[std::string(key)];
    if (port_diameter_mm) json["transport"]["port_diameter_mm"] = *port_diameter_mm;
    return read_cohort(json, cohort.name);
}

TransportStudy fit_transport_skins(const Cohort& cohort, const SimulatedCohort& simulated,
                                   const Configuration& configuration, const DiskCache& cache,
                                   const RecoveryWatch& watch) {
    ModelCache shelf(cache);
    std::vector<std::optional<TransportFit>> fitted(simulated.subjects.size());
    std::atomic<std::uint64_t> done = 0;
    Spectrum blank = blank_spectrum(cohort.configuration);
    tbb::parallel_for(std::size_t{0}, fitted.size(), [&](std::size_t k) {
        if (watch.stop.stop_requested()) return;
        const SimulatedSubject& subject = simulated.subjects[k];
        Spectrum spectrum = blank;
        spectrum.value = subject.reading.front();
        try {
            const FitResult result = fit_spectrum(
                configuration, spectrum,
                {.cache = cache,
                 .models = [&shelf](const auto& problem, Engine engine) { return shelf.models(problem, engine); },
                 .watch = {.stop = watch.stop}});
            TransportFit fit{.name = fmt::format("{}_{:04}", cohort.groups[subject.group].name, subject.number),
                             .truth = {},
                             .estimate = {},
                             .verdict = result.verdict,
                             .measured = subject.reading.front()};
            for (std::size_t place = 0; place < shared_quantity_count; ++place) {
                fit.truth[place] = truth_of(place, subject);
                fit.estimate[place] = estimate_of(place, result);
            }
            fitted[k] = std::move(fit);
        } catch (const Cancelled&) {
            return;
        }
        ++done;
        if (watch.progress) watch.progress(done);
    });
    TransportStudy study{.cohort = cohort.name, .wavelength_nm = simulated.wavelength_nm, .fits = {}};
    for (std::optional<TransportFit>& fit : fitted) {
        if (fit) study.fits.push_back(std::move(*fit));
    }
    return study;
}

}  // namespace skinfit
