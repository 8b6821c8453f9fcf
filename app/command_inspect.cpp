#include "app/commands.hpp"
#include "app/measured_file.hpp"
#include "app/option_limits.hpp"
#include "app/outputs.hpp"
#include "app/progress_line.hpp"
#include "app/region_options.hpp"
#include "app/shared_options.hpp"
#include "fit/configuration_json.hpp"
#include "fit/inspection.hpp"
#include "fit/spectra_plot.hpp"

namespace skinfit {
namespace {

struct InspectCommand {
    SharedOptions output;
    std::string file;
    std::string reader;
    RegionOptions region;
    std::string unit;
    std::filesystem::path plot;
    bool strict = false;
};

ReadOptions read_options(const InspectCommand& command) {
    ReadOptions options{.region = region_from(command.region), .window = usual_window()};
    if (!command.unit.empty()) {
        options.unit = configured_by_word(default_configuration(), "unit", command.unit, "--unit").unit;
    }
    return options;
}

/// Refuses a picture that cannot be drawn or written, or would replace one of these files.
void check_plot(const InspectCommand& command, std::vector<std::filesystem::path> read) {
    SharedOptions plot = command.output;
    plot.out = command.plot;
    read.push_back(command.output.out);
    check_picture(plot, "--plot", read);
    refuse_same_output({"--out", command.output.out}, {"--plot", command.plot});
}

int run(const InspectCommand& command, Session& session) {
    const ReadOptions options = read_options(command);
    const auto check_outputs = [&command](const std::vector<std::filesystem::path>& read) {
        check_output(command.output, read);
        check_plot(command, read);
    };
    check_outputs(files_read(command.file, command.region));
    MeasuredFiles measured(command.reader, session.quiet);
    std::optional<ProgressLine> line;  // not over what is typed
    if (!is_standard_input(command.file)) line.emplace(session, "reading");
    const Inspection inspection = inspected(measured.spectra(command.file, options));
    line.reset();
    check_outputs(measured.files_of_cubes());
    write_result(
        command.output,
        command.output.format == "json" ? json_text(inspection_json(inspection)) : inspection_text(inspection), [&] {
            if (command.plot.empty()) return;
            const std::string title = std::filesystem::path(command.file).filename().string();
            write_beside(session, command.plot, [&] { draw_spectra(inspection.file.spectra, title, command.plot); });
        });
    if (command.strict) refuse_warnings(inspection.findings, inspection.file.source);
    return good_result;
}

}  // namespace

void add_inspect_command(CLI::App& app, Session& session) {
    const auto command = std::make_shared<InspectCommand>();
    CLI::App* const inspect =
        app.add_subcommand("inspect", "show what a measured file holds and what is wrong with its spectra");
    inspect->add_option("FILE", command->file, "spectra, in any form that skinfit reads; - is standard input")
        ->required();
    add_reader_option(*inspect, command->reader);
    add_region_options(*inspect, command->region);
    inspect->add_option("--unit", command->unit, "of the values; found by a rule otherwise")
        ->type_name(choices(unit_names));
    inspect->add_option("--plot", command->plot, "draw the spectra into this file, .svg, .png or .pdf")
        ->type_name("FILE");
    inspect->add_flag("--strict", command->strict, "make warnings errors: exit code 2 where there are any");
    add_format_option(*inspect, command->output.format, {"text", "json"});
    add_out_option(*inspect, command->output.out);
    add_examples(*inspect,
                 {"skinfit inspect measurements/data/ncsu_113.csv",
                  "skinfit inspect measurements/data/ncsu_113.csv --plot spectrum.png",
                  "skinfit inspect measurements/data/ncsu_113.csv --format json"},
                 "Exit code 0: done; 2: bad input, or warnings with --strict; 3: internal error.");
    inspect->callback([command, &session] { session.exit_code = run(*command, session); });
}

}  // namespace skinfit
