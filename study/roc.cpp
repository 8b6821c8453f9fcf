#include "study/roc.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace skinfit {
namespace {

constexpr double tail = 0.025;

bool has_score(const ScoredCase& each) {
    return each.score && !std::isnan(*each.score);
}

/// The cases of one score.
struct Tie {
    double score;
    std::size_t positives;
    std::size_t negatives;
};

/// From the highest score to the lowest.
std::vector<Tie> ties_of(const std::vector<ScoredCase>& cases) {
    std::vector<Tie> ties;
    for (const ScoredCase& each : cases) {
        if (!has_score(each)) continue;
        ties.push_back({.score = *each.score,
                        .positives = each.is_positive ? std::size_t{1} : 0,
                        .negatives = each.is_positive ? 0 : std::size_t{1}});
    }
    std::ranges::sort(ties, std::ranges::greater(), &Tie::score);
    std::vector<Tie> merged;
    for (const Tie& tie : ties) {
        if (merged.empty() || merged.back().score != tie.score) {
            merged.push_back(tie);
        } else {
            merged.back().positives += tie.positives;
            merged.back().negatives += tie.negatives;
        }
    }
    return merged;
}

std::optional<Proportion> proportion_of_any(std::size_t count, std::size_t trials) {
    return trials == 0 ? std::nullopt : std::optional(proportion(count, trials));
}

struct Called {
    std::size_t positives;
    std::size_t negatives;
};

OperatingPoint point_at(double threshold, const Called& called, const Called& all) {
    return {.threshold = threshold,
            .true_positives = called.positives,
            .false_positives = called.negatives,
            .true_negatives = all.negatives - called.negatives,
            .false_negatives = all.positives - called.positives,
            .sensitivity = proportion_of_any(called.positives, all.positives),
            .specificity = proportion_of_any(all.negatives - called.negatives, all.negatives)};
}

std::vector<OperatingPoint> curve_of(const std::vector<Tie>& ties, const Called& all) {
    Called called{.positives = 0, .negatives = 0};
    std::vector<OperatingPoint> curve = {point_at(std::numeric_limits<double>::infinity(), called, all)};
    for (const Tie& tie : ties) {
        called.positives += tie.positives;
        called.negatives += tie.negatives;
        curve.push_back(point_at(tie.score, called, all));
    }
    return curve;
}

/// Sums of the structural components of [DELONG88]: of each positive case the share of negative ones that it
/// exceeds, of each negative case the share of positive ones that exceed it.
struct Components {
    double area;
    double squares_of_positives;  ///< of deviations from the area
    double squares_of_negatives;
};

Components components_of(const std::vector<Tie>& ties, const Called& all) {
    const auto positives = static_cast<double>(all.positives);
    const auto negatives = static_cast<double>(all.negatives);
    std::vector<double> of_positive;
    std::vector<double> of_negative;
    double above = 0.0;        // positive cases
    double below = negatives;  // negative cases
    double sum = 0.0;
    for (const Tie& tie : ties) {
        const auto tied_positives = static_cast<double>(tie.positives);
        const auto tied_negatives = static_cast<double>(tie.negatives);
        below -= tied_negatives;
        of_positive.push_back((below + 0.5 * tied_negatives) / negatives);
        of_negative.push_back((above + 0.5 * tied_positives) / positives);
        above += tied_positives;
        sum += tied_positives * (below + 0.5 * tied_negatives);
    }
    Components found{.area = sum / (positives * negatives), .squares_of_positives = 0.0, .squares_of_negatives = 0.0};
    for (std::size_t i = 0; i < ties.size(); ++i) {
        found.squares_of_positives += static_cast<double>(ties[i].positives) * std::pow(of_positive[i] - found.area, 2);
        found.squares_of_negatives += static_cast<double>(ties[i].negatives) * std::pow(of_negative[i] - found.area, 2);
    }
    return found;
}

Bounds logit_interval(double area, double standard_error) {
    const double logit = std::log(area / (1.0 - area));
    const double half = normal_deviate_95() * standard_error / (area * (1.0 - area));
    return {.lower = 1.0 / (1.0 + std::exp(half - logit)), .upper = 1.0 / (1.0 + std::exp(-half - logit))};
}

RocArea area_of(const std::vector<Tie>& ties, const Called& all) {
    const Components found = components_of(ties, all);
    RocArea area{.value = found.area, .standard_error = {}, .interval_95 = {}, .rule = RocIntervalRule::logit};
    const auto positives = static_cast<double>(all.positives);
    const auto negatives = static_cast<double>(all.negatives);
    if (all.positives > 1 && all.negatives > 1) {
        // [DELONG88]
        area.standard_error = std::sqrt(found.squares_of_positives / (positives * (positives - 1.0)) +
                                        found.squares_of_negatives / (negatives * (negatives - 1.0)));
    }
    const double pairs = std::min(positives, negatives);
    if (found.area == 0.0 || found.area == 1.0) {
        const double reach = std::pow(tail, 1.0 / pairs);
        area.rule = RocIntervalRule::separated;
        area.interval_95 =
            found.area == 1.0 ? Bounds{.lower = reach, .upper = 1.0} : Bounds{.lower = 0.0, .upper = 1.0 - reach};
    } else if (area.standard_error.value_or(0.0) > 0.0) {
        area.interval_95 = logit_interval(found.area, *area.standard_error);
    } else {
        const double half = std::sqrt(std::log(1.0 / tail) / (2.0 * pairs));
        area.rule = RocIntervalRule::hoeffding;
        area.interval_95 = {.lower = std::max(0.0, found.area - half), .upper = std::min(1.0, found.area + half)};
    }
    return area;
}

}  // namespace

RocAnalysis roc_analysis(const std::vector<ScoredCase>& cases) {
    RocAnalysis found{.positives = 0,
                      .negatives = 0,
                      .positives_without_score = 0,
                      .negatives_without_score = 0,
                      .curve = {},
                      .area = {},
                      .why_no_area = {}};
    for (const ScoredCase& each : cases) {
        if (has_score(each)) {
            ++(each.is_positive ? found.positives : found.negatives);
        } else {
            ++(each.is_positive ? found.positives_without_score : found.negatives_without_score);
        }
    }
    if (found.positives == 0 || found.negatives == 0) {
        const bool has_any = found.positives + found.negatives > 0;
        found.why_no_area = !has_any               ? "no case has a score"
                            : found.positives == 0 ? "no positive case has a score"
                                                   : "no negative case has a score";
        return found;
    }
    const std::vector<Tie> ties = ties_of(cases);
    const Called all{.positives = found.positives, .negatives = found.negatives};
    found.curve = curve_of(ties, all);
    found.area = area_of(ties, all);
    return found;
}

OperatingPoint operating_point(const std::vector<ScoredCase>& cases, double threshold) {
    Called called{.positives = 0, .negatives = 0};
    Called all{.positives = 0, .negatives = 0};
    for (const ScoredCase& each : cases) {
        if (!has_score(each)) continue;
        ++(each.is_positive ? all.positives : all.negatives);
        if (*each.score >= threshold) ++(each.is_positive ? called.positives : called.negatives);
    }
    return point_at(threshold, called, all);
}

}  // namespace skinfit
