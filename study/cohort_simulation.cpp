#include "study/cohort_simulation.hpp"

#include <tbb/parallel_for.h>
#include <xxhash.h>

#include <Eigen/Core>

#include "fit/models.hpp"
#include "fit/noise_model.hpp"
#include "fit/objective.hpp"
#include "fit/simulation.hpp"

namespace skinfit {
namespace {

/// What is drawn for a subject, each from random numbers of its own; from `first_noise` the noise of each repeat.
enum Part : std::uint64_t { skin, departure, first_noise };

/// The random numbers of one part of one subject.
ChainRandom stream(const Cohort& cohort, const CohortGroup& group, std::uint64_t subject, std::uint64_t part) {
    constexpr unsigned part_bits = 16;  // above the number of repeats
    const std::uint64_t of_group = XXH3_64bits(group.name.data(), group.name.size());
    return {cohort.configuration.seed ^ of_group, subject << part_bits | part};
}

Eigen::VectorXd normal_numbers(ChainRandom random, Eigen::Index count) {
    Eigen::VectorXd numbers(count);
    for (double& number : numbers) number = random.normal();
    return numbers;
}

/// What the subjects of a group have in common.
struct Survey {
    const Cohort& cohort;
    const CohortGroup& group;
    const FitProblem& problem;
    const Objective& objective;
    const std::optional<Eigen::MatrixXd>& departure_root;
};

SimulatedSubject measured(const Survey& survey, std::size_t group, std::uint64_t number) {
    ChainRandom skin_random = stream(survey.cohort, survey.group, number, skin);
    const std::vector<double> drawn = drawn_skin(survey.problem, skin_random);
    SimulatedSubject subject{.group = group,
                             .number = number,
                             .values = survey.objective.models().front().at(drawn).values,
                             .noise_free = {},
                             .reading = {}};
    const Eigen::VectorXd modelled = survey.objective.readings(drawn);
    subject.noise_free.assign(modelled.begin(), modelled.end());
    Eigen::VectorXd real = modelled;
    if (survey.departure_root) {
        real += *survey.departure_root *
                normal_numbers(stream(survey.cohort, survey.group, number, departure), real.size());
    }
    for (std::uint64_t repeat = 0; repeat < survey.cohort.repeats; ++repeat) {
        const Eigen::VectorXd reading =
            real + survey.cohort.configuration.noise.value() *
                       normal_numbers(stream(survey.cohort, survey.group, number, first_noise + repeat), real.size());
        subject.reading.emplace_back(reading.begin(), reading.end());
    }
    return subject;
}

}  // namespace

SimulatedCohort simulate(const Cohort& cohort, const DiskCache& cache) {
    SimulatedCohort simulated{.wavelength_nm = blank_spectrum(cohort.configuration).wavelength_nm, .subjects = {}};
    std::optional<Eigen::MatrixXd> root;
    if (cohort.configuration.discrepancy) {
        root = departure_root(simulated.wavelength_nm, *cohort.configuration.discrepancy);
    }
    for (std::size_t place = 0; place < cohort.groups.size(); ++place) {
        const CohortGroup& group = cohort.groups[place];
        const Configuration& configuration = group.configuration;
        FitProblem problem = make_problem(configuration, blank_spectrum(configuration));
        ++problem.only().walk.seed;  // recorded walks of a fit with the same seed are others
        const Objective objective(problem, make_models(problem, configuration.engine, cache));
        const Survey survey{cohort, group, problem, objective, root};
        const std::size_t before = simulated.subjects.size();
        simulated.subjects.resize(before + group.subjects);
        tbb::parallel_for(std::size_t{0}, static_cast<std::size_t>(group.subjects),
                          [&](std::size_t k) { simulated.subjects[before + k] = measured(survey, place, k + 1); });
    }
    return simulated;
}

}  // namespace skinfit
