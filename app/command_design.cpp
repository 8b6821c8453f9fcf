#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/option_limits.hpp"
#include "app/progress_line.hpp"
#include "app/shared_options.hpp"
#include "core/input_error.hpp"
#include "core/nearest_names.hpp"
#include "fit/configuration_json.hpp"
#include "fit/design.hpp"

namespace skinfit {
namespace {

struct DesignCommand {
    SharedOptions shared;
    std::string parameter;
    std::string wavelengths;
    std::vector<std::string> free;
    std::vector<std::string> fix;
    std::size_t best = 0;
};

Parameter named_parameter(const std::string& name) {
    if (const std::optional<Parameter> found = find_parameter(name)) return *found;
    std::vector<std::string_view> names;
    for (const ParameterInfo& row : parameter_table()) names.push_back(row.name);
    const std::vector<std::string_view> meant = meant_names(name, names);
    throw InputError({.where = "PARAMETER",
                      .problem = fmt::format("\"{}\" is no parameter", name),
                      .why = "only a parameter of the model can be detected",
                      .remedy = (meant.empty() ? "" : fmt::format("did you mean {}? Else ", either(meant, "", ""))) +
                                "choose from those of `skinfit config show`"});
}

std::string output(const Design& result, const std::string& format) {
    if (format == "json") return json_text(design_json(result));
    return format == "csv" ? design_csv(result) : design_text(result);
}

int run(const DesignCommand& command, Session& session) {
    Configuration configuration = configuration_from(command.shared);
    if (!command.wavelengths.empty()) {
        configuration = configured_by_word(configuration, "wavelengths", command.wavelengths, "--wavelengths");
    }
    for (const std::string& names : command.free) configuration = with_freedom(configuration, names, true, "--free");
    for (const std::string& names : command.fix) configuration = with_freedom(configuration, names, false, "--fix");
    const Parameter parameter = named_parameter(command.parameter);
    check_output(command.shared);
    const auto limit = thread_limit(command.shared);
    ProgressLine line(session, "designing");
    const Design result = design(
        configuration, {.parameter = parameter, .best = command.best, .cache = cache_from(command.shared, line)});
    line.end();
    write_output(command.shared, output(result, command.shared.format));
    return good_result;
}

}  // namespace

void add_design_command(CLI::App& app, Session& session) {
    const auto command = std::make_shared<DesignCommand>();
    CLI::App* const design =
        app.add_subcommand("design", "plan a measurement: detection limits and the best wavelengths");
    design->add_option("PARAMETER", command->parameter, "what is to be detected, as in bilirubin_g_per_l")->required();
    add_wavelengths_option(*design, command->wavelengths);
    whole_number(design->add_option("--best", command->best, "choose so many of the wavelengths"), 1, 1000);
    add_names_option(*design, "--free", command->free, "these parameters are unknown too");
    add_names_option(*design, "--fix", command->fix, "these parameters are known");
    add_shared_options(*design, command->shared, {"text", "csv", "json"});
    add_examples(*design,
                 {"skinfit design bilirubin_g_per_l", "skinfit design bilirubin_g_per_l --best 6 --set noise=0.003",
                  "skinfit design oxygen_saturation --wavelengths 450:650:5 --format csv"});
    design->callback([command, &session] { session.exit_code = run(*command, session); });
}

}  // namespace skinfit
