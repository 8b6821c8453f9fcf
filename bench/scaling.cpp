#include "bench/scaling.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "bench/stopwatch.hpp"
#include "bench/threads.hpp"
#include "bench/work.hpp"
#include "core/file.hpp"
#include "fit/bulk.hpp"
#include "fit/emulation.hpp"
#include "fit/misfit_description.hpp"

namespace skinfit {
namespace {

constexpr std::uint64_t table_1_rays = 100'000;
const char* const time_label = "log10 of processor time in s";

/// The median processor time of a call, log10 s.
double cost(const std::function<void()>& call) {
    constexpr int runs = 5;
    std::vector<double> times_s;
    for (int run = 0; run < runs; ++run) {
        const Stopwatch watch;
        call();
        times_s.push_back(watch.elapsed().cpu_s);
    }
    return std::log10(median(times_s));
}

void add(PlotLine& line, double x, double y) {
    line.x.push_back(x);
    line.y.push_back(y);
}

FitProblem problem_with(const Configuration& configuration, const std::vector<double>& wavelengths_nm) {
    Spectrum spectrum;
    spectrum.name = spectrum.source = "synthetic";
    spectrum.wavelength_nm = wavelengths_nm;
    for (const Reading& reading : read_by_solver(make_experiment(configuration), wavelengths_nm)) {
        spectrum.value.push_back(reading.reflectance);
    }
    return make_problem(resolved(configuration, spectrum), spectrum);
}

/// One evaluation with all derivatives by each engine.
struct EngineLines {
    PlotLine paths{.label = "recorded paths, 100 000 rays", .x = {}, .y = {}};
    PlotLine solver{.label = "angular solver", .x = {}, .y = {}};
    PlotLine emulator{.label = "emulator", .x = {}, .y = {}};

