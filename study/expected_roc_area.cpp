#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "study/roc.hpp"

namespace skinfit {
namespace {

/// Of one case against all others, the expected number ...
struct Against {
    double negatives;        ///< ... of negative ones
    double positives;        ///< ... of positive ones
    double negatives_below;  ///< ... of negative ones that score lower, ties half
    double positives_above;  ///< ... of positive ones that score higher, ties half
};

/// `sorted` ascends.
std::vector<Against> all_against(const std::vector<double>& sorted) {
    const double all_positives = std::accumulate(sorted.begin(), sorted.end(), 0.0);
    const double all_negatives = static_cast<double>(sorted.size()) - all_positives;
    std::vector<Against> found;
    double negatives_below = 0.0;
    double positives_below = 0.0;
    for (std::size_t begin = 0; begin < sorted.size();) {
        const double p = sorted[begin];
        std::size_t end = begin + 1;
        while (end < sorted.size() && sorted[end] == p) ++end;
        const auto tied = static_cast<double>(end - begin);
        const Against each{.negatives = all_negatives - (1.0 - p),
                           .positives = all_positives - p,
                           .negatives_below = negatives_below + 0.5 * (tied - 1.0) * (1.0 - p),
                           .positives_above = all_positives - positives_below - tied * p + 0.5 * (tied - 1.0) * p};
        found.insert(found.end(), end - begin, each);
        negatives_below += tied * (1.0 - p);
        positives_below += tied * p;
        begin = end;
    }
    return found;
}

}  // namespace

std::optional<ExpectedRocArea> expected_roc_area(const std::vector<double>& probabilities) {
    assert(std::ranges::all_of(probabilities, [](double p) { return p >= 0.0 && p <= 1.0; }));
    std::vector<double> sorted = probabilities;
    std::ranges::sort(sorted);
    const std::vector<Against> against = all_against(sorted);
    double pairs = 0.0;
    double in_order = 0.0;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        pairs += sorted[i] * against[i].negatives;
        in_order += sorted[i] * against[i].negatives_below;
    }
    if (!(pairs > 0.0)) return std::nullopt;
    const double area = in_order / pairs;
    double variance = 0.0;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        // What making this case positive adds to (pairs in order) - area (pairs): it wins over negative ones, and no
        // longer loses to positive ones.
        const double influence = (against[i].negatives_below - area * against[i].negatives) -
                                 (against[i].positives_above - area * against[i].positives);
        variance += sorted[i] * (1.0 - sorted[i]) * influence * influence;
    }
    return ExpectedRocArea{.value = area, .standard_deviation = std::sqrt(variance) / pairs};
}

}  // namespace skinfit
