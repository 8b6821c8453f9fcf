#pragma once

namespace skinfit {

/// The cosine of the angle by which a photon is deflected, for `xi` uniform in (0, 1) and an `anisotropy` between -1
/// and 1; the law of [HENYEY41], whose mean cosine is the anisotropy. Inverted as in [WANG95], but multiplied
/// out in 2 xi - 1, so that it has no division by the anisotropy and holds for isotropic scattering too.
[[nodiscard]] constexpr double henyey_greenstein_cosine(double anisotropy, double xi) {
    const double g = anisotropy;
    const double s = 2.0 * xi - 1.0;
    const double root = 1.0 + g * s;
    return (s + g * (0.5 * (s * s + 3.0) + g * (s + 0.5 * g * (s * s - 1.0)))) / (root * root);
}

}  // namespace skinfit
