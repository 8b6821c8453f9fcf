#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/shared_options.hpp"
#include "core/file.hpp"
#include "fit/configuration_check.hpp"
#include "fit/configuration_json.hpp"

namespace skinfit {

void add_config_command(CLI::App& app, Session& session) {
    CLI::App* const config = app.add_subcommand("config", "show or check configurations, or print their schema");
    config->require_subcommand(1);
    config->add_subcommand("show", "print the full default configuration")->callback([&session] {
        write_stdout(json_text(to_json(default_configuration())));
        session.exit_code = trustworthy_result;
    });
    config->add_subcommand("schema", "print the JSON Schema of a configuration")->callback([&session] {
        write_stdout(json_text(configuration_schema()));
        session.exit_code = trustworthy_result;
    });
    add_examples(*config->get_subcommand("show"), {"skinfit config show > settings.json"});
    add_examples(*config->get_subcommand("schema"), {"skinfit config schema > schema.json"});
    CLI::App* const check = config->add_subcommand("check", "check a configuration file");
    const auto file = std::make_shared<std::string>();
    check->add_option("FILE", *file, "JSON file")->required();
    add_examples(*check, {"skinfit config check configs/ncsu_45_0.json"});
    check->callback([file, &session] {
        check_configuration(configured_by_text(default_configuration(), read_input(*file), *file), *file);
        write_stdout(fmt::format("{}: good\n", *file));
        session.exit_code = trustworthy_result;
    });
}

}  // namespace skinfit
