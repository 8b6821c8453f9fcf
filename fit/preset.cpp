#include "fit/preset.hpp"

#include <span>
#include <string>

#include "core/embedded_file.hpp"
#include "fit/configuration_json.hpp"

namespace skinfit {

namespace preset_files {
std::span<const EmbeddedFile> embedded_files();
}  // namespace preset_files

Configuration with_preset(const Configuration& configuration, Preset preset) {
    if (preset == configuration.preset) return configuration;
    Configuration changed = configuration.preset == Preset::paper ? configuration : default_configuration();
    if (preset != Preset::paper) {
        const EmbeddedFile& file = preset_files::embedded_files().front();
        changed = configured_by_text(changed, file.text, std::string(file.name));
    }
    changed.preset = preset;
    return changed;
}

Configuration measured_configuration() {
    return with_preset(default_configuration(), Preset::skin);
}

Setting preset_setting() {
    return {"preset",
            "what all other settings begin with: skin: priors, noise, discrepancy and free parameters for measured "
            "skin, the "
            "default of fit and of studies of spectra; paper: Table 1 of the paper, the default elsewhere",
            {{"enum", preset_names}},
            [](Configuration& configuration, const Json& value, const std::string& where) {
                configuration =
                    with_preset(configuration, static_cast<Preset>(read_choice(value, preset_names, where)));
            },
            [](const Configuration& configuration) {
                return Json(preset_names[static_cast<std::size_t>(configuration.preset)]);
            }};
}

}  // namespace skinfit
