#include "study/transport_plan.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "fit/json_reading.hpp"
#include "fit/prior.hpp"
#include "fit/prior_json.hpp"

namespace skinfit {
namespace {

const std::string transport_example =
    R"(write it as in {"scattering_at_500_nm_per_cm": {"kind": "normal", "mean": 46, "sigma": 10, "lower": 20, )"
    R"("upper": 80}, "port_diameter_mm": 5}; {} takes the defaults)";

/// Where a skin of the second physics has a parameter of the model.
struct SharedField {
    Parameter parameter;
    double LayeredSkin::*layered;
    double Skin::*modelled;
};

constexpr std::array shared_fields = {
    SharedField{Parameter::melanosome_fraction, &LayeredSkin::melanosome_fraction, &Skin::melanosome_fraction},
    SharedField{Parameter::papillary_blood_fraction, &LayeredSkin::papillary_blood_fraction,
                &Skin::papillary_blood_fraction},
    SharedField{Parameter::reticular_blood_fraction, &LayeredSkin::reticular_blood_fraction,
                &Skin::reticular_blood_fraction},
    SharedField{Parameter::oxygen_saturation, &LayeredSkin::oxygen_saturation, &Skin::oxygen_saturation},
    SharedField{Parameter::hemoglobin_g_per_l, &LayeredSkin::hemoglobin_g_per_l, &Skin::hemoglobin_g_per_l},
    SharedField{Parameter::dermal_bilirubin_g_per_l, &LayeredSkin::dermal_bilirubin_g_per_l,
                &Skin::dermal_bilirubin_g_per_l},
    SharedField{Parameter::stratum_corneum_thickness_cm, &LayeredSkin::stratum_corneum_thickness_cm,
                &Skin::stratum_corneum_thickness_cm},
    SharedField{Parameter::epidermis_thickness_cm, &LayeredSkin::epidermis_thickness_cm, &Skin::epidermis_thickness_cm},
    SharedField{Parameter::papillary_dermis_thickness_cm, &LayeredSkin::papillary_dermis_thickness_cm,
                &Skin::papillary_dermis_thickness_cm},
    SharedField{Parameter::reticular_dermis_thickness_cm, &LayeredSkin::reticular_dermis_thickness_cm,
                &Skin::reticular_dermis_thickness_cm},
    SharedField{Parameter::stratum_corneum_refractive_index, &LayeredSkin::stratum_corneum_refractive_index,
                &Skin::stratum_corneum_refractive_index},
    SharedField{Parameter::epidermis_refractive_index, &LayeredSkin::epidermis_refractive_index,
                &Skin::epidermis_refractive_index},
};

DrawnNumber held(double value) {
    return {.prior = {}, .bounds = {value, value}};
}

DrawnNumber read_drawn_number(const Json& json, const Range& accepted, const std::string& where) {
    if (json.is_number()) return held(read_number(json, accepted, where));
    require_object(json, where, transport_example);
    for (const char* key : {"lower", "upper"}) {
        if (!json.contains(key)) refuse(where, json, "what is drawn needs lower and upper limits", transport_example);
    }
    DrawnNumber number;
    number.bounds = {read_number(json["lower"], accepted, where + ".lower"),
                     read_number(json["upper"], accepted, where + ".upper")};
    if (!(number.bounds.lower < number.bounds.upper)) {
        refuse(where, json, "the upper limit is not above the lower one", "exchange them, or give a number alone");
    }
    Json prior = json;
    prior.erase("lower");
    prior.erase("upper");
    number.prior = read_prior(prior, where);
    constexpr double least_mass = 1e-6;  // chosen: what is left of a distribution can still be told
    if (number.prior && !(mass_within(*number.prior, number.bounds) > least_mass)) {
        refuse(where, json, "the distribution gives its limits no probability", "move one of them");
    }
    return number;
}

Json drawn_json(const DrawnNumber& number) {
    if (!number.varies()) return number.bounds.lower;
    Json json = number.prior ? to_json(*number.prior) : Json{{"kind", "uniform"}};
    json["lower"] = number.bounds.lower;
    json["upper"] = number.bounds.upper;
    return json;
}

}  // namespace

double DrawnNumber::drawn(double uniform) const {
    if (prior) return quantile_within(*prior, bounds, uniform);
    return bounds.lower + uniform * (bounds.upper - bounds.lower);
}

TransportPlan read_transport_plan(const Json& json, const std::string& where) {
    // Chosen: from a tenth of to ten times what tissues have [JACQUES13].
    constexpr Range scattering_per_cm = {1, 1000};
    constexpr Range power = {-1, 5};
    constexpr Range diameter_mm = {port_diameters_mm.lower, port_diameters_mm.upper};
    constexpr std::uint64_t fewest_photons = 1000;
    constexpr std::uint64_t most_photons = 100'000'000;
    require_names(json, {"scattering_at_500_nm_per_cm", "scattering_power", "port_diameter_mm", "photons"},
                  {{}, "", transport_example}, where);
    const ScatteringLaw law = LayeredSkin{}.scattering;
    TransportPlan plan{.scattering_at_500_nm_per_cm = held(law.at_500_nm_per_cm),
                       .scattering_power = held(law.power),
                       .port_diameter_mm = {}};
    const auto take = [&](const char* key, const auto& read) {
        if (json.contains(key) && !json[key].is_null()) read(json[key], where + "." + key);
    };
    take("scattering_at_500_nm_per_cm", [&](const Json& value, const std::string& here) {
        plan.scattering_at_500_nm_per_cm = read_drawn_number(value, scattering_per_cm, here);
    });
    take("scattering_power", [&](const Json& value, const std::string& here) {
        plan.scattering_power = read_drawn_number(value, power, here);
    });
    take("port_diameter_mm", [&](const Json& value, const std::string& here) {
        plan.port_diameter_mm = read_number(value, diameter_mm, here);
    });
    take("photons", [&](const Json& value, const std::string& here) {
        plan.photons = read_count(value, fewest_photons, most_photons, here);
    });
    return plan;
}

Json to_json(const TransportPlan& plan) {
    return {{"scattering_at_500_nm_per_cm", drawn_json(plan.scattering_at_500_nm_per_cm)},
            {"scattering_power", drawn_json(plan.scattering_power)},
            {"port_diameter_mm", plan.port_diameter_mm ? Json(*plan.port_diameter_mm) : Json()},
            {"photons", plan.photons}};
}

std::span<const Parameter> transport_parameters() {
    static const std::vector<Parameter> parameters = [] {
        std::vector<Parameter> all;
        for (const SharedField& field : shared_fields) all.push_back(field.parameter);
        all.insert(all.end(), {Parameter::scale, Parameter::offset});
        return all;
    }();
    return parameters;
}

Configuration with_layered_skin(Configuration configuration) {
    for (const SharedField& field : shared_fields) {
        configuration.values.skin.*field.modelled = LayeredSkin{}.*field.layered;
    }
    return configuration;
}

void check_transport_parameter(std::string_view name, const std::string& where) {
    std::vector<std::string_view> known;
    for (const Parameter parameter : transport_parameters()) known.push_back(info(parameter).name);
    known.push_back(derived_table()[static_cast<std::size_t>(Derived::total_blood_fraction)].name);
    if (std::ranges::find(known, name) != known.end()) return;
    const std::vector<std::string_view> all = prior_names();
    if (std::ranges::find(all, name) == all.end()) refuse_unknown(where, name, known);
    refuse(where, std::string(name), "the layered transport has no such parameter",
           "leave it out; `transport` beside it makes the spectra");
}

LayeredSkin layered_skin(const Skin& skin, const ScatteringLaw& scattering) {
    LayeredSkin layered;
    layered.scattering = scattering;
    for (const SharedField& field : shared_fields) layered.*field.layered = skin.*field.modelled;
    return layered;
}

}  // namespace skinfit
