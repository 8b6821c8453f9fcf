#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/option_limits.hpp"
#include "app/outputs.hpp"
#include "app/progress_line.hpp"
#include "app/shared_options.hpp"
#include "bench/output.hpp"
#include "bench/scaling.hpp"

namespace skinfit {
namespace {

struct BenchCommand {
    SharedOptions output;
    BenchSizes sizes;
    std::filesystem::path scaling;
};

int run(const BenchCommand& command, Session& session) {
    check_output(command.output);
    ProgressLine line(session, "measuring");
    const auto tell = [&line](const std::string& what) { line.show({.what = what}); };
    if (!command.scaling.empty()) {
        SharedOptions probe;
        probe.out = command.scaling / "scaling_rays.svg";
        check_picture(probe, "--scaling");
        const std::vector<ScalingPlot> plots = measure_scaling(tell);
        write_scaling_tables(plots, command.scaling);
        for (const ScalingPlot& each : plots) {
            const std::filesystem::path picture = command.scaling / fmt::format("scaling_{}.svg", each.name);
            write_beside(session, picture, [&] { draw(each.plot, picture); });
        }
        return good_result;
    }
    const BenchResult result = measure_ladder(command.sizes, tell);
    line.end();
    write_output(command.output, command.output.format == "json" ? json_text(bench_json(result)) : bench_text(result));
    return good_result;
}

}  // namespace

void add_bench_command(CLI::App& app, Session& session) {
    const auto command = std::make_shared<BenchCommand>();
    CLI::App* const bench = app.add_subcommand("bench", "measure on this machine what a fit costs, by each engine");
    whole_number(bench->add_option("--spectra", command->sizes.spectra, "synthetic, fitted by each engine"), 2, 100'000)
        ->capture_default_str();
    whole_number(bench->add_option("--solver-spectra", command->sizes.solver_spectra,
                                   "of them fitted by the angular solver too"),
                 1, 100'000)
        ->capture_default_str();
    whole_number(bench->add_option("--bulk-spectra", command->sizes.bulk_spectra,
                                   "fitted in one call; repeats where there are fewer"),
                 1, 10'000'000)
        ->capture_default_str();
    whole_number(bench->add_option("--rays", command->sizes.rays, "per wavelength, of walks"), 3000, 10'000'000)
        ->capture_default_str();
    whole_number(bench->add_option("--brute-force-evaluations", command->sizes.brute_force_evaluations,
                                   "timed of a fit that traces all rays anew each time; the rest is extrapolated"),
                 1, 10'000)
        ->capture_default_str();
    add_format_option(*bench, command->output.format, {"text", "json"});
    add_out_option(*bench, command->output.out);
    bench
        ->add_option("--scaling", command->scaling,
                     "instead, plot costs against spectra, wavelengths, rays and free parameters into this folder")
        ->type_name("FOLDER");
    add_examples(*bench, {"skinfit bench", "skinfit bench --spectra 20 --format json --out bench.json",
                          "skinfit bench --scaling scaling"});
    bench->callback([command, &session] { session.exit_code = run(*command, session); });
}

}  // namespace skinfit
