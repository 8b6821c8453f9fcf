#include "model/parameters.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string_view>
#include <vector>

#include "model/path_ensemble.hpp"

namespace skinfit {
namespace {

struct NamedField {
    std::string_view name;
    double* value;
};

/// Every field of `values`, named by the preprocessor as it is spelled in C++, in the order of `Parameter`.
std::array<NamedField, parameter_count> fields_of(ParameterValues& values) {
#define SKINFIT_FIELD(part, field) \
    NamedField {                   \
#field, &values.part.field \
    }
    return {{SKINFIT_FIELD(skin, melanosome_fraction),
             SKINFIT_FIELD(skin, eumelanin_g_per_l),
             SKINFIT_FIELD(skin, pheomelanin_g_per_l),
             SKINFIT_FIELD(skin, melanin_slope),
             SKINFIT_FIELD(skin, papillary_blood_fraction),
             SKINFIT_FIELD(skin, reticular_blood_fraction),
             SKINFIT_FIELD(skin, oxygen_saturation),
             SKINFIT_FIELD(skin, hemoglobin_g_per_l),
             SKINFIT_FIELD(skin, whole_blood_share),
             SKINFIT_FIELD(skin, bilirubin_g_per_l),
             SKINFIT_FIELD(skin, dermal_bilirubin_g_per_l),
             SKINFIT_FIELD(skin, stratum_corneum_carotene_g_per_l),
             SKINFIT_FIELD(skin, epidermis_carotene_g_per_l),
             SKINFIT_FIELD(skin, dermis_carotene_g_per_l),
             SKINFIT_FIELD(skin, lateral_loss_per_cm),
             SKINFIT_FIELD(skin, stratum_corneum_thickness_cm),
             SKINFIT_FIELD(skin, epidermis_thickness_cm),
             SKINFIT_FIELD(skin, papillary_dermis_thickness_cm),
             SKINFIT_FIELD(skin, reticular_dermis_thickness_cm),
             SKINFIT_FIELD(skin, stratum_corneum_refractive_index),
             SKINFIT_FIELD(skin, epidermis_refractive_index),
             SKINFIT_FIELD(skin, papillary_dermis_refractive_index),
             SKINFIT_FIELD(skin, reticular_dermis_refractive_index),
             SKINFIT_FIELD(skin, fibre_refractive_index),
             SKINFIT_FIELD(skin, fibril_radius_nm),
             SKINFIT_FIELD(skin, fold_aspect_ratio),
             SKINFIT_FIELD(instrument, scale),
             SKINFIT_FIELD(instrument, offset),
             SKINFIT_FIELD(instrument, specular_fraction),
             SKINFIT_FIELD(instrument, wavelength_shift_nm)}};
#undef SKINFIT_FIELD
}

TEST(Parameters, TableFollowsTheEnum) {
    for (std::size_t i = 0; i < parameter_count; ++i) {
        const auto parameter = static_cast<Parameter>(i);
        EXPECT_EQ(parameter_table()[i].parameter, parameter);
        EXPECT_EQ(info(parameter).name, parameter_table()[i].name);
    }
    EXPECT_EQ(static_cast<std::size_t>(Parameter::wavelength_shift_nm) + 1, parameter_count);
}

TEST(Parameters, HoldEveryFieldAndNothingElse) {
    // A field without a parameter would make the structs larger than the vocabulary.
    EXPECT_EQ(sizeof(ParameterValues), parameter_count * sizeof(double));
    std::set<std::string_view> names;
    for (const ParameterInfo& row : parameter_table()) names.insert(row.name);
    EXPECT_EQ(names.size(), parameter_count);
}

TEST(Parameters, NameIsTheFieldItReads) {
    ParameterValues values;
    const auto fields = fields_of(values);
    for (std::size_t i = 0; i < parameter_count; ++i) {
        const auto parameter = static_cast<Parameter>(i);
        EXPECT_EQ(info(parameter).name, fields[i].name);
        EXPECT_EQ(find_parameter(fields[i].name), parameter);
        EXPECT_EQ(&value_of(values, parameter), fields[i].value) << fields[i].name;
        value_of(values, parameter) = 1000.0 + static_cast<double>(i);
    }
    const ParameterValues& read_only = values;
    for (std::size_t i = 0; i < parameter_count; ++i) {
        EXPECT_EQ(value_of(read_only, static_cast<Parameter>(i)), 1000.0 + static_cast<double>(i));
    }
    EXPECT_EQ(find_parameter("melanosomes"), std::nullopt);
    EXPECT_EQ(find_parameter(""), std::nullopt);
}

TEST(Parameters, DefaultLiesWithinBoundsWithinAcceptedRange) {
    const ParameterValues defaults;
    for (const ParameterInfo& row : parameter_table()) {
        const double value = value_of(defaults, row.parameter);
        EXPECT_LE(row.lowest, row.lower) << row.name;
        EXPECT_LT(row.lower, row.upper) << row.name;
        EXPECT_LE(row.upper, row.highest) << row.name;
        EXPECT_LE(row.lower, value) << row.name;
        EXPECT_LE(value, row.upper) << row.name;
    }
}

TEST(Parameters, UnitIsInTheName) {
    for (const ParameterInfo& row : parameter_table()) {
        EXPECT_EQ(row.unit == "g/L", row.name.ends_with("_g_per_l")) << row.name;
        EXPECT_EQ(row.unit == "1/cm", row.name.ends_with("_per_cm")) << row.name;
        EXPECT_EQ(row.unit == "cm" || row.unit == "1/cm", row.name.ends_with("_cm")) << row.name;
        EXPECT_EQ(row.unit == "nm", row.name.ends_with("_nm")) << row.name;
        EXPECT_FALSE(row.meaning.empty()) << row.name;
        EXPECT_FALSE(row.source.empty()) << row.name;
    }
}

TEST(Parameters, LayersAreReadTopToBottom) {
    Skin skin;
    skin.stratum_corneum_thickness_cm = 1;
    skin.epidermis_thickness_cm = 2;
    skin.papillary_dermis_thickness_cm = 3;
    skin.reticular_dermis_thickness_cm = 4;
    EXPECT_EQ(thickness_cm(skin), (PerLayer<double>{1, 2, 3, 4}));
    EXPECT_EQ(refractive_index(Skin{}), (PerLayer<double>{1.55, 1.40, 1.36, 1.38}));
}

/// The paths of 10000 rays at 800 nm, where few enough are sure to be Rayleigh scattered, as recorded.
std::vector<float> paths_of(const Skin& skin) {
    const PathEnsemble ensemble = PathEnsemble::trace({.skin = skin, .base = {}}, {800}, {.rays = 10'000});
    const std::span<const float> lengths = ensemble.recording().lengths;
    return {lengths.begin(), lengths.end()};
}

TEST(Parameters, SteerWhereTheTableSaysSo) {
    const std::vector<float> paths = paths_of({});
    for (std::size_t i = 0; i < static_cast<std::size_t>(Parameter::fold_aspect_ratio); ++i) {
        const ParameterInfo& row = info(static_cast<Parameter>(i));
        ParameterValues changed;
        value_of(changed, row.parameter) *= 1.05;
        EXPECT_EQ(paths_of(changed.skin) != paths, row.steers) << row.name;
    }
}

}  // namespace
}  // namespace skinfit
