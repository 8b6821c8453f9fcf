#pragma once

#include <cmath>

namespace skinfit {

/// A plane interface seen by a ray, from index n1 to index n2. Unpolarised light, Fresnel's equations and Snell's law;
/// [KA04, Sec. 3.1].
class FresnelInterface {
public:
    constexpr FresnelInterface() = default;
    /// From index `n1` to index `n2`, both 1 or more.
    constexpr FresnelInterface(double n1, double n2) : n1_(n1), n2_(n2), ratio_squared_((n1 / n2) * (n1 / n2)) {}

    /// The share reflected of light that arrives with `cosine` to the normal, 0 to 1; 1 beyond the critical angle.
    [[nodiscard]] double reflectance(double cosine) const {
        const double transmitted = transmitted_cosine(cosine);
        if (transmitted == 0.0) return 1.0;
        const Amplitudes a = amplitudes(cosine, transmitted);
        const double perpendicular = a.perpendicular_difference / a.perpendicular_sum;
        const double parallel = a.parallel_difference / a.parallel_sum;
        return 0.5 * (perpendicular * perpendicular + parallel * parallel);
    }

    /// The cosine of the refracted light; 0 when everything is reflected.
    [[nodiscard]] double transmitted_cosine(double cosine) const {
        const double cosine_squared = 1.0 - ratio_squared_ * (1.0 - cosine * cosine);
        return cosine_squared > 0.0 ? std::sqrt(cosine_squared) : 0.0;
    }

    /// Whether `xi`, uniform in (0, 1), is below the reflectance; `transmitted` is `transmitted_cosine(cosine)`.
    /// The same as the comparison, but without its divisions, which the walk would wait for.
    [[nodiscard]] bool reflects(double xi, double cosine, double transmitted) const {
        const Amplitudes a = amplitudes(cosine, transmitted);
        const double perpendicular = a.perpendicular_difference * a.parallel_sum;
        const double parallel = a.parallel_difference * a.perpendicular_sum;
        const double both = a.perpendicular_sum * a.parallel_sum;
        return 2.0 * xi * both * both < perpendicular * perpendicular + parallel * parallel;
    }

    /// The index here, and beyond.
    [[nodiscard]] double n1() const { return n1_; }
    [[nodiscard]] double n2() const { return n2_; }
    /// (n1 / n2)^2.
    [[nodiscard]] double ratio_squared() const { return ratio_squared_; }

private:
    struct Amplitudes {
        double perpendicular_difference, perpendicular_sum, parallel_difference, parallel_sum;
    };
    [[nodiscard]] Amplitudes amplitudes(double cosine, double transmitted) const {
        const double n1c1 = n1_ * cosine;
        const double n2c2 = n2_ * transmitted;
        const double n2c1 = n2_ * cosine;
        const double n1c2 = n1_ * transmitted;
        return {n1c1 - n2c2, n1c1 + n2c2, n2c1 - n1c2, n2c1 + n1c2};
    }

    double n1_ = 1.0;
    double n2_ = 1.0;
    double ratio_squared_ = 1.0;
};

}  // namespace skinfit
