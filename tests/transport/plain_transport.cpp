#include "tests/transport/plain_transport.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace skinfit::test {
namespace {

using Fate = PlainPhoton::Fate;

struct Vector {
    double x, y, z;
};

Vector cross_product(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

double length_of(const Vector& a) {
    return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
}

class PlainWalk {
public:
    PlainWalk(const TurbidStack& stack, const PerTurbidLayer& absorption, unsigned seed)
        : stack_(stack), absorption_(absorption), random_(seed) {
        tops_ = {0.0};
        for (const TurbidLayer& layer : stack.layers) tops_.push_back(tops_.back() + layer.thickness_cm);
    }

    PlainPhoton follow(double incidence_rad) {
        where_ = {0, 0, 0};
        direction_ = {std::sin(incidence_rad), 0, std::cos(incidence_rad)};
        layer_ = -1;
        if (!passes(0)) return end(Fate::first_reflection);
        for (;;) {
            const TurbidLayer& layer = stack_.layers[static_cast<std::size_t>(layer_)];
            const double absorption = absorption_[static_cast<std::size_t>(layer_)];
            const double step = -std::log(xi()) / (layer.scattering_per_cm + absorption);
            const int next = direction_.z > 0 ? layer_ + 1 : layer_ - 1;
            const double plane = tops_[static_cast<std::size_t>(std::max(layer_, next))];
            const double to_plane = (plane - where_.z) / direction_.z;
            if (to_plane < step) {
                move(to_plane);
                where_.z = plane;
                (void)passes(next);
                if (layer_ < 0) return end(Fate::top);
                if (layer_ == static_cast<int>(stack_.layers.size())) return end(Fate::bottom);
                continue;
            }
            move(step);
            if (xi() * (layer.scattering_per_cm + absorption) < absorption) return end(Fate::absorbed);
            scatter(layer.anisotropy);
        }
    }

private:
    double xi() { return std::uniform_real_distribution<>(0x1p-60, 1.0)(random_); }

    double index(int layer) const {
        if (layer < 0) return stack_.index_above;
        if (layer == static_cast<int>(stack_.layers.size())) return stack_.index_below;
        return stack_.layers[static_cast<std::size_t>(layer)].refractive_index;
    }

    void move(double distance) {
        where_ = {where_.x + distance * direction_.x, where_.y + distance * direction_.y,
                  where_.z + distance * direction_.z};
    }

    PlainPhoton end(Fate fate) const { return {fate, where_.x, where_.y, std::fabs(direction_.z)}; }

    /// Fresnel's equations by the sum and difference of the angles.
    bool passes(int next) {
        const double n1 = index(layer_);
        const double n2 = index(next);
        const double angle = std::acos(std::min(1.0, std::fabs(direction_.z)));
        const double sine = n1 / n2 * std::sin(angle);
        double reflectance = 1.0;
        if (sine < 1.0) {
            const double beyond = std::asin(sine);
            const double s = std::sin(angle - beyond) / std::sin(angle + beyond);
            const double p = std::tan(angle - beyond) / std::tan(angle + beyond);
            reflectance = angle < 1e-6 ? std::pow((n1 - n2) / (n1 + n2), 2) : 0.5 * (s * s + p * p);
        }
        if (xi() < reflectance) {
            direction_.z = -direction_.z;
            return false;
        }
        direction_.x *= n1 / n2;
        direction_.y *= n1 / n2;
        direction_.z = std::copysign(std::sqrt(1.0 - sine * sine), direction_.z);
        layer_ = next;
        return true;
    }

    /// The deflection by rejection from the law itself, about two axes across the direction.
    void scatter(double g) {
        double cosine = 0.0;
        const double highest = (1.0 + std::fabs(g)) / std::pow(1.0 - std::fabs(g), 2);
        do {
            cosine = 2.0 * xi() - 1.0;
        } while (xi() * highest > (1.0 - g * g) / std::pow(1.0 + g * g - 2.0 * g * cosine, 1.5));
        const double sine = std::sqrt(1.0 - cosine * cosine);
        const double azimuth = 2.0 * std::numbers::pi * xi();
        const Vector helper = std::fabs(direction_.x) < 0.5 ? Vector{1, 0, 0} : Vector{0, 1, 0};
        Vector a = cross_product(direction_, helper);
        const double norm = length_of(a);
        a = {a.x / norm, a.y / norm, a.z / norm};
        const Vector b = cross_product(direction_, a);
        const double ca = sine * std::cos(azimuth);
        const double sa = sine * std::sin(azimuth);
        direction_ = {cosine * direction_.x + ca * a.x + sa * b.x, cosine * direction_.y + ca * a.y + sa * b.y,
                      cosine * direction_.z + ca * a.z + sa * b.z};
        const double length = length_of(direction_);
        direction_ = {direction_.x / length, direction_.y / length, direction_.z / length};
    }

    TurbidStack stack_;
    PerTurbidLayer absorption_;
    std::mt19937_64 random_;
    std::vector<double> tops_;
    Vector where_{};
    Vector direction_{};
    int layer_ = 0;
};

}  // namespace

std::vector<PlainPhoton> plain_transport(const TurbidStack& stack, const PerTurbidLayer& absorption,
                                         double incidence_rad, std::uint64_t photons, unsigned seed) {
    PlainWalk walk(stack, absorption, seed);
    std::vector<PlainPhoton> ends;
    for (std::uint64_t i = 0; i < photons; ++i) ends.push_back(walk.follow(incidence_rad));
    return ends;
}

std::uint64_t count_of(const std::vector<PlainPhoton>& photons, PlainPhoton::Fate fate) {
    return static_cast<std::uint64_t>(std::ranges::count(photons, fate, &PlainPhoton::fate));
}

}  // namespace skinfit::test
