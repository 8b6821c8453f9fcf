#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/option_limits.hpp"
#include "app/shared_options.hpp"
#include "core/file.hpp"
#include "fit/configuration_check.hpp"
#include "fit/configuration_json.hpp"
#include "fit/preset.hpp"

namespace skinfit {

void add_config_command(CLI::App& app, Session& session) {
    CLI::App* const config = app.add_subcommand("config", "show or check configurations, or print their schema");
    config->require_subcommand(1);
    const auto preset = std::make_shared<std::string>(preset_names[static_cast<std::size_t>(Preset::skin)]);
    CLI::App* const show = config->add_subcommand("show", "print the full configuration of a preset");
    one_of(show->add_option("PRESET", *preset, "skin: what fit begins with; paper: what simulate begins with"),
           {preset_names.begin(), preset_names.end()})
        ->capture_default_str();
    show->callback([preset, &session] {
        write_stdout(json_text(to_json(configured_by_word(default_configuration(), "preset", *preset, "PRESET"))));
        session.exit_code = good_result;
    });
    config->add_subcommand("schema", "print the JSON Schema of a configuration")->callback([&session] {
        write_stdout(json_text(configuration_schema()));
        session.exit_code = good_result;
    });
    add_examples(*config->get_subcommand("show"), {"skinfit config show > settings.json", "skinfit config show paper"});
    add_examples(*config->get_subcommand("schema"), {"skinfit config schema > schema.json"});
    CLI::App* const check = config->add_subcommand("check", "check a configuration file, as fit takes it");
    const auto file = std::make_shared<std::string>();
    check->add_option("FILE", *file, "JSON file")->required();
    add_examples(*check, {"skinfit config check configs/ncsu_45_0.json"});
    check->callback([file, &session] {
        check_configuration(configured_by_text(measured_configuration(), read_input(*file), *file), *file);
        write_stdout(fmt::format("{}: good\n", *file));
        session.exit_code = good_result;
    });
}

}  // namespace skinfit
