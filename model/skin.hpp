#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace skinfit {

/// The four layers, top to bottom. Interface i lies above layer i; the last interface lies above the base.
enum class Layer { stratum_corneum, epidermis, papillary_dermis, reticular_dermis };
inline constexpr std::size_t layer_count = 4;

/// One value per layer, top to bottom.
template <class Value>
using PerLayer = std::array<Value, layer_count>;

/// As JSON keys and reports have them.
inline constexpr PerLayer<std::string_view> layer_names = {"stratum_corneum", "epidermis", "papillary_dermis",
                                                           "reticular_dermis"};

/// The name of a layer as sentences have it, without underscores.
[[nodiscard]] std::string layer_in_words(std::size_t layer);

/// Which reading of the paper is computed; `model/REFERENCES.md` lists where the two differ.
enum class Edition {
    printed,  ///< the equations of [KA04] as printed
    revised,  ///< decadic extinctions times ln 10, proper Rayleigh angles, Rayleigh test at downward runs
};
inline constexpr std::array<std::string_view, 2> edition_names = {"printed", "revised"};

/// The biology and optics of one skin specimen. Defaults: [KA04, Table 1], and 0 for what the
/// paper does not have. Ranges: `parameter_table()`.
struct Skin {
    double melanosome_fraction = 0.052;        ///< volume fraction of the epidermis
    double eumelanin_g_per_l = 80;             ///< in a melanosome
    double pheomelanin_g_per_l = 12;           ///< in a melanosome
    double melanin_slope = 0;                  ///< both melanins times (wavelength / 500 nm)^-slope
    double papillary_blood_fraction = 0.012;   ///< volume fraction of the papillary dermis
    double reticular_blood_fraction = 0.0091;  ///< volume fraction of the reticular dermis
    double oxygen_saturation = 0.75;           ///< oxyhemoglobin share of the hemoglobin
    double hemoglobin_g_per_l = 150;           ///< in whole blood
    double whole_blood_share = 0;              ///< of the hemoglobin's spectra, of whole blood in place of solutions
    double bilirubin_g_per_l = 0.05;           ///< in whole blood
    double dermal_bilirubin_g_per_l = 0;       ///< in the dermis outside its blood
    double stratum_corneum_carotene_g_per_l = 2.1e-4;
    double epidermis_carotene_g_per_l = 2.1e-4;
    double dermis_carotene_g_per_l = 7.0e-5;  ///< in the blood of the dermis
    double lateral_loss_per_cm = 0;           ///< grey absorber of the dermis, for light that leaves beside the port
    double stratum_corneum_thickness_cm = 0.001;
    double epidermis_thickness_cm = 0.01;
    double papillary_dermis_thickness_cm = 0.02;
    double reticular_dermis_thickness_cm = 0.18;
    double stratum_corneum_refractive_index = 1.55;
    double epidermis_refractive_index = 1.40;
    double papillary_dermis_refractive_index = 1.36;
    double reticular_dermis_refractive_index = 1.38;
    double fibre_refractive_index = 1.5;  ///< of the collagen fibres
    double fibril_radius_nm = 25;         ///< of the collagen fibrils
    double fold_aspect_ratio =
        0.75;  ///< of the surface folds; towards 0 the folds flatten and the surface reflects like a mirror
};

/// The thickness of each layer, cm.
[[nodiscard]] PerLayer<double> thickness_cm(const Skin& skin);

/// The refractive index of each layer.
[[nodiscard]] PerLayer<double> refractive_index(const Skin& skin);

/// What lies under the lowest layer.
struct Base {
    enum class Kind {
        hypodermis,  ///< reflects everything at the lowest interface, as in [KA04, Sec. 3.1]
        matched,     ///< the ray leaves through the lowest interface untouched: thin body parts (open in [KA04])
        index,       ///< a half space of `refractive_index`: Fresnel reflection at the lowest interface
    };
    Kind kind = Kind::hypodermis;
    double refractive_index = 1.0;  ///< meaningful for Kind::index only

    bool operator==(const Base&) const = default;
};

/// A specimen as it is measured: how many of the layers, upon what, read by which edition.
struct Sample {
    Skin skin;
    Edition edition = Edition::revised;
    int layers = 4;  ///< 4: whole skin; 2: separated stratum corneum + epidermis
    Base base;       ///< for two separated layers in air: Kind::index with index 1
};

}  // namespace skinfit
