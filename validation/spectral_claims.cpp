#include "validation/spectral_claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

namespace skinfit {
namespace {

/// The median repeat scatter of skin reflectance, and what 95 % of repeats stay below. [COOKSEY17]
constexpr double median_repeat_scatter = 0.006;
constexpr double largest_repeat_scatter = 0.017;

/// Wavelengths of a measurement that a curve reaches, and what was measured there.
struct Overlap {
    std::vector<double> wavelength_nm;
    std::vector<double> measured;
};

Overlap overlap(const SpectralCurve& curve, const Spectrum& measured) {
    Overlap common;
    for (std::size_t i = 0; i < measured.wavelength_nm.size(); ++i) {
        const double at_nm = measured.wavelength_nm[i];
        if (at_nm < curve.wavelength_nm.front() || at_nm > curve.wavelength_nm.back()) continue;
        common.wavelength_nm.push_back(at_nm);
        common.measured.push_back(measured.value[i]);
    }
    return common;
}

/// How far a curve is from what was measured.
struct Distance {
    double rmse = 0.0;
    double largest = 0.0;  ///< with its sign: above zero where the curve is higher
    double largest_nm = 0.0;
};

Distance distance(const SpectralCurve& curve, const Overlap& common) {
    Distance found;
    double squares = 0.0;
    for (std::size_t i = 0; i < common.measured.size(); ++i) {
        const double difference = curve.at(common.wavelength_nm[i]) - common.measured[i];
        squares += difference * difference;
        if (std::abs(difference) <= std::abs(found.largest)) continue;
        found.largest = difference;
        found.largest_nm = common.wavelength_nm[i];
    }
    found.rmse = std::sqrt(squares / static_cast<double>(common.measured.size()));
    return found;
}

ClaimFinding no_overlap() {
    return {.verdict = ClaimVerdict::skipped,
            .number = 0.0,
            .measure = "",
            .why = "nothing was measured at the wavelengths computed"};
}

/// The values of a curve at every nm of a range.
std::vector<double> values_within(const SpectralCurve& curve, int first_nm, int last_nm) {
    std::vector<double> values;
    for (int at_nm = first_nm; at_nm <= last_nm; ++at_nm) values.push_back(curve.at(at_nm));
    return values;
}

bool has_peak_between_dips(const SpectralCurve& curve) {
    const double peak = std::ranges::max(values_within(curve, 550, 570));
    const double dips =
        std::max(std::ranges::min(values_within(curve, 537, 547)), std::ranges::min(values_within(curve, 572, 582)));
    return peak - dips > 2.0 * solver_accuracy;
}

}  // namespace

ClaimFinding falls_with_wavelength(std::span<const SpectralCurve> curves) {
    double smallest = std::numeric_limits<double>::infinity();
    std::string where;
    for (const SpectralCurve& curve : curves) {
        for (std::size_t i = 1; i < curve.value.size(); ++i) {
            const double drop = (curve.value[i - 1] - curve.value[i]) / curve.value[i - 1];
            if (drop >= smallest) continue;
            smallest = drop;
            where =
                fmt::format("of {} from {} to {} nm", curve.name, curve.wavelength_nm[i - 1], curve.wavelength_nm[i]);
        }
    }
    return {.verdict = verdict_of(smallest > 0.0),
            .number = smallest,
            .measure = "least drop from wavelength to wavelength over the value, > 0",
            .why = fmt::format("the least drop is that {}", where)};
}

ClaimFinding darker_in_order(std::span<const SpectralCurve> curves) {
    assert(curves.size() >= 2);
    double smallest = std::numeric_limits<double>::infinity();
    double largest = -smallest;
    std::size_t undecided = 0;
    std::size_t count = 0;
    std::string where;
    for (std::size_t c = 1; c < curves.size(); ++c) {
        for (std::size_t i = 0; i < curves[c].value.size(); ++i) {
            const double drop = curves[c - 1].value[i] - curves[c].value[i];
            ++count;
            undecided += std::abs(drop) <= 2.0 * solver_accuracy ? 1 : 0;
            largest = std::max(largest, drop);
            if (drop >= smallest) continue;
            smallest = drop;
            where =
                fmt::format("from {} to {} at {} nm", curves[c - 1].name, curves[c].name, curves[c].wavelength_nm[i]);
        }
    }
    std::string why = fmt::format("the least drop is {}", where);
    if (undecided > 0) {
        why += fmt::format("; {} of {} drops are within the solver's error of {}", undecided, count,
                           2.0 * solver_accuracy);
    }
    return {.verdict = verdict_of(smallest > 0.0 && largest > 2.0 * solver_accuracy),
            .number = smallest,
            .measure = "least drop from series to series, > 0 at every wavelength",
            .why = std::move(why)};
}

double w_depth(const SpectralCurve& curve) {
    const double share = (560.0 - 542.0) / (577.0 - 542.0);
    return curve.at(560) - ((1.0 - share) * curve.at(542) + share * curve.at(577));
}

ClaimFinding w_deepens_in_order(std::span<const SpectralCurve> curves) {
    assert(curves.size() >= 2);
    // A depth is the difference of two means of values.
    constexpr double depth_accuracy = 2.0 * solver_accuracy;
    double smallest_growth = std::numeric_limits<double>::infinity();
    for (std::size_t c = 1; c < curves.size(); ++c) {
        smallest_growth = std::min(smallest_growth, w_depth(curves[c]) - w_depth(curves[c - 1]));
    }
    const bool deepens = smallest_growth > 2.0 * depth_accuracy;
    const bool has_w = has_peak_between_dips(curves.back());
    const double depth = w_depth(curves.back());
    std::string why = deepens ? fmt::format("it grows by {:.2g} or more from step to step", smallest_growth)
                              : fmt::format("one step changes it by {:.2g} only", smallest_growth);
    why += has_w ? ", with two dips and a peak at last" : ", but the last curve has no peak between two dips";
    why += depth > median_repeat_scatter
               ? fmt::format("; plain to see, being above the repeat scatter of {} [COOKSEY17]", median_repeat_scatter)
               : fmt::format("; faint, being below the repeat scatter of {} [COOKSEY17]", median_repeat_scatter);
    return {.verdict = verdict_of(deepens && has_w),
            .number = depth,
            .measure = fmt::format("depth of the last W; growth per step > {}", 2.0 * depth_accuracy),
            .why = std::move(why)};
}

ClaimFinding close_to_measured(std::span<const SpectralCurve> curves, const Spectrum& measured) {
    assert(!curves.empty());
    const Overlap common = overlap(curves.front(), measured);
    if (common.measured.empty()) return no_overlap();
    std::vector<Distance> distances;
    for (const SpectralCurve& curve : curves) distances.push_back(distance(curve, common));
    const auto nearest = std::ranges::min_element(distances, {}, &Distance::rmse);
    return {.verdict = verdict_of(nearest->rmse <= largest_repeat_scatter),
            .number = nearest->rmse,
            .measure = fmt::format("RMSE to the measurement, <= {} [COOKSEY17]", largest_repeat_scatter),
            .why = fmt::format("{}{} is off most at {} nm, by {:+.3f}", curves.size() > 1 ? "the nearest, " : "",
                               curves[static_cast<std::size_t>(nearest - distances.begin())].name, nearest->largest_nm,
                               nearest->largest)};
}

ClaimFinding measured_within(std::span<const SpectralCurve> curves, const Spectrum& measured) {
    assert(!curves.empty());
    const Overlap common = overlap(curves.front(), measured);
    if (common.measured.empty()) return no_overlap();
    std::size_t above = 0;
    std::size_t below = 0;
    for (std::size_t i = 0; i < common.measured.size(); ++i) {
        std::vector<double> values;
        for (const SpectralCurve& curve : curves) values.push_back(curve.at(common.wavelength_nm[i]));
        above += common.measured[i] > std::ranges::max(values) ? 1 : 0;
        below += common.measured[i] < std::ranges::min(values) ? 1 : 0;
    }
    const auto count = static_cast<double>(common.measured.size());
    const double share = 1.0 - static_cast<double>(above + below) / count;
    return {.verdict = verdict_of(above + below == 0),
            .number = share,
            .measure = "share of the measured wavelengths between the curves, = 1",
            .why = fmt::format("the measured mean lies above all curves at {:.0f} % and below all at {:.0f} % of them",
                               100.0 * static_cast<double>(above) / count, 100.0 * static_cast<double>(below) / count)};
}

}  // namespace skinfit
