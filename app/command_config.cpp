#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/shared_options.hpp"
#include "core/file.hpp"
#include "fit/configuration_check.hpp"
#include "fit/configuration_json.hpp"

namespace skinfit {

void add_config_command(CLI::App& app, int& exit_code) {
    CLI::App* const config = app.add_subcommand("config", "show, check or describe configurations");
    config->require_subcommand(1);
    config->add_subcommand("show", "print the full default configuration")->callback([&exit_code] {
        write_stdout(json_text(to_json(default_configuration())));
        exit_code = trustworthy_result;
    });
    config->add_subcommand("schema", "print the JSON Schema of a configuration")->callback([&exit_code] {
        write_stdout(json_text(configuration_schema()));
        exit_code = trustworthy_result;
    });
    CLI::App* const check = config->add_subcommand("check", "check a configuration file");
    const auto file = std::make_shared<std::string>();
    check->add_option("FILE", *file, "JSON file")->required()->type_name("");
    check->callback([file, &exit_code] {
        check_configuration(configured_by_text(default_configuration(), read_file(*file), *file), *file);
        write_stdout(fmt::format("{}: good\n", *file));
        exit_code = trustworthy_result;
    });
}

}  // namespace skinfit
