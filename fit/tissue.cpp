#include "fit/tissue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "fit/chain_statistics.hpp"
#include "fit/critical_values.hpp"
#include "fit/tissue_calibration.hpp"
#include "model/chromophores.hpp"

namespace skinfit {
namespace {

constexpr double hemoglobin_g_per_mol = 64500;  // [PRAHL98]
constexpr double bilirubin_g_per_mol = 584.7;   // C33H36N4O6

/// The mean over the dermis of what is `papillary` and `reticular` in its layers, weighted by exp(-z / depth).
double sampled(const Skin& skin, double papillary, double reticular) {
    constexpr double depth_cm = 0.03;  // chosen: ranks blood of another physics best (docs/skin.md)
    const double dermis_cm = skin.papillary_dermis_thickness_cm + skin.reticular_dermis_thickness_cm;
    const double share = std::expm1(-skin.papillary_dermis_thickness_cm / depth_cm) / std::expm1(-dermis_cm / depth_cm);
    return share * papillary + (1.0 - share) * reticular;
}

double dermal_hemoglobin_umol_per_l(const Skin& skin) {
    const double blood = sampled(skin, skin.papillary_blood_fraction, skin.reticular_blood_fraction);
    return 1e6 * blood * skin.hemoglobin_g_per_l / hemoglobin_g_per_mol;
}

double epidermal_melanin_optical_depth(const Skin& skin) {
    static const Extinction extinction = Extinction::at(500, Edition::revised);  // of melanin alike in both editions
    return skin.melanosome_fraction * skin.epidermis_thickness_cm *
           (extinction.eumelanin * skin.eumelanin_g_per_l + extinction.pheomelanin * skin.pheomelanin_g_per_l);
}

double tissue_bilirubin_g_per_l(const Skin& skin) {
    const auto of = [&](double blood) {
        return blood * skin.bilirubin_g_per_l + (1.0 - blood) * skin.dermal_bilirubin_g_per_l;
    };
    return sampled(skin, of(skin.papillary_blood_fraction), of(skin.reticular_blood_fraction));
}

double tissue_bilirubin_mg_per_dl(const Skin& skin) {
    return 100.0 * tissue_bilirubin_g_per_l(skin);
}

double tissue_bilirubin_umol_per_l(const Skin& skin) {
    return 1e6 * tissue_bilirubin_g_per_l(skin) / bilirubin_g_per_mol;
}

constexpr std::array quantities = {
    TissueQuantity{"dermal_hemoglobin_umol_per_l", "umol/L", dermal_hemoglobin_umol_per_l},
    TissueQuantity{"epidermal_melanin_optical_depth", "", epidermal_melanin_optical_depth},
    TissueQuantity{"tissue_bilirubin_mg_per_dl", "mg/dL", tissue_bilirubin_mg_per_dl},
    TissueQuantity{"tissue_bilirubin_umol_per_l", "umol/L", tissue_bilirubin_umol_per_l},
};

/// How a quantity is told by one fit.
struct Definition {
    double (*value)(const Skin&);
    double model_error;  ///< standard deviation of the logarithm that the interval of the fit does not hold
};

Definition definition_of(const FitResult& result, const TissueQuantity& quantity) {
    if (quantity.value == dermal_hemoglobin_umol_per_l && has_calibrated_hemoglobin(result)) {
        return {.value = calibrated_hemoglobin_umol_per_l, .model_error = hemoglobin_model_error};
    }
    return {.value = quantity.value, .model_error = 0.0};
}

/// The skin of the answer, with free parameter `place` at `value`.
Skin skin_with(const FitResult& result, std::size_t place, double value) {
    ParameterValues values;
    for (const FittedParameter& fixed : result.fixed) value_of(values, fixed.parameter) = fixed.value;
    for (const FittedParameter& free : result.free) value_of(values, free.parameter) = free.value;
    if (place < result.free.size()) value_of(values, result.free[place].parameter) = value;
    return values.skin;
}

/// What the ends of each free parameter's interval do to the logarithm of a quantity.
struct Changes {
    Eigen::VectorXd raised;   // by the end that raises it, negative where that is the lower end
    Eigen::VectorXd lowered;  // by the other, of the same sign
};

/// None where a parameter that counts is not identifiable.
std::optional<Changes> changes_of(const FitResult& result, const Definition& definition, double value) {
    const auto count = static_cast<Eigen::Index>(result.free.size());
    Changes changes{.raised = Eigen::VectorXd(count), .lowered = Eigen::VectorXd(count)};
    for (std::size_t i = 0; i < result.free.size(); ++i) {
        const ParameterUncertainty& uncertainty = result.free[i].uncertainty;
        const double at_lower = std::log(definition.value(skin_with(result, i, uncertainty.interval_95.lower)) / value);
        const double at_upper = std::log(definition.value(skin_with(result, i, uncertainty.interval_95.upper)) / value);
        if (at_lower != at_upper && uncertainty.status == Status::not_identifiable) return std::nullopt;
        const auto place = static_cast<Eigen::Index>(i);
        changes.raised[place] = at_upper > at_lower ? at_upper : -at_lower;
        changes.lowered[place] = at_upper > at_lower ? -at_lower : at_upper;
    }
    return changes;
}

/// Of a quantity that is 0 at the answer, which has no logarithm: up to where the parameters' upper ends bring it.
std::optional<Bounds> interval_from_zero(const FitResult& result, const Definition& definition) {
    double squares = 0.0;
    for (std::size_t i = 0; i < result.free.size(); ++i) {
        const ParameterUncertainty& uncertainty = result.free[i].uncertainty;
        const double raised = definition.value(skin_with(result, i, uncertainty.interval_95.upper));
        if (raised > 0.0 && uncertainty.status == Status::not_identifiable) return std::nullopt;
        squares += raised * raised;
    }
    return Bounds{0.0, std::sqrt(squares)};
}

std::optional<Bounds> interval_of(const FitResult& result, const Definition& definition, double value) {
    if (!(value > 0.0)) return interval_from_zero(result, definition);
    const std::optional<Changes> changes = changes_of(result, definition, value);
    if (!changes) return std::nullopt;
    const auto together = [&](const Eigen::VectorXd& each) {
        const double model = normal_95 * definition.model_error;
        return std::sqrt(std::max(0.0, each.dot(result.correlation * each)) + model * model);
    };
    const double lower = changes->lowered.allFinite() ? value * std::exp(-together(changes->lowered)) : 0.0;
    return Bounds{lower, value * std::exp(together(changes->raised))};
}

/// The quantity at each draw, with a draw of the model's error.
Eigen::RowVectorXd draws_of(const FitResult& result, const Definition& definition) {
    constexpr double golden_ratio = 0.6180339887498949;  // of which the multiples fill the unit interval evenly
    const boost::math::normal standard;
    const Eigen::MatrixXd& draws = result.posterior->draws;
    Eigen::RowVectorXd values(draws.cols());
    ParameterValues at;
    at.skin = skin_with(result, result.free.size(), 0.0);
    for (Eigen::Index k = 0; k < draws.cols(); ++k) {
        for (std::size_t i = 0; i < result.free.size(); ++i) {
            value_of(at, result.free[i].parameter) = draws(static_cast<Eigen::Index>(i), k);
        }
        const double share = std::fmod(golden_ratio * static_cast<double>(k + 1), 1.0);
        values[k] =
            definition.value(at.skin) * std::exp(definition.model_error * boost::math::quantile(standard, share));
    }
    return values;
}

/// Whether the quantity moves where a parameter goes to the ends of its bounds.
bool moves(const TissueQuantity& quantity, const ParameterValues& values, Parameter parameter, const Bounds& bounds) {
    const double value = quantity.value(values.skin);
    return std::ranges::any_of(std::array{bounds.lower, bounds.upper}, [&](double end) {
        ParameterValues at_end = values;
        value_of(at_end, parameter) = end;
        return quantity.value(at_end.skin) != value;
    });
}

bool is_adjusted_by(const FitResult& result, const TissueQuantity& quantity, const Skin& skin) {
    ParameterValues values;
    values.skin = skin;
    return std::ranges::any_of(
        result.free, [&](const FittedParameter& each) { return moves(quantity, values, each.parameter, each.bounds); });
}

TissueEstimate estimate_of(const FitResult& result, const TissueQuantity& quantity, const Skin& skin) {
    const Definition definition = definition_of(result, quantity);
    TissueEstimate estimate{.quantity = &quantity,
                            .value = definition.value(skin),
                            .interval_95 = {},
                            .value_of = definition.value,
                            .is_calibrated = definition.value != quantity.value};
    if (result.posterior) {
        estimate.draws = draws_of(result, definition);
        constexpr double tail = 0.025;
        estimate.interval_95 =
            Bounds{skinfit::quantile(estimate.draws, tail), skinfit::quantile(estimate.draws, 1.0 - tail)};
    } else {
        estimate.interval_95 = interval_of(result, definition, estimate.value);
    }
    return estimate;
}

}  // namespace

std::string interval_words(const TissueEstimate& estimate) {
    const std::optional<Bounds>& interval = estimate.interval_95;
    return interval ? fmt::format("{:.3g} to {:.3g}", interval->lower, interval->upper) : "-";
}

std::string calibration_words(const std::vector<TissueEstimate>& estimates) {
    const auto found = std::ranges::find(estimates, true, &TissueEstimate::is_calibrated);
    if (found == estimates.end()) return "";
    return fmt::format(
        "{} is calibrated on skins of another physics; its interval allows for what skins differ in scattering",
        found->quantity->name);
}

std::span<const TissueQuantity> tissue_quantities() {
    return quantities;
}

const TissueQuantity* find_tissue_quantity(std::string_view name) {
    const auto found = std::ranges::find(quantities, name, &TissueQuantity::name);
    return found == quantities.end() ? nullptr : &*found;
}

bool is_adjusted(const TissueQuantity& quantity, const FitSettings& settings) {
    return std::ranges::any_of(parameter_table(), [&](const ParameterInfo& each) {
        const auto place = static_cast<std::size_t>(each.parameter);
        return settings.free[place] && moves(quantity, settings.values, each.parameter, settings.bounds[place]);
    });
}

std::vector<TissueEstimate> tissue_estimates(const FitResult& result) {
    constexpr int all_layers = 4;
    const bool has_dermis = result.spectra.front().configuration.layers == all_layers;
    const std::array<bool, parameter_count>& own = result.configuration.own;
    if (!has_dermis || std::ranges::find(own, true) != own.end()) return {};
    std::vector<TissueEstimate> estimates;
    const Skin skin = skin_with(result, result.free.size(), 0.0);
    for (const TissueQuantity& quantity : quantities) {
        if (is_adjusted_by(result, quantity, skin)) estimates.push_back(estimate_of(result, quantity, skin));
    }
    return estimates;
}

}  // namespace skinfit
