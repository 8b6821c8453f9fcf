#include "model/scattering.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>

#include "model/table.hpp"

namespace skinfit {
namespace {

/// Two neighbouring measured wavelengths and the weight of the upper one.
struct Blend {
    int lower_nm;
    int upper_nm;
    double upper_weight;
};

Blend blend_measured_wavelengths(std::span<const int> measured_nm, double wavelength_nm) {
    if (wavelength_nm <= measured_nm.front()) return {measured_nm.front(), measured_nm.front(), 0.0};
    for (std::size_t i = 1; i < measured_nm.size(); ++i) {
        if (wavelength_nm > measured_nm[i]) continue;
        const double width = measured_nm[i] - measured_nm[i - 1];
        return {measured_nm[i - 1], measured_nm[i], (wavelength_nm - measured_nm[i - 1]) / width};
    }
    return {measured_nm.back(), measured_nm.back(), 0.0};
}

/// The angle, degrees, within which `percent` of the light stays, by one column of the table.
double measured_angle_deg(std::span<const double> percents, std::span<const double> angles_deg, double percent) {
    const auto above = std::upper_bound(percents.begin() + 1, percents.end() - 1, percent);
    const auto i = static_cast<std::size_t>(above - percents.begin());
    const double share = (percent - percents[i - 1]) / (percents[i] - percents[i - 1]);
    return angles_deg[i - 1] + share * (angles_deg[i] - angles_deg[i - 1]);
}

}  // namespace

ForwardScattering::ForwardScattering(Layer layer, double wavelength_nm) {
    assert(layer == Layer::stratum_corneum || layer == Layer::epidermis);
    static constexpr std::array stratum_corneum_nm = {254, 302, 365, 436, 546};
    static constexpr std::array epidermis_nm = {302, 365, 436, 546};
    const bool is_stratum_corneum = layer == Layer::stratum_corneum;
    const Blend blend = is_stratum_corneum ? blend_measured_wavelengths(stratum_corneum_nm, wavelength_nm)
                                           : blend_measured_wavelengths(epidermis_nm, wavelength_nm);
    const char* const prefix = is_stratum_corneum ? "stratum_corneum" : "epidermis";
    const Table& table = embedded_table("forward_scattering");
    const std::vector<double>& lower = table.column(fmt::format("{}_{}_nm", prefix, blend.lower_nm));
    const std::vector<double>& upper = table.column(fmt::format("{}_{}_nm", prefix, blend.upper_nm));
    const std::vector<double>& angles_deg = table.column("polar_angle_deg");
    std::vector<double> percents;
    std::ranges::set_union(lower, upper, std::back_inserter(percents));
    knot_count_ = percents.size();
    assert(knot_count_ <= table_size);
    share_.fill(std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < knot_count_; ++i) {
        share_[i] = percents[i] / 100.0;
        angle_[i] = rad_per_deg * ((1.0 - blend.upper_weight) * measured_angle_deg(lower, angles_deg, percents[i]) +
                                   blend.upper_weight * measured_angle_deg(upper, angles_deg, percents[i]));
    }
    for (std::size_t i = 0; i + 1 < knot_count_; ++i) {
        slope_[i] = (angle_[i + 1] - angle_[i]) / (share_[i + 1] - share_[i]);
        offset_[i] = angle_[i] - slope_[i] * share_[i];
    }
    for (std::size_t i = 0; i < guide_size; ++i) {
        const double share = static_cast<double>(i) / guide_size;
        const auto* const above = std::upper_bound(share_.begin(), share_.begin() + knot_count_, share);
        guide_[i] = static_cast<std::int64_t>(above - share_.begin() - 1);
    }
}

double ForwardScattering::share_within(double polar_angle) const {
    if (polar_angle <= 0.0) return 0.0;
    if (polar_angle >= angle_[knot_count_ - 1]) return 1.0;
    const auto* const above = std::upper_bound(angle_.begin(), angle_.begin() + knot_count_, polar_angle);
    const auto segment = static_cast<std::size_t>(above - angle_.begin() - 1);
    return share_[segment] + (polar_angle - angle_[segment]) / slope_[segment];
}

double DiffuseScattering::share_below(double cosine) {
    return cosine * cosine;
}

double RayleighScattering::share_below(double cosine) const {
    if (edition_ == Edition::revised) return (cosine * cosine * cosine + 3.0 * cosine + 4.0) / 8.0;
    const double angle = std::acos(cosine);
    return 1.0 - (1.5 * angle + 0.25 * std::sin(2.0 * angle)) / (1.5 * pi);
}

double rayleigh_optical_depth(const RayleighLayer& layer) {
    constexpr double fibril_volume_share = 0.21;  // of the dermis, [KA04, Sec. 3.2]
    const double wavelength_cm = layer.wavelength_nm * cm_per_nm;
    const double radius_cm = layer.fibril_radius_nm * cm_per_nm;
    const double fibrils_per_cm3 = fibril_volume_share / (4.0 / 3.0 * pi * std::pow(radius_cm, 3));
    const double index_ratio = layer.fibre_refractive_index / layer.medium_refractive_index;
    const double contrast = index_ratio * index_ratio - 1.0;
    // [KA04, Eq. 3]
    const double per_cm =
        8.0 * std::pow(pi, 3) * contrast * contrast / (3.0 * fibrils_per_cm3) * std::pow(wavelength_cm, -4);
    return per_cm * layer.thickness_cm;
}

double FoldWarp::cosine(double xi) const {
    const double square = ratio_ * ratio_;
    if (edition_ == Edition::revised) return std::sqrt((1.0 - xi) / (1.0 + (square - 1.0) * xi));
    if (ratio_ == 1.0) return std::sqrt(xi);
    const double fourth = square * square;
    // [KA04, Eq. 1] with b inside the root
    return std::sqrt((square / std::sqrt(fourth - fourth * xi + xi) - 1.0) / (square - 1.0));
}

double FoldWarp::share_below(double cosine) const {
    const double square = ratio_ * ratio_;
    const double denominator = 1.0 + (square - 1.0) * cosine * cosine;
    if (edition_ == Edition::revised) return 1.0 - (1.0 - cosine * cosine) / denominator;
    if (ratio_ == 1.0) return cosine * cosine;
    const double fourth = square * square;
    return (fourth / (denominator * denominator) - fourth) / (1.0 - fourth);
}

}  // namespace skinfit
