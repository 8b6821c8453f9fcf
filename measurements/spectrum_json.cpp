#include <fmt/format.h>

#include "core/json.hpp"
#include "measurements/spectrum_writer.hpp"

namespace skinfit {
namespace {

Json json_of(const Spectrum& spectrum) {
    Json json;
    json["name"] = spectrum.name;
    const auto put_text = [&json](const char* name, const std::string& text) {
        if (!text.empty()) json[name] = text;
    };
    const auto put_number = [&json](const char* name, const std::optional<double>& number) {
        if (number) json[name] = *number;
    };
    if (spectrum.quantity) json["quantity"] = quantity_names[static_cast<std::size_t>(*spectrum.quantity)];
    put_number("incidence_deg", spectrum.geometry.incidence_deg);
    if (spectrum.geometry.specular) {
        json["specular"] = specular_names[static_cast<std::size_t>(*spectrum.geometry.specular)];
    }
    put_number("viewing_cone_deg", spectrum.geometry.viewing_cone_deg);
    put_text("instrument", spectrum.instrument);
    put_text("site", spectrum.site);
    put_number("aperture_mm", spectrum.aperture_mm);
    if (spectrum.bandpass) {
        json["bandpass_shape"] = bandpass_shape_names[static_cast<std::size_t>(spectrum.bandpass->shape)];
        json["bandpass_width_nm"] = spectrum.bandpass->width_nm;
    }
    put_text("sigma_source", spectrum.sigma_source);
    if (!spectrum.missing_nm.empty()) json["missing_nm"] = spectrum.missing_nm;
    for (const FileNote& note : spectrum.notes) json["notes"].push_back(Json::array({note.key, note.value}));
    json["unit"] = "fraction";
    json["wavelength_nm"] = spectrum.wavelength_nm;
    json["value"] = spectrum.value;
    if (!spectrum.sigma.empty()) json["sigma"] = spectrum.sigma;
    if (!spectrum.repeats.empty()) json["repeats"] = spectrum.repeats;
    return json;
}

}  // namespace

std::string spectra_json(const std::vector<Spectrum>& spectra) {
    std::string text = "{\"spectra\": [";
    const char* before_spectrum = "";
    for (const Spectrum& spectrum : spectra) {
        text += fmt::format("{}\n  {{", before_spectrum);
        before_spectrum = ",";
        const char* before_name = "\n    ";
        const Json json = json_of(spectrum);
        for (const auto& [name, value] : json.items()) {
            text += fmt::format("{}\"{}\": {}", before_name, name,
                                value.dump(-1, ' ', false, Json::error_handler_t::replace));
            before_name = ",\n    ";
        }
        text += "\n  }";
    }
    return text + "\n]}\n";
}

}  // namespace skinfit
