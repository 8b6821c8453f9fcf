#include "study/transport_readings.hpp"

#include "fit/resolution.hpp"
#include "model/constants.hpp"
#include "transport/skin_spectra.hpp"

namespace skinfit {
namespace {

SkinTransportOptions options_of(const Cohort& cohort) {
    const ResolvedConfiguration how = resolved(cohort.configuration);
    Gathering gathering{.specular = how.specular};
    if (cohort.transport->port_diameter_mm) {
        constexpr double cm_per_mm = 0.1;
        gathering.port_radius_cm = 0.5 * cm_per_mm * *cohort.transport->port_diameter_mm;
        gathering.spot_radius_cm = gathering.port_radius_cm;
    }
    if (how.viewing_cone_deg) gathering.viewing_cone_rad = *how.viewing_cone_deg * rad_per_deg;
    // The error of the interpolation is far below that of the photons: tests/transport/skin_spectra.cpp.
    constexpr double node_ratio = 1.35;
    return {.incidence_rad = how.incidence_deg * rad_per_deg,
            .gatherings = {gathering},
            .photons = cohort.transport->photons,
            .seed = how.seed,
            .node_ratio = node_ratio};
}

}  // namespace

void read_by_transport(const Cohort& cohort, SimulatedCohort& simulated, const SimulationWatch& watch) {
    const SkinTransportOptions options = options_of(cohort);
    std::vector<LayeredSkin> skins;
    for (const SimulatedSubject& subject : simulated.subjects) {
        skins.push_back(layered_skin(subject.values.skin, *subject.scattering));
    }
    for (std::size_t done = 0; done < simulated.wavelength_nm.size(); ++done) {
        if (watch.progress) watch.progress(done);
        const SkinReadings readings = skin_spectra(skins, {simulated.wavelength_nm[done]}, options, watch.stop);
        for (std::size_t k = 0; k < skins.size(); ++k) {
            SimulatedSubject& subject = simulated.subjects[k];
            const Instrument& instrument = subject.values.instrument;
            subject.noise_free.push_back(instrument.scale * readings[k][0][0].value + instrument.offset);
        }
    }
}

}  // namespace skinfit
