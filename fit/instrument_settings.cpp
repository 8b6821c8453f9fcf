#include "fit/instrument_settings.hpp"

#include "fit/named_instrument.hpp"

namespace skinfit {
namespace {

Setting instrument() {
    return {"instrument",
            "a name of configs/instruments/, or such a JSON file: what geometry, bandpass and noise are where they are "
            "not set; null: as the measured file says",
            {{"type", {"string", "null"}}},
            [](Configuration& configuration, const Json& value, const std::string& where) {
                configuration.instrument.reset();
                if (value.is_null()) return;
                if (!value.is_string()) refuse(where, value, "a name is needed", "give a name or a file");
                configuration.instrument = find_instrument(value.get<std::string>(), where);
            },
            [](const Configuration& configuration) {
                return configuration.instrument ? Json(configuration.instrument->name) : Json();
            }};
}

Setting bandpass_shape() {
    Json choices = bandpass_shape_names;
    choices.push_back(nullptr);
    return {"bandpass_shape",
            "how the instrument weights the wavelengths about the one it reports; null: as the file says, else "
            "triangular",
            {{"enum", choices}},
            [](Configuration& configuration, const Json& value, const std::string& where) {
                configuration.bandpass_shape.reset();
                if (value.is_null()) return;
                configuration.bandpass_shape =
                    static_cast<BandpassShape>(read_choice(value, bandpass_shape_names, where));
            },
            [](const Configuration& configuration) {
                const std::optional<BandpassShape> shape = configuration.bandpass_shape;
                return shape ? Json(bandpass_shape_names.at(static_cast<std::size_t>(*shape))) : Json();
            }};
}

Setting bandpass_width() {
    return {"bandpass_width_nm",
            "full width at half maximum of the bandpass; 0: single wavelengths; null: as the file says, else 0",
            {{"type", {"number", "null"}},
             {"minimum", bandpass_width_range_nm.lowest},
             {"maximum", bandpass_width_range_nm.highest}},
            [](Configuration& configuration, const Json& value, const std::string& where) {
                configuration.bandpass_width_nm.reset();
                if (value.is_null()) return;
                configuration.bandpass_width_nm = read_number(value, bandpass_width_range_nm, where);
            },
            [](const Configuration& configuration) {
                return configuration.bandpass_width_nm ? Json(*configuration.bandpass_width_nm) : Json();
            }};
}

}  // namespace

std::vector<Setting> instrument_settings() {
    return {instrument(), bandpass_shape(), bandpass_width()};
}

}  // namespace skinfit