    void measure(const FitProblem& problem, double x) {
        const std::vector<double> at = starts(problem);
        const auto evaluation = [&](const ForwardModel& model) {
            const Objective objective(problem, model);
            return cost([&] { (void)objective.misfit(at); });
        };
        add(paths, x, evaluation(recorded(problem)));
        add(solver, x, evaluation(angular_solver(problem.only().experiment)));
        add(emulator, x, evaluation(Emulator::build(emulator_domain(problem))));
    }
};

ScalingPlot against_spectra() {
    const BenchWork work = bench_work(100, table_1_rays);
    const Emulator emulator = Emulator::build(emulator_domain(work.problem));
    PlotLine all{.label = "bulk, all spectra", .x = {}, .y = {}};
    PlotLine each{.label = "bulk, one spectrum", .x = {}, .y = {}};
    for (const Eigen::Index count : {1, 10, 100, 1000}) {
        Eigen::MatrixXd spectra(work.spectra.rows(), count);
        for (Eigen::Index i = 0; i < count; ++i) spectra.col(i) = work.spectra.col(i % work.spectra.cols());
        const double time = cost([&] { (void)fit_in_bulk(work.problem, emulator, spectra); });
        const double size = std::log10(static_cast<double>(count));
        add(all, size, time);
        add(each, size, time - size);
    }
    return {.name = "spectra",
            .plot = {.title = "Fits in bulk: 31 wavelengths, five free pigments",
                     .x_label = "log10 of the number of spectra",
                     .y_label = time_label,
                     .lines = {all, each}}};
}

ScalingPlot against_wavelengths() {
    const BenchWork work = bench_work(1, table_1_rays);
    EngineLines lines;
    for (const int count : {7, 16, 31, 61, 121}) {
        const Eigen::VectorXd even_nm = Eigen::VectorXd::LinSpaced(count, 400, 700);
        const std::vector<double> wavelengths_nm(even_nm.begin(), even_nm.end());
        lines.measure(problem_with(work.configuration, wavelengths_nm), std::log10(count));
    }
    return {.name = "wavelengths",
            .plot = {.title = "One evaluation with its derivatives by five pigments",
                     .x_label = "log10 of the number of wavelengths",
                     .y_label = time_label,
                     .lines = {lines.paths, lines.solver, lines.emulator}}};
}

ScalingPlot against_rays() {
    PlotLine analog{.label = "analog walk, one evaluation", .x = {}, .y = {}};
    PlotLine recording{.label = "recording, once", .x = {}, .y = {}};
    PlotLine evaluation{.label = "recorded paths, one evaluation", .x = {}, .y = {}};
    for (const std::uint64_t rays : {1000U, 3200U, 10'000U, 32'000U, 100'000U}) {
        const FitProblem problem = bench_work(1, rays).problem;
        const double size = std::log10(static_cast<double>(rays));
        const Objective objective(problem, recorded(problem));
        add(recording, size, cost([&] { (void)recorded(problem); }));
        add(evaluation, size, cost([&] { (void)objective.misfit(starts(problem)); }));
        if (rays > 10'000) continue;  // seconds each
        add(analog, size, cost([&] {
                (void)read_by_walk(problem.only().experiment, problem.only().wavelength_nm, rays,
                                   problem.only().walk.seed);
            }));
    }
    return {.name = "rays",
            .plot = {.title = "31 wavelengths, five free pigments",
                     .x_label = "log10 of rays per wavelength",
                     .y_label = time_label,
                     .lines = {analog, recording, evaluation}}};
}

ScalingPlot against_free_parameters() {
    BenchWork work = bench_work(1, table_1_rays);
    EngineLines lines;
    PlotLine fit{.label = "emulator, a whole lean fit", .x = {}, .y = {}};
    work.configuration.free.fill(false);
    int count = 0;
    for (const Parameter parameter :
         {Parameter::melanosome_fraction, Parameter::papillary_blood_fraction, Parameter::oxygen_saturation,
          Parameter::bilirubin_g_per_l, Parameter::reticular_blood_fraction, Parameter::dermis_carotene_g_per_l,
          Parameter::epidermis_thickness_cm, Parameter::scale}) {
        work.configuration.free[static_cast<std::size_t>(parameter)] = true;
        const FitProblem problem = problem_with(work.configuration, work.problem.only().wavelength_nm);
        lines.measure(problem, ++count);
        const BulkFitter fitter(problem, Emulator::build(emulator_domain(problem)));
        const Eigen::Map<const Eigen::VectorXd> measured(problem.only().measured.data(), work.spectra.rows());
        add(fit, count, cost([&] { (void)fitter.fit(measured); }));
    }
    return {.name = "free_parameters",
            .plot = {.title = "One evaluation with all derivatives, 31 wavelengths",
                     .x_label = "free parameters",
                     .y_label = time_label,
                     .lines = {lines.paths, lines.solver, lines.emulator, fit}}};
}

std::string csv_of(const Plot& plot) {
    std::string text = fmt::format("line,{},{}\n", plot.x_label, plot.y_label);
    for (const PlotLine& line : plot.lines) {
        for (std::size_t i = 0; i < line.x.size(); ++i) {
            text += fmt::format("\"{}\",{:.4f},{:.3f}\n", line.label, line.x[i], line.y[i]);
        }
    }
    return text;
}

}  // namespace

std::vector<ScalingPlot> measure_scaling(const BenchListener& tell) {
    std::vector<ScalingPlot> plots;
    tell("measuring against spectra");
    plots.push_back(against_spectra());
    tell("measuring against wavelengths");
    plots.push_back(against_wavelengths());
    tell("measuring against rays");
    plots.push_back(against_rays());
    tell("measuring against free parameters");
    plots.push_back(against_free_parameters());
    return plots;
}

void write_scaling_tables(const std::vector<ScalingPlot>& plots, const std::filesystem::path& folder) {
    for (const ScalingPlot& each : plots) {
        write_file_atomically(folder / fmt::format("scaling_{}.csv", each.name), csv_of(each.plot));
    }
}

}  // namespace skinfit
