#include "study/cohort_simulation.hpp"

#include <tbb/parallel_for.h>
#include <xxhash.h>

#include <Eigen/Core>
#include <algorithm>
#include <iterator>
#include <span>

#include "fit/models.hpp"
#include "fit/noise_model.hpp"
#include "fit/objective.hpp"
#include "fit/simulation.hpp"
#include "study/transport_readings.hpp"

namespace skinfit {
namespace {

constexpr unsigned part_bits = 16;  // above the number of repeats

/// What is drawn for a subject, each from random numbers of its own; from `first_noise` the noise of each repeat.
enum Part : std::uint64_t { skin, departure, first_noise, scattering = (1U << part_bits) - 1 };

/// The random numbers of one part of one subject.
ChainRandom stream(const Cohort& cohort, const CohortGroup& group, std::uint64_t subject, std::uint64_t part) {
    const std::uint64_t of_group = XXH3_64bits(group.name.data(), group.name.size());
    return {cohort.configuration.seed ^ of_group, subject << part_bits | part};
}

Eigen::VectorXd normal_numbers(ChainRandom random, Eigen::Index count) {
    Eigen::VectorXd numbers(count);
    for (double& number : numbers) number = random.normal();
    return numbers;
}

/// The subjects of a group before they are measured.
std::vector<SimulatedSubject> drawn_subjects(const Cohort& cohort, std::size_t place, const FitProblem& problem) {
    const CohortGroup& group = cohort.groups[place];
    std::vector<SimulatedSubject> subjects(group.subjects);
    tbb::parallel_for(std::size_t{0}, subjects.size(), [&](std::size_t k) {
        const std::uint64_t number = k + 1;
        ChainRandom random = stream(cohort, group, number, skin);
        const std::vector<double> drawn = drawn_skin(problem, random);
        SimulatedSubject& subject = subjects[k];
        subject = {.group = place,
                   .number = number,
                   .values = group.configuration.values,
                   .scattering = {},
                   .noise_free = {},
                   .reading = {}};
        for (std::size_t i = 0; i < drawn.size(); ++i) {
            value_of(subject.values, problem.free[i].parameter) = drawn[i];
        }
        if (!cohort.transport) return;
        ChainRandom of_scattering = stream(cohort, group, number, scattering);
        subject.scattering = {
            .at_500_nm_per_cm = cohort.transport->scattering_at_500_nm_per_cm.drawn(of_scattering.uniform()),
            .power = cohort.transport->scattering_power.drawn(of_scattering.uniform())};
    });
    return subjects;
}

/// What an engine of the model reads of the subjects of a group.
void read_by_model(Engine engine, FitProblem problem, const DiskCache& cache, std::span<SimulatedSubject> subjects) {
    ++problem.only().walk.seed;  // recorded walks of a fit with the same seed are others
    const Objective objective(problem, make_models(problem, engine, cache));
    tbb::parallel_for(std::size_t{0}, subjects.size(), [&](std::size_t k) {
        std::vector<double> drawn;
        for (const FreeParameter& free : problem.free) drawn.push_back(value_of(subjects[k].values, free.parameter));
        const Eigen::VectorXd modelled = objective.readings(drawn);
        subjects[k].noise_free.assign(modelled.begin(), modelled.end());
    });
}

/// Adds departure and noise to what was read of each subject.
void measure(const Cohort& cohort, SimulatedCohort& simulated) {
    std::optional<Eigen::MatrixXd> root;
    if (cohort.configuration.discrepancy) {
        root = departure_root(simulated.wavelength_nm, *cohort.configuration.discrepancy);
    }
    const double noise = cohort.configuration.noise.value();
    tbb::parallel_for(std::size_t{0}, simulated.subjects.size(), [&](std::size_t k) {
        SimulatedSubject& subject = simulated.subjects[k];
        const CohortGroup& group = cohort.groups[subject.group];
        const auto count = static_cast<Eigen::Index>(subject.noise_free.size());
        Eigen::VectorXd real = Eigen::Map<const Eigen::VectorXd>(subject.noise_free.data(), count);
        if (root) real += *root * normal_numbers(stream(cohort, group, subject.number, departure), count);
        for (std::uint64_t repeat = 0; repeat < cohort.repeats; ++repeat) {
            const Eigen::VectorXd reading =
                real + noise * normal_numbers(stream(cohort, group, subject.number, first_noise + repeat), count);
            subject.reading.emplace_back(reading.begin(), reading.end());
        }
    });
}

}  // namespace

SimulatedCohort simulate(const Cohort& cohort, const DiskCache& cache, const SimulationWatch& watch) {
    SimulatedCohort simulated{.wavelength_nm = blank_spectrum(cohort.configuration).wavelength_nm, .subjects = {}};
    for (std::size_t place = 0; place < cohort.groups.size(); ++place) {
        const Configuration& configuration = cohort.groups[place].configuration;
        const FitProblem problem = make_problem(configuration, blank_spectrum(configuration));
        std::vector<SimulatedSubject> subjects = drawn_subjects(cohort, place, problem);
        if (!cohort.transport) read_by_model(configuration.engine, problem, cache, subjects);
        std::ranges::move(subjects, std::back_inserter(simulated.subjects));
    }
    if (cohort.transport) read_by_transport(cohort, simulated, watch);
    measure(cohort, simulated);
    return simulated;
}

}  // namespace skinfit
