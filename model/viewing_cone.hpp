#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/random_walk.hpp"

/// The view of an instrument that looks at the sample through a cone about the normal, as 45/0 instruments do.
namespace skinfit {

/// The cosine of the half angle; 0 for a right angle, of which the cosine of a double is not.
[[nodiscard]] double viewing_cone_cosine(double viewing_cone_rad);

/// The share of the light of a perfect white diffuser within a cone of half angle `viewing_cone_rad`; 1 without one.
[[nodiscard]] double white_share(std::optional<double> viewing_cone_rad);

/// The rays of one wavelength, and how many of those that leave through the top after having entered are seen.
struct ViewedCounts {
    WalkCounts totals;
    std::uint64_t viewed = 0;

    ViewedCounts& operator+=(const ViewedCounts& other);
};

/// `random_walk`, ray for ray, with a look at where the rays leave. Without a cone all of them are seen.
[[nodiscard]] std::vector<ViewedCounts> viewed_walk(const Sample& sample, const std::vector<double>& wavelengths_nm,
                                                    const WalkOptions& options, std::optional<double> viewing_cone_rad);

}  // namespace skinfit
