#include "bench/work.hpp"

#include "fit/fit_scale.hpp"
#include "fit/multistart.hpp"
#include "fit/nuts.hpp"
#include "model/spectrophotometer.hpp"

namespace skinfit {
namespace {

constexpr double noise = 0.003;

Spectrum read(const Experiment& experiment, const std::vector<double>& wavelengths_nm) {
    Spectrum spectrum;
    spectrum.name = spectrum.source = "synthetic";
    spectrum.wavelength_nm = wavelengths_nm;
    for (const Reading& reading : read_by_solver(experiment, wavelengths_nm)) {
        spectrum.value.push_back(reading.reflectance);
    }
    return spectrum;
}

}  // namespace

BenchWork bench_work(std::size_t count, std::uint64_t rays) {
    Configuration configuration = default_configuration();
    configuration.incidence_deg = 45;
    configuration.noise = noise;
    configuration.rays = rays;
    std::vector<double> wavelengths_nm;
    for (int i = 0; i <= 30; ++i) wavelengths_nm.push_back(400 + 10 * i);
    const Spectrum table_1 = read(make_experiment(configuration), wavelengths_nm);
    configuration = as_stated(resolved(configuration, table_1));
    BenchWork work{
        .configuration = configuration,
        .problem = make_problem(configuration, table_1),
        .spectra = Eigen::MatrixXd(static_cast<Eigen::Index>(wavelengths_nm.size()), static_cast<Eigen::Index>(count))};
    const auto points = spread_points(count, work.problem.free.size(), configuration.seed);
    for (std::size_t i = 0; i < count; ++i) {
        Experiment experiment = work.problem.only().experiment;
        const std::vector<double> values = from_unit_box(work.problem, points[i]);
        for (std::size_t j = 0; j < values.size(); ++j) {
            value_of(experiment.values, work.problem.free[j].parameter) = values[j];
        }
        ChainRandom random(configuration.seed, i);
        const Spectrum spectrum = read(experiment, wavelengths_nm);
        for (std::size_t row = 0; row < spectrum.value.size(); ++row) {
            work.spectra(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(i)) =
                spectrum.value[row] + noise * random.normal();
        }
    }
    return work;
}

FitProblem problem_of(const BenchWork& work, Eigen::Index number) {
    FitProblem problem = work.problem;
    const auto measured = work.spectra.col(number);
    problem.only().measured.assign(measured.begin(), measured.end());
    return problem;
}

}  // namespace skinfit
