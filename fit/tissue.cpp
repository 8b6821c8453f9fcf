#include "fit/tissue.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "fit/chain_statistics.hpp"
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
std::optional<Changes> changes_of(const FitResult& result, const TissueQuantity& quantity, double value) {
    const auto count = static_cast<Eigen::Index>(result.free.size());
    Changes changes{.raised = Eigen::VectorXd(count), .lowered = Eigen::VectorXd(count)};
    for (std::size_t i = 0; i < result.free.size(); ++i) {
        const ParameterUncertainty& uncertainty = result.free[i].uncertainty;
        const double at_lower = std::log(quantity.value(skin_with(result, i, uncertainty.interval_95.lower)) / value);
        const double at_upper = std::log(quantity.value(skin_with(result, i, uncertainty.interval_95.upper)) / value);
        if (at_lower != at_upper && uncertainty.status == Status::not_identifiable) return std::nullopt;
        const auto place = static_cast<Eigen::Index>(i);
        changes.raised[place] = at_upper > at_lower ? at_upper : -at_lower;
        changes.lowered[place] = at_upper > at_lower ? -at_lower : at_upper;
    }
    return changes;
}

/// Of a quantity that is 0 at the answer, which has no logarithm: up to where the parameters' upper ends bring it.
std::optional<Bounds> interval_from_zero(const FitResult& result, const TissueQuantity& quantity) {
    double squares = 0.0;
    for (std::size_t i = 0; i < result.free.size(); ++i) {
        const ParameterUncertainty& uncertainty = result.free[i].uncertainty;
        const double raised = quantity.value(skin_with(result, i, uncertainty.interval_95.upper));
        if (raised > 0.0 && uncertainty.status == Status::not_identifiable) return std::nullopt;
        squares += raised * raised;
    }
    return Bounds{0.0, std::sqrt(squares)};
}

std::optional<Bounds> interval_of(const FitResult& result, const TissueQuantity& quantity, double value) {
    if (!(value > 0.0)) return interval_from_zero(result, quantity);
    const std::optional<Changes> changes = changes_of(result, quantity, value);
    if (!changes) return std::nullopt;
    const auto together = [&](const Eigen::VectorXd& each) {
        return std::sqrt(std::max(0.0, each.dot(result.correlation * each)));
    };
    const double lower = changes->lowered.allFinite() ? value * std::exp(-together(changes->lowered)) : 0.0;
    return Bounds{lower, value * std::exp(together(changes->raised))};
}

std::optional<Bounds> interval_of_draws(const FitResult& result, const TissueQuantity& quantity) {
    const Eigen::MatrixXd& draws = result.posterior->draws;
    Eigen::MatrixXd values(1, draws.cols());
    ParameterValues at;
    at.skin = skin_with(result, result.free.size(), 0.0);
    for (Eigen::Index k = 0; k < draws.cols(); ++k) {
        for (std::size_t i = 0; i < result.free.size(); ++i) {
            value_of(at, result.free[i].parameter) = draws(static_cast<Eigen::Index>(i), k);
        }
        values(0, k) = quantity.value(at.skin);
    }
    constexpr double tail = 0.025;
    return Bounds{skinfit::quantile(values, tail), skinfit::quantile(values, 1.0 - tail)};
}

/// Whether the quantity moves with anything that the fit adjusts.
bool is_adjusted(const FitResult& result, const TissueQuantity& quantity, double value) {
    for (std::size_t i = 0; i < result.free.size(); ++i) {
        const Bounds& bounds = result.free[i].bounds;
        for (const double end : {bounds.lower, bounds.upper}) {
            if (quantity.value(skin_with(result, i, end)) != value) return true;
        }
    }
    return false;
}

}  // namespace

std::span<const TissueQuantity> tissue_quantities() {
    return quantities;
}

std::vector<TissueEstimate> tissue_estimates(const FitResult& result) {
    constexpr int all_layers = 4;
    const bool has_dermis = result.spectra.front().configuration.layers == all_layers;
    const std::array<bool, parameter_count>& own = result.configuration.own;
    if (!has_dermis || std::ranges::find(own, true) != own.end()) return {};
    std::vector<TissueEstimate> estimates;
    const Skin skin = skin_with(result, result.free.size(), 0.0);
    for (const TissueQuantity& quantity : quantities) {
        const double value = quantity.value(skin);
        if (!is_adjusted(result, quantity, value)) continue;
        estimates.push_back({.quantity = &quantity,
                             .value = value,
                             .interval_95 = result.posterior ? interval_of_draws(result, quantity)
                                                             : interval_of(result, quantity, value)});
    }
    return estimates;
}

}  // namespace skinfit
