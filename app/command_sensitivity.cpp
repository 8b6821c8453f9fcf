#include "app/commands.hpp"
#include "app/option_limits.hpp"
#include "app/outputs.hpp"
#include "app/progress_line.hpp"
#include "app/shared_options.hpp"
#include "fit/configuration_json.hpp"
#include "fit/plot.hpp"
#include "fit/sensitivity.hpp"

namespace skinfit {
namespace {

struct SensitivityCommand {
    SharedOptions shared;
    std::string wavelengths;
    std::string quantity;
    std::vector<std::string> free;
    std::vector<std::string> fix;
    bool relative = false;
    std::filesystem::path plot;
};

Configuration sensitivity_configuration(const SensitivityCommand& command) {
    Configuration configuration = configuration_from(command.shared);
    const auto take = [&](const char* key, const std::string& text) {
        if (!text.empty()) configuration = configured_by_word(configuration, key, text, std::string("--") + key);
    };
    take("wavelengths", command.wavelengths);
    take("quantity", command.quantity);
    return with_free_and_fixed(configuration, command.free, command.fix);
}

int run(const SensitivityCommand& command, Session& session) {
    const Configuration configuration = sensitivity_configuration(command);
    check_output(command.shared);
    SharedOptions picture = command.shared;
    picture.out = command.plot;
    check_picture(picture, "--plot");
    refuse_same_output({"--out", command.shared.out}, {"--plot", command.plot});
    const auto limit = thread_limit(command.shared);
    ProgressLine line(session, "computing derivatives");
    const Sensitivity result = sensitivity(configuration);
    line.end();
    const Derivative derivative = command.relative ? Derivative::relative : Derivative::per_unit;
    write_result(command.shared,
                 command.shared.format == "json" ? json_text(sensitivity_json(result, derivative))
                                                 : sensitivity_csv(result, derivative),
                 [&] {
                     if (command.plot.empty()) return;
                     write_beside(session, command.plot, [&] { draw(sensitivity_plot(result), command.plot); });
                 });
    return good_result;
}

}  // namespace

void add_sensitivity_command(CLI::App& app, Session& session) {
    const auto command = std::make_shared<SensitivityCommand>();
    CLI::App* const sensitivity =
        app.add_subcommand("sensitivity", "compute how the reading answers to each parameter, by wavelength");
    add_wavelengths_option(*sensitivity, command->wavelengths);
    sensitivity->add_option("--quantity", command->quantity, "what is read; reflectance if not configured")
        ->type_name(choices(quantity_names));
    sensitivity->add_flag("--relative", command->relative,
                          "each derivative times the value of its parameter, instead of per unit");
    sensitivity
        ->add_option("--plot", command->plot,
                     "draw value times derivative of the free parameters into this file, .svg, .png or .pdf")
        ->type_name("FILE");
    add_names_option(*sensitivity, "--free", command->free, "draw these parameters too");
    add_names_option(*sensitivity, "--fix", command->fix, "do not draw these parameters");
    add_shared_options(*sensitivity, command->shared, {"csv", "json"});
    add_examples(*sensitivity, {"skinfit sensitivity --wavelengths 400:700:10",
                                "skinfit sensitivity --relative --plot sensitivity.svg",
                                "skinfit sensitivity --quantity transmittance --set base=matched --format json"});
    sensitivity->callback([command, &session] { session.exit_code = run(*command, session); });
}

}  // namespace skinfit
