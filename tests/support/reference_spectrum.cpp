#include "tests/support/reference_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include "core/file.hpp"
#include "core/text.hpp"
#include "model/constants.hpp"

namespace skinfit::test {
namespace {

constexpr double reference_rays = 2e6;  // per wavelength, ../shared/README.md

double number(std::string_view text) {
    const std::optional<double> value = parse_number(text);
    if (!value) throw std::runtime_error("not a number: " + std::string(text));
    return *value;
}

/// Applies one `symbol=value` of the header, in the paper's symbols.
void apply(Sample& sample, std::string_view symbol, double value) {
    static const std::map<std::string_view, double Skin::*> fields = {
        {"th_m", &Skin::melanosome_fraction},
        {"th_p", &Skin::papillary_blood_fraction},
        {"th_r", &Skin::reticular_blood_fraction},
        {"gamma", &Skin::oxygen_saturation},
        {"c_bil", &Skin::bilirubin_g_per_l},
        {"t_s", &Skin::stratum_corneum_thickness_cm},
        {"t_e", &Skin::epidermis_thickness_cm},
        {"t_p", &Skin::papillary_dermis_thickness_cm},
        {"t_r", &Skin::reticular_dermis_thickness_cm},
        {"eta_s", &Skin::stratum_corneum_refractive_index},
        {"eta_e", &Skin::epidermis_refractive_index},
        {"eta_p", &Skin::papillary_dermis_refractive_index},
        {"eta_r", &Skin::reticular_dermis_refractive_index},
        {"eta_f", &Skin::fibre_refractive_index},
        {"r", &Skin::fibril_radius_nm},
    };
    if (const auto field = fields.find(symbol); field != fields.end()) {
        sample.skin.*field->second = value;
    } else if (symbol == "hypodermis" && value == 0.0) {
        sample.base.kind = Base::Kind::matched;
    } else if (symbol == "sample" && value == 1.0) {
        sample.layers = 2;
        sample.base = {.kind = Base::Kind::index, .refractive_index = 1.0};
    } else {
        throw std::runtime_error("unknown change: " + std::string(symbol));
    }
}

/// The text of `line` between `before` and the next semicolon.
std::string_view part(std::string_view line, std::string_view before) {
    const std::size_t begin = line.find(before);
    if (begin == std::string_view::npos) throw std::runtime_error("header lacks: " + std::string(before));
    const std::string_view rest = line.substr(begin + before.size());
    return trimmed(rest.substr(0, rest.find(';')));
}

void parse_header(std::string_view line, ReferenceSpectrum& spectrum) {
    const std::string_view edition = part(line, "; edition ");
    if (edition != "printed" && edition != "revised") throw std::runtime_error("unknown edition");
    spectrum.sample.edition = edition == "printed" ? Edition::printed : Edition::revised;
    spectrum.incidence_rad = number(split(part(line, "; incidence "), ' ').front()) * rad_per_deg;
    for (const std::string_view change : split(part(line, "; changed from Table 1:"), ' ')) {
        if (change.empty()) continue;
        const std::vector<std::string_view> sides = split(change, '=');
        if (sides.size() != 2) throw std::runtime_error("not a change: " + std::string(change));
        apply(spectrum.sample, sides[0], number(sides[1]));
    }
}

}  // namespace

ReferenceSpectrum parse_reference_spectrum(std::string_view name, std::string_view text) {
    ReferenceSpectrum spectrum;
    spectrum.name = name;
    bool columns_named = false;
    for (const std::string_view line : split_lines(text)) {
        if (line.starts_with('#')) {
            parse_header(line, spectrum);
        } else if (!columns_named) {
            if (line != "wavelength_nm,reflectance,reflectance_se,transmittance,transmittance_se,surface_reflectance") {
                throw std::runtime_error("unknown columns: " + std::string(line));
            }
            columns_named = true;
        } else {
            const std::vector<std::string_view> fields = split(line, ',');
            if (fields.size() != 6) throw std::runtime_error("a row needs six numbers");
            const double surface = number(fields[5]);
            spectrum.wavelengths_nm.push_back(number(fields[0]));
            spectrum.reflectance.push_back({number(fields[1]), number(fields[2])});
            spectrum.transmittance.push_back({number(fields[3]), number(fields[4])});
            spectrum.surface_reflectance.push_back({surface, std::sqrt(surface * (1.0 - surface) / reference_rays)});
        }
    }
    return spectrum;
}

std::vector<ReferenceSpectrum> load_reference_spectra(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::filesystem::path& path = entry.path();
        if (path.extension() == ".csv" && !path.filename().string().starts_with("brdf_")) paths.push_back(path);
    }
    std::ranges::sort(paths);
    std::vector<ReferenceSpectrum> spectra;
    for (const std::filesystem::path& path : paths) {
        spectra.push_back(parse_reference_spectrum(path.stem().string(), read_file(path)));
    }
    return spectra;
}

std::filesystem::path test_data_folder() {
    return std::filesystem::path(SKINFIT_SOURCE_DIR) / "tests" / "data";
}

std::filesystem::path shared_folder() {
    return std::filesystem::path(SKINFIT_SOURCE_DIR).parent_path() / "shared";
}

}  // namespace skinfit::test
