#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <ostream>
#include <string>
#include <vector>

#include "model/constants.hpp"
#include "model/skin.hpp"

/// The specimens on which the angular solver is tested.
namespace skinfit {

struct AngularCase {
    std::string name;  ///< of the file in ../shared/reference where there is one
    Sample sample;
    double incidence_rad;
};

/// What GoogleTest prints of a case.
inline void PrintTo(const AngularCase& angular, std::ostream* out) {
    *out << angular.name;
}

inline AngularCase angular_case(const std::string& name, Edition edition, double incidence_deg,
                                void (*change)(Sample&)) {
    AngularCase result{.name = name, .sample = {}, .incidence_rad = incidence_deg * rad_per_deg};
    result.sample.edition = edition;
    change(result.sample);
    return result;
}

/// The cases of ../shared/reference.
inline std::vector<AngularCase> reference_cases() {
    const auto table1 = [](Sample&) {};
    return {
        angular_case("revised_table1_45deg", Edition::revised, 45, table1),
        angular_case("printed_table1_45deg", Edition::printed, 45, table1),
        angular_case("printed_erythema_fig8_right_45deg", Edition::printed, 45,
                     [](Sample& sample) {
                         sample.skin.papillary_blood_fraction = 0.036;
                         sample.skin.reticular_blood_fraction = 0.004;
                     }),
        angular_case("printed_everett_moderate_in_air_0deg", Edition::printed, 0,
                     [](Sample& sample) {
                         sample.layers = 2;
                         sample.base = {.kind = Base::Kind::index, .refractive_index = 1.0};
                         sample.skin.stratum_corneum_thickness_cm = 0.0017;
                         sample.skin.epidermis_thickness_cm = 0.0025;
                         sample.skin.melanosome_fraction = 0.095;
                     }),
        angular_case("revised_jaundice_3g_per_l_8deg", Edition::revised, 8,
                     [](Sample& sample) { sample.skin.bilirubin_g_per_l = 3.0; }),
        angular_case("revised_melanosomes_10pct_8deg", Edition::revised, 8,
                     [](Sample& sample) { sample.skin.melanosome_fraction = 0.10; }),
        angular_case("revised_no_hypodermis_melanosomes_1.9pct_0deg", Edition::revised, 0,
                     [](Sample& sample) {
                         sample.base.kind = Base::Kind::matched;
                         sample.skin.melanosome_fraction = 0.019;
                     }),
        angular_case("revised_thin_dermis_45deg", Edition::revised, 45,
                     [](Sample& sample) {
                         sample.skin.papillary_dermis_thickness_cm = 0.01;
                         sample.skin.reticular_dermis_thickness_cm = 0.08;
                     }),
    };
}

/// The reference cases and the bases and editions that they leave out.
inline std::vector<AngularCase> all_angular_cases() {
    std::vector<AngularCase> cases = reference_cases();
    cases.push_back(angular_case("printed_on_index_60deg", Edition::printed, 60, [](Sample& sample) {
        sample.base = {.kind = Base::Kind::index, .refractive_index = 1.2};
        sample.skin.reticular_dermis_thickness_cm = 0.05;
    }));
    cases.push_back(angular_case("printed_matched_20deg", Edition::printed, 20, [](Sample& sample) {
        sample.base.kind = Base::Kind::matched;
        sample.skin.melanosome_fraction = 0.01;
    }));
    cases.push_back(angular_case("revised_two_layers_matched_70deg", Edition::revised, 70, [](Sample& sample) {
        sample.layers = 2;
        sample.base.kind = Base::Kind::matched;
    }));
    cases.push_back(angular_case("revised_on_denser_index_30deg", Edition::revised, 30, [](Sample& sample) {
        sample.base = {.kind = Base::Kind::index, .refractive_index = 1.5};
        sample.skin.stratum_corneum_refractive_index = 1.35;  // below the epidermis, unlike the others
    }));
    return cases;
}

/// The name of a parametrised test.
inline std::string case_name(const testing::TestParamInfo<AngularCase>& info) {
    std::string name = info.param.name;
    std::ranges::replace_if(
        name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
}

}  // namespace skinfit
