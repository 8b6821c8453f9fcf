#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/commands.hpp"
#include "app/outputs.hpp"
#include "app/progress_line.hpp"
#include "app/shared_options.hpp"
#include "app/terminal.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "fit/configuration_json.hpp"
#include "fit/gnuplot.hpp"
#include "validation/figure_output.hpp"
#include "validation/shipped.hpp"

namespace skinfit {
namespace {

struct ValidateCommand {
    std::filesystem::path output = "forward_validation";
    std::filesystem::path shared;
    std::string figures;
    std::string format;
    std::string rays;
    std::string seed;
    int threads = 0;
};

/// The figures named in "3,5"; all of them where nothing is named.
std::vector<Figure> chosen_figures(const std::string& names) {
    std::vector<Figure> figures = shipped_figures();
    if (names.empty()) return figures;
    std::vector<Figure> chosen;
    for (const std::string_view name : split(names, ',')) {
        const auto found =
            std::ranges::find_if(figures, [&](const Figure& each) { return std::to_string(each.number) == name; });
        if (found == figures.end()) {
            throw InputError(
                {.where = fmt::format("--figures {}", names),
                 .problem = fmt::format("no figure \"{}\"", name),
                 .why = fmt::format("there are figures {} to {}", figures.front().number, figures.back().number),
                 .remedy = "give numbers as in --figures 3,5"});
        }
        chosen.push_back(*found);
    }
    return chosen;
}

FigureOptions options_of(const ValidateCommand& command) {
    FigureOptions options{.rays = {}, .seed = {}, .shared_folder = command.shared};
    const auto read = [](const char* key, const std::string& text) {
        return configured_by_word(default_configuration(), key, text, std::string("--") + key);
    };
    if (!command.rays.empty()) options.rays = read("rays", command.rays).rays;
    if (!command.seed.empty()) options.seed = read("seed", command.seed).seed;
    return options;
}

void write_figure(const FigureResult& result, const std::filesystem::path& folder, Session& session) {
    const std::string name = fmt::format("figure_{}", result.figure.number);
    write_file_atomically(folder / (name + ".csv"), figure_csv(result));
    const PlotSheet sheet = figure_sheet(result);
    for (const char* ending : {".svg", ".png"}) {
        write_beside(session, folder / (name + ending), [&] { draw(sheet, folder / (name + ending)); });
    }
}

int run(const ValidateCommand& command, Session& session) {
    const std::vector<Figure> figures = chosen_figures(command.figures);
    const FigureOptions options = options_of(command);
    make_output_folder(command.output);
    require_gnuplot();
    SharedOptions shared;
    shared.threads = command.threads;
    const auto limit = thread_limit(shared);
    std::vector<FigureResult> results;
    ProgressLine line(session, "computing figures");
    const std::stop_token stop = session.stop_on_interrupt("interrupted; the figure at hand is finished first");
    for (const Figure& figure : figures) {
        if (stop.stop_requested()) break;
        line.show({.what = figure.title, .done = results.size(), .total = figures.size()});
        results.push_back(run_figure(figure, options));
        for (const std::string& message : results.back().messages) line.tell("note: " + message);
        write_figure(results.back(), command.output, session);
    }
    line.end();
    if (results.size() < figures.size()) {
        line.tell(fmt::format("{} of {} figures are in {}", results.size(), figures.size(), command.output.string()));
        return session.interrupt.exit_code();
    }
    const std::string json = json_text(summary_json(results));
    write_file_atomically(command.output / "summary.json", json);
    command.format == "json" ? write_stdout(json) : write_report_to_stdout(summary_text(results));
    return good_result;
}

}  // namespace

void add_validate_command(CLI::App& app, Session& session) {
    const auto command = std::make_shared<ValidateCommand>();
    CLI::App* const validate =
        app.add_subcommand("validate", "hold the model against what has been published, and fits against the truth");
    validate->require_subcommand(1);
    CLI::App* const forward = validate->add_subcommand("forward", "the figures of the model's paper, and their claims");
    forward->add_option("--output", command->output, "folder for a table and two pictures per figure, and summary.json")
        ->type_name("FOLDER")
        ->capture_default_str();
    forward->add_option("--figures", command->figures, "only these, as in 3,5")->type_name("N,N");
    forward
        ->add_option("--shared", command->shared,
                     "folder of measurements that are not shipped; without it the comparison with them is left out")
        ->type_name("FOLDER");
    add_format_option(*forward, command->format, {"text", "json"}, "form of the summary on the terminal");
    forward->add_option("--rays", command->rays, "of the goniophotometer, per wavelength, instead of the figure's own")
        ->type_name("N");
    forward->add_option("--seed", command->seed, "of the goniophotometer's random numbers, instead of the figure's own")
        ->type_name("N");
    add_threads_option(*forward, command->threads);
    add_examples(*forward,
                 {"skinfit validate forward", "skinfit validate forward --figures 3,4 --output figures",
                  "skinfit validate forward --figures 7 --rays 20000 --format json"},
                 "Exit code 0: done, whatever the verdicts; 2: bad input; 3: internal error; 130: ended by Ctrl-C.");
    forward->callback([command, &session] { session.exit_code = run(*command, session); });
    add_validate_inverse_command(*validate, session);
}

}  // namespace skinfit
