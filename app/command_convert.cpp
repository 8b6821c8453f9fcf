#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/measured_file.hpp"
#include "app/option_limits.hpp"
#include "app/progress_line.hpp"
#include "app/region_options.hpp"
#include "app/shared_options.hpp"
#include "core/input_error.hpp"
#include "fit/configuration_json.hpp"
#include "fit/inspection.hpp"
#include "fit/settings.hpp"
#include "measurements/spectrum_file.hpp"
#include "measurements/spectrum_writer.hpp"

namespace skinfit {
namespace {

struct ConvertCommand {
    std::string file;
    std::vector<std::string> columns;
    std::string reader;
    RegionOptions region;
    std::string unit;
    std::string format;
    std::filesystem::path out;
};

std::string format_of(const ConvertCommand& command) {
    if (!command.format.empty()) return command.format;
    return command.out.extension() == ".json" ? "json" : "csv";
}

/// The spectra chosen, or all of them.
std::vector<Spectrum> spectra_of(const ConvertCommand& command, MeasuredFiles& measured) {
    ReadOptions options{.region = region_from(command.region), .window = usual_window()};
    if (!command.unit.empty()) {
        options.unit = configured_by_word(default_configuration(), "unit", command.unit, "--unit").unit;
    }
    if (command.columns.empty()) return measured.spectra(command.file, options).spectra;
    std::vector<Spectrum> chosen;
    for (const std::string& column : command.columns) {
        options.column = column;
        chosen.push_back(measured.spectra(command.file, options).spectra.front());
    }
    return chosen;
}

int run(const ConvertCommand& command, Session& session) {
    SharedOptions shared;
    shared.out = command.out;
    check_output(shared, files_read(command.file, command.region));
    std::optional<ProgressLine> line;  // not over what is typed
    if (!is_standard_input(command.file)) line.emplace(session, "reading");
    MeasuredFiles measured(command.reader, session.quiet);
    const std::vector<Spectrum> spectra = spectra_of(command, measured);
    line.reset();
    check_output(shared, measured.files_of_cubes());
    write_output(shared, format_of(command) == "json" ? spectra_json(spectra) : spectra_csv(spectra, command.file));
    return good_result;
}

}  // namespace

void add_convert_command(CLI::App& app, Session& session) {
    const auto command = std::make_shared<ConvertCommand>();
    CLI::App* const convert = app.add_subcommand("convert", "write the spectra of a file as CSV or JSON of one form");
    convert->add_option("FILE", command->file, "spectra in any form that skinfit reads; - is standard input")
        ->required();
    add_out_option(*convert, command->out);
    one_of(convert->add_option("--format", command->format,
                               "form of the output; if not given, that of the ending of --out, else csv"),
           {"csv", "json"});
    repeated(convert->add_option("--column", command->columns, "only this spectrum: its name, or its number from 1"))
        ->type_name("NAME");
    convert->add_option("--unit", command->unit, "of the values; found by a rule otherwise")
        ->type_name(choices(unit_names));
    add_reader_option(*convert, command->reader);
    add_region_options(*convert, command->region);
    add_examples(*convert,
                 {"skinfit convert measurements/data/ncsu_113.csv --out spectrum.json",
                  "skinfit convert - --unit fraction < measurements/data/ncsu_113.csv"},
                 fmt::format("Numbers are written so that they read back to the last bit. CSV holds spectra of the "
                             "same wavelengths and the\n"
                             "same description, without their repeats; JSON holds all.\n\n{}",
                             exit_codes));
    convert->callback([command, &session] { session.exit_code = run(*command, session); });
}

}  // namespace skinfit
