#include "app/transport_watch.hpp"

#include <fmt/format.h>

#include "fit/wavelength_sets.hpp"

namespace skinfit {

SimulationWatch transport_watch(const Cohort& cohort, Session& session, ProgressLine& line) {
    const std::size_t total = parse_wavelengths(cohort.configuration.wavelengths, "wavelengths").size();
    return {
        .stop = session.stop_on_interrupt(""), .progress = [&line, total](std::size_t done) {
            line.show(
                {.what = fmt::format("tracing photons, {}/{} wavelengths", done, total), .done = done, .total = total});
        }};
}

}  // namespace skinfit
