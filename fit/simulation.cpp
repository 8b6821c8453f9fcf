#include "fit/simulation.hpp"

#include <cmath>

#include "fit/prior.hpp"
#include "fit/wavelength_sets.hpp"

namespace skinfit {
namespace {

double drawn_value(const FreeParameter& free, ChainRandom& random) {
    const double share = random.uniform();
    if (free.prior) return quantile_within(*free.prior, free.bounds, share);
    return free.bounds.lower + share * (free.bounds.upper - free.bounds.lower);
}

}  // namespace

Spectrum blank_spectrum(const Configuration& configuration) {
    Spectrum spectrum{.name = "synthetic",
                      .source = "synthetic",
                      .wavelength_nm = parse_wavelengths(configuration.wavelengths, "wavelengths"),
                      .value = {},
                      .sigma = {},
                      .quantity = {},
                      .geometry = {},
                      .unit_rule = "fractions, as computed"};
    const auto count = static_cast<double>(spectrum.wavelength_nm.size());
    for (std::size_t i = 0; i < spectrum.wavelength_nm.size(); ++i) {
        spectrum.value.push_back(static_cast<double>(i) / count);
    }
    return spectrum;
}

std::vector<double> drawn_skin(const FitProblem& problem, ChainRandom& random) {
    Experiment experiment = problem.only().experiment;
    while (true) {
        std::vector<double> values;
        for (const FreeParameter& free : problem.free) {
            values.push_back(drawn_value(free, random));
            value_of(experiment.values, free.parameter) = values.back();
        }
        double log_share = 0.0;
        for (const DerivedPrior& derived : problem.derived_priors) {
            const double value = derived_value(derived.quantity, experiment.values);
            log_share += log_density(derived.prior, value).value;
        }
        if (random.uniform() < std::exp(log_share)) return values;
    }
}

}  // namespace skinfit
