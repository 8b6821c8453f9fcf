#pragma once

#include <optional>
#include <vector>

#include "model/goniophotometer.hpp"

namespace skinfit {

/// The BRDF one way and the other way between two polar bins. Light fills the bin it comes from, so that both ways are
/// means of one function of two directions over the same pair of bins: of a reciprocal surface they are equal.
struct ReciprocityPair {
    int polar_bin_a = 0;
    int polar_bin_b = 0;
    std::optional<int> azimuth_bin;  ///< of the light that leaves; nothing: the mean over all azimuths
    BrdfValue a_to_b;
    BrdfValue b_to_a;
    double z = 0.0;  ///< their difference in standard errors; the two ways are from different rays
};

/// Compares both ways between every two of `polar_bins`, in the forward and in the backward half plane of incidence and
/// in the mean over azimuths. [KA04] does not promise reciprocity: forward scattering and the diffuse dermis do not
/// know where a ray came from. `options.incidence` is not used; `weights` as in `AngularSpectrum`; `light` leaves
/// above.
[[nodiscard]] std::vector<ReciprocityPair> compare_both_ways(const Sample& sample,
                                                             const std::vector<double>& wavelengths_nm,
                                                             const std::vector<double>& weights, Light light,
                                                             const std::vector<int>& polar_bins,
                                                             GoniophotometerOptions options);

}  // namespace skinfit
