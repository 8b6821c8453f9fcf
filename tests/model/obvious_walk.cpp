#include "tests/model/obvious_walk.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "model/table.hpp"

namespace skinfit::test {
namespace {

using std::numbers::pi;

struct Vector {
    double x, y, z;  // z points up, out of the skin
};

Vector operator*(double a, const Vector& v) {
    return {a * v.x, a * v.y, a * v.z};
}
Vector operator+(const Vector& a, const Vector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vector unit(const Vector& v) {
    return (1.0 / std::hypot(v.x, v.y, v.z)) * v;
}

/// `axis` turned by a polar angle and an azimuth about itself.
Vector turned(const Vector& axis, double polar, double azimuth) {
    const Vector helper = std::abs(axis.x) < 0.5 ? Vector{1, 0, 0} : Vector{0, 1, 0};
    const Vector u = unit(cross(axis, helper));
    const Vector v = cross(axis, u);
    return unit(std::cos(polar) * axis + std::sin(polar) * (std::cos(azimuth) * u + std::sin(azimuth) * v));
}

double look_up(const char* table, const char* column, double wavelength_nm) {
    return Curve(embedded_table(table), column)(wavelength_nm);
}

std::array<double, 4> absorption(const Sample& sample, double nm) {
    const Skin& s = sample.skin;
    const double ln = sample.edition == Edition::revised ? std::log(10.0) : 1.0;
    const double base = 0.244 + 85.3 * std::exp(-(nm - 154) / 66.2);
    const double carotene = ln * look_up("beta_carotene", "beta_carotene", nm) / 537;
    const double bilirubin = ln * look_up("bilirubin", "bilirubin", nm) / 585;
    const double oxy = ln * look_up("hemoglobin", "oxyhemoglobin", nm) / 66500;
    const double deoxy = ln * look_up("hemoglobin", "deoxyhemoglobin", nm) / 66500;
    const double melanin = look_up("eumelanin", "eumelanin", nm) * s.eumelanin_g_per_l +
                           look_up("pheomelanin", "pheomelanin", nm) * s.pheomelanin_g_per_l;
    const double blood = oxy * s.hemoglobin_g_per_l * s.oxygen_saturation +
                         deoxy * s.hemoglobin_g_per_l * (1 - s.oxygen_saturation) +
                         carotene * s.dermis_carotene_g_per_l + bilirubin * s.bilirubin_g_per_l;
    const double m = s.melanosome_fraction;
    const double p = s.papillary_blood_fraction;
    const double r = s.reticular_blood_fraction;
    return {base + carotene * s.stratum_corneum_carotene_g_per_l,
            melanin * m + (base + carotene * s.epidermis_carotene_g_per_l) * (1 - m), blood * p + base * (1 - p),
            blood * r + base * (1 - r)};
}

/// The angle, rad, within which `percent` of the light stays, by one column of the table.
double column_angle(const std::string& column, double percent) {
    const std::vector<double>& percents = embedded_table("forward_scattering").column(column);
    const std::vector<double>& degrees = embedded_table("forward_scattering").columns[0];
    std::size_t i = 0;
    while (percents[i + 1] < percent) ++i;
    const double share = (percent - percents[i]) / (percents[i + 1] - percents[i]);
    return (degrees[i] + share * (degrees[i + 1] - degrees[i])) * pi / 180;
}

/// The same for stratum corneum (0) or epidermis (1) at `nm`: the angles of two columns blended.
double forward_angle(std::size_t layer, double nm, double percent) {
    const std::string name = layer == 0 ? "stratum_corneum_" : "epidermis_";
    const std::vector<int> measured =
        layer == 0 ? std::vector<int>{254, 302, 365, 436, 546} : std::vector<int>{302, 365, 436, 546};
    const auto at = [&](int column_nm) { return column_angle(name + std::to_string(column_nm) + "_nm", percent); };
    if (nm <= measured.front()) return at(measured.front());
    if (nm >= measured.back()) return at(measured.back());
    std::size_t i = 0;
    while (nm > measured[i + 1]) ++i;
    const double weight = (nm - measured[i]) / (measured[i + 1] - measured[i]);
    return at(measured[i]) + weight * (at(measured[i + 1]) - at(measured[i]));
}

class Walker {
public:
    explicit Walker(const ObviousTask& task)
        : task_(task),
          layers_(task.sample.layers),
          absorption_(absorption(task.sample, task.wavelength_nm)),
          engine_(task.seed) {
        const Skin& s = task.sample.skin;
        index_ = {s.stratum_corneum_refractive_index, s.epidermis_refractive_index, s.papillary_dermis_refractive_index,
                  s.reticular_dermis_refractive_index};
        thickness_ = {s.stratum_corneum_thickness_cm, s.epidermis_thickness_cm, s.papillary_dermis_thickness_cm,
                      s.reticular_dermis_thickness_cm};
    }

    ObviousCounts follow_all() {
        ObviousCounts counts;
        for (std::uint64_t i = 0; i < task_.rays; ++i) follow(counts);
        return counts;
    }

private:
    double xi() { return (static_cast<double>(engine_() >> 11U) + 0.5) * 0x1p-53; }

    void follow(ObviousCounts& counts) {
        Vector direction = {std::sin(task_.incidence_rad), 0, -std::cos(task_.incidence_rad)};
        if (meet(direction, 1.0, index_[0])) {
            ++counts.surface;
            if (task_.on_exit) report(WayOut::surface, warped(direction));
            return;
        }
        std::size_t layer = 0;
        bool bounced = false;
        for (;;) {
            const bool turned_back = scatter(direction, layer, bounced);
            if (!turned_back) {
                const double path = -std::log(xi()) * std::abs(direction.z) / absorption_[layer];
                if (path <= thickness_[layer]) {
                    ++counts.absorbed[layer];
                    return;
                }
            }
            const bool down = direction.z < 0;
            const bool lowest = down && layer + 1 == static_cast<std::size_t>(layers_);
            if (!down && layer == 0) {
                if (!meet(direction, index_[0], 1.0)) {
                    ++counts.subsurface;
                    report(WayOut::subsurface, direction);
                    return;
                }
            } else if (lowest) {
                if (!reflected_by_base(direction, layer)) {
                    ++counts.transmitted;
                    report(WayOut::transmitted, direction);
                    return;
                }
                bounced = true;
            } else {
                const std::size_t other = down ? layer + 1 : layer - 1;
                if (meet(direction, index_[layer], index_[other])) {
                    // Interfaces 3 and 4 bound the papillary dermis, layer 2.
                    if (layer == 2 || other == 2) bounced = true;
                } else {
                    layer = other;
                }
            }
        }
    }

    void report(WayOut way_out, const Vector& direction) const {
        if (task_.on_exit) task_.on_exit({way_out, direction.x, direction.y, direction.z});
    }

    /// The mirror direction `mirror` as the folds of the skin perturb it, above the horizon.
    Vector warped(const Vector& mirror) {
        for (;;) {
            const Vector direction = turned(mirror, fold_angle(), 2 * pi * xi());
            if (direction.z > 0) return direction;
        }
    }

    double fold_angle() {
        const double sigma = task_.sample.skin.fold_aspect_ratio;
        const double u = xi();
        if (task_.sample.edition == Edition::revised)
            return std::acos(std::sqrt((1 - u) / (1 + (sigma * sigma - 1) * u)));
        const double fourth = std::pow(sigma, 4);
        return std::acos(std::sqrt((sigma * sigma / std::sqrt(fourth - fourth * u + u) - 1) / (sigma * sigma - 1)));
    }

    bool reflected_by_base(Vector& direction, std::size_t layer) {
        switch (task_.sample.base.kind) {
            case Base::Kind::matched:
                return false;
            case Base::Kind::hypodermis:
                direction.z = -direction.z;
                return true;
            default:
                return meet(direction, index_[layer], task_.sample.base.refractive_index);
        }
    }

    /// Reflects the ray (true) or refracts it (false) at a plane interface from n1 to n2.
    bool meet(Vector& direction, double n1, double n2) {
        const double theta1 = std::acos(std::min(1.0, std::abs(direction.z)));
        const double sine2 = n1 / n2 * std::sin(theta1);
        if (sine2 >= 1.0) {
            direction.z = -direction.z;
            return true;
        }
        const double theta2 = std::asin(sine2);
        const double c1 = std::cos(theta1);
        const double c2 = std::cos(theta2);
        const double s = std::pow((n1 * c1 - n2 * c2) / (n1 * c1 + n2 * c2), 2);
        const double p = std::pow((n1 * c2 - n2 * c1) / (n1 * c2 + n2 * c1), 2);
        if (xi() < 0.5 * (s + p)) {
            direction.z = -direction.z;
            return true;
        }
        const double up = direction.z > 0 ? 1.0 : -1.0;
        direction = unit({n1 / n2 * direction.x, n1 / n2 * direction.y, up * c2});
        return false;
    }

    /// The new direction at the start of a run; true when a Rayleigh scattering has turned the ray back.
    bool scatter(Vector& direction, std::size_t layer, bool bounced) {
        const bool down = direction.z < 0;
        const auto turned_back = [&](const Vector& v) { return down ? v.z >= 0 : v.z <= 0; };
        if (layer < 2) {
            Vector next = direction;
            do {
                next = turned(direction, forward_angle(layer, task_.wavelength_nm, 100 * xi()), 2 * pi * xi());
            } while (turned_back(next));
            direction = next;
            return false;
        }
        const bool asked = task_.rule == RayleighRule::until_bounced ? !bounced : down;
        if (asked && xi() < 1 - std::exp(-rayleigh_beta(layer) * thickness_[layer] / std::abs(direction.z))) {
            direction = turned(direction, rayleigh_angle(), 2 * pi * xi());
            return turned_back(direction);
        }
        const Vector normal = {0, 0, down ? -1.0 : 1.0};
        direction = turned(normal, std::acos(std::sqrt(xi())), 2 * pi * xi());
        return false;
    }

    double rayleigh_angle() {
        for (;;) {
            const double proposed = xi();
            const double psi = task_.sample.edition == Edition::printed ? pi * proposed : std::acos(1 - 2 * proposed);
            if (1.5 * xi() <= 0.75 * (1 + std::cos(psi) * std::cos(psi))) return psi;
        }
    }

    [[nodiscard]] double rayleigh_beta(std::size_t layer) const {
        const Skin& s = task_.sample.skin;
        const double r = s.fibril_radius_nm * 1e-7;
        const double lambda = task_.wavelength_nm * 1e-7;
        const double density = 0.21 / (4.0 / 3.0 * pi * r * r * r);
        const double ratio = s.fibre_refractive_index / index_[layer];
        return 8 * pi * pi * pi * std::pow(ratio * ratio - 1, 2) / (3 * density * std::pow(lambda, 4));
    }

    ObviousTask task_;
    int layers_;
    std::array<double, 4> absorption_;
    std::array<double, 4> index_{};
    std::array<double, 4> thickness_{};
    std::mt19937_64 engine_;
};

}  // namespace

ObviousCounts obvious_walk(const ObviousTask& task) {
    return Walker(task).follow_all();
}

}  // namespace skinfit::test
