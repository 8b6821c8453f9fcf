#include "validation/transport_summary.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "study/agreement.hpp"
#include "study/roc.hpp"

namespace skinfit {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double much_bilirubin_g_per_l = 0.01;  // 1 mg/dL

Bounds at_least(double limit) {
    return {limit, infinity};
}

Bounds at_most(double limit) {
    return {-infinity, limit};
}

constexpr Bounds anything = {-infinity, infinity};

/// The fits of a study that have an estimate of one quantity.
struct Compared {
    SharedQuantity quantity;
    std::vector<const TransportFit*> fits;

    [[nodiscard]] std::size_t place() const { return static_cast<std::size_t>(quantity); }
    [[nodiscard]] std::string_view name() const { return shared_quantity_names[place()]; }
    [[nodiscard]] double truth(const TransportFit& fit) const { return fit.truth[place()]; }
    [[nodiscard]] const TransportFit::Estimate& estimate(const TransportFit& fit) const {
        return *fit.estimate[place()];
    }
};

template <class Condition>
Compared compared(const TransportStudy& study, SharedQuantity quantity, Condition condition) {
    Compared result{.quantity = quantity, .fits = {}};
    for (const TransportFit& fit : study.fits) {
        if (fit.estimate[static_cast<std::size_t>(quantity)] && condition(fit)) result.fits.push_back(&fit);
    }
    return result;
}

double bilirubin(const TransportFit& fit) {
    return fit.truth[static_cast<std::size_t>(SharedQuantity::dermal_bilirubin_g_per_l)];
}

double melanin(const TransportFit& fit) {
    return fit.truth[static_cast<std::size_t>(SharedQuantity::melanosome_fraction)];
}

double middle_of(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t count = values.size();
    return 0.5 * (values[(count - 1) / 2] + values[count / 2]);
}

/// The mean, with Student's interval.
IntervalEstimate mean_of(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    const double mean = std::reduce(values.begin(), values.end()) / n;
    double squares = 0.0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    const double half = student_deviate_95(n - 1.0) * std::sqrt(squares / (n - 1.0) / n);
    return {.value = mean, .interval_95 = {mean - half, mean + half}};
}

IntervalEstimate share_of(std::size_t count, std::size_t trials) {
    const Proportion share = proportion(count, trials);
    return {.value = share.share(), .interval_95 = share.interval_95};
}

/// Ranks from 1; equal values have their mean.
std::vector<double> ranks_of(const std::vector<double>& values) {
    std::vector<double> ranks;
    for (const double value : values) {
        double rank = 0.5;
        for (const double other : values) rank += other < value ? 1.0 : (other == value ? 0.5 : 0.0);
        ranks.push_back(rank);
    }
    return ranks;
}

void add_coverage(const Compared& of, std::string_view spectra, double wanted, TransportSummary& summary) {
    std::size_t intervals = 0;
    std::size_t covered = 0;
    for (const TransportFit* fit : of.fits) {
        const std::optional<Bounds>& interval = of.estimate(*fit).interval_95;
        if (!interval) continue;
        ++intervals;
        if (interval->lower <= of.truth(*fit) && of.truth(*fit) <= interval->upper) ++covered;
    }
    if (intervals == 0) return;
    summary.figures.push_back(
        {of.name(), "coverage", spectra, intervals, share_of(covered, intervals), at_least(wanted)});
}

/// What is left of the truth by linear regression on log(1/R) from 500 to 650 nm, each skin predicted by the others;
/// nothing where they are too few or a reading is not above 0.
std::optional<double> regression_error(const TransportStudy& study, const Compared& of) {
    std::vector<std::size_t> columns;
    for (std::size_t i = 0; i < study.wavelength_nm.size(); ++i) {
        if (study.wavelength_nm[i] >= 500.0 && study.wavelength_nm[i] <= 650.0) columns.push_back(i);
    }
    const auto rows = static_cast<Eigen::Index>(of.fits.size());
    const auto count = static_cast<Eigen::Index>(columns.size()) + 1;
    if (columns.empty() || rows < 3 * count) return std::nullopt;
    Eigen::MatrixXd terms = Eigen::MatrixXd::Ones(rows, count);
    Eigen::VectorXd truth(rows);
    for (Eigen::Index row = 0; row < rows; ++row) {
        const TransportFit& fit = *of.fits[static_cast<std::size_t>(row)];
        truth[row] = of.truth(fit);
        for (Eigen::Index column = 1; column < count; ++column) {
            const double reading = fit.measured[columns[static_cast<std::size_t>(column) - 1]];
            if (!(reading > 0.0)) return std::nullopt;
            terms(row, column) = -std::log(reading);
        }
    }
    const Eigen::LDLT<Eigen::MatrixXd> normal(terms.transpose() * terms);
    const Eigen::VectorXd residual = truth - terms * normal.solve(terms.transpose() * truth);
    const Eigen::MatrixXd influence = normal.solve(terms.transpose());  // columns: of each skin on the coefficients
    double sum = 0.0;
    for (Eigen::Index row = 0; row < rows; ++row) {
        sum += std::abs(residual[row] / (1.0 - terms.row(row).dot(influence.col(row))));
    }
    return sum / static_cast<double>(rows);
}

void add_saturation(const TransportStudy& study, bool with_bilirubin, TransportSummary& summary) {
    const Compared of = compared(study, SharedQuantity::oxygen_saturation,
                                 [&](const TransportFit& fit) { return (bilirubin(fit) > 0.0) == with_bilirubin; });
    if (of.fits.size() < 2) return;
    const std::string_view spectra = with_bilirubin ? "with bilirubin" : "without bilirubin";
    std::vector<double> truths;
    std::vector<double> errors;
    std::vector<double> sizes;
    for (const TransportFit* fit : of.fits) {
        truths.push_back(of.truth(*fit));
        errors.push_back(of.estimate(*fit).value - of.truth(*fit));
        sizes.push_back(std::abs(errors.back()));
    }
    const double constant = middle_of(truths);
    double limit = 0.0;
    for (const double truth : truths) limit += std::abs(truth - constant) / static_cast<double>(truths.size());
    const auto add = [&](std::string_view figure, const IntervalEstimate& found, const Bounds& wanted) {
        summary.figures.push_back({of.name(), figure, spectra, of.fits.size(), found, wanted});
    };
    add("constant_error", {limit, {limit, limit}}, anything);
    const std::optional<double> regression = with_bilirubin ? std::nullopt : regression_error(study, of);
    if (regression) add("regression_error", {*regression, {*regression, *regression}}, anything);
    add("mean_absolute_error", mean_of(sizes), at_most(std::min(limit, regression.value_or(infinity))));
    add("bias", mean_of(errors), anything);
    add_coverage(of, spectra, with_bilirubin ? 0.88 : 0.92, summary);  // chosen
}

void add_bilirubin(const TransportStudy& study, TransportSummary& summary) {
    const Compared all =
        compared(study, SharedQuantity::dermal_bilirubin_g_per_l, [](const TransportFit&) { return true; });
    if (all.fits.empty()) return;
    std::vector<double> melanins;
    for (const TransportFit* fit : all.fits) melanins.push_back(melanin(*fit));
    const double middle = middle_of(melanins);
    for (const bool darker : {false, true}) {
        std::vector<ScoredCase> cases;
        for (const TransportFit* fit : all.fits) {
            const bool is_case = bilirubin(*fit) == 0.0 || bilirubin(*fit) > much_bilirubin_g_per_l;
            if (!is_case || (melanin(*fit) >= middle) != darker) continue;
            cases.push_back({.score = all.estimate(*fit).value, .is_positive = bilirubin(*fit) > 0.0});
        }
        const RocAnalysis roc = roc_analysis(cases);
        if (!roc.area) continue;
        summary.figures.push_back({all.name(),
                                   "area",
                                   darker ? "darker half" : "lighter half",
                                   cases.size(),
                                   {roc.area->value, roc.area->interval_95},
                                   at_least(darker ? 0.80 : 0.95)});  // chosen
    }
    std::size_t consistent = 0;
    std::size_t below = 0;
    for (const TransportFit* fit : all.fits) {
        const std::optional<Bounds>& interval = all.estimate(*fit).interval_95;
        if (fit->verdict != Verdict::consistent || !interval) continue;
        ++consistent;
        if (interval->upper < all.truth(*fit)) ++below;
    }
    if (consistent == 0) return;
    constexpr double harmless = 0.05;  // chosen: twice what 95 % intervals leave on that side
    summary.figures.push_back(
        {all.name(), "interval_below_truth", "consistent", consistent, share_of(below, consistent), at_most(harmless)});
}

/// Rank correlation and log-log slope; nothing of fewer than four skins.
void add_order(const Compared& of, double least_rank, const Bounds& slope, TransportSummary& summary) {
    std::vector<double> truths;
    std::vector<double> estimates;
    std::vector<ReferencePair> logarithms;
    for (const TransportFit* fit : of.fits) {
        truths.push_back(of.truth(*fit));
        estimates.push_back(of.estimate(*fit).value);
        if (!(truths.back() > 0.0 && estimates.back() > 0.0)) continue;
        logarithms.push_back({.estimate = std::log(estimates.back()),
                              .reference = std::log(truths.back()),
                              .sigma = {},
                              .interval_95 = {}});
    }
    if (truths.empty()) return;
    const auto [least, most] = std::ranges::minmax(truths);
    constexpr double rounding = 1e-9;  // truths that differ by less are one
    if (most - least <= rounding * most) return;
    const std::vector<double> true_ranks = ranks_of(truths);
    const std::vector<double> ranks = ranks_of(estimates);
    std::vector<ReferencePair> ranked;
    for (std::size_t i = 0; i < ranks.size(); ++i) {
        ranked.push_back({.estimate = ranks[i], .reference = true_ranks[i], .sigma = {}, .interval_95 = {}});
    }
    if (const auto order = method_agreement(ranked); order && order->pearson) {
        summary.figures.push_back(
            {of.name(), "rank_correlation", "all", ranked.size(), *order->pearson, at_least(least_rank)});
    }
    if (const auto line = method_agreement(logarithms); line && line->line) {
        summary.figures.push_back({of.name(), "log_log_slope", "all", logarithms.size(), line->line->slope, slope});
        summary.figures.push_back({of.name(),
                                   "mean_ratio",
                                   "all",
                                   logarithms.size(),
                                   {std::exp(line->bias.value),
                                    {std::exp(line->bias.interval_95.lower), std::exp(line->bias.interval_95.upper)}},
                                   anything});
    }
}

}  // namespace

bool JudgedFigure::passes() const {
    return found.interval_95.lower <= wanted.upper && found.interval_95.upper >= wanted.lower;
}

TransportSummary summarised(const TransportStudy& study) {
    TransportSummary summary{
        .cohort = study.cohort, .spectra = study.fits.size(), .consistent = 0, .failed = 0, .figures = {}};
    for (const TransportFit& fit : study.fits) {
        if (fit.verdict == Verdict::consistent) ++summary.consistent;
        if (fit.verdict == Verdict::failed) ++summary.failed;
    }
    const auto any = [](const TransportFit&) { return true; };
    add_saturation(study, false, summary);
    add_saturation(study, true, summary);
    add_bilirubin(study, summary);
    add_order(compared(study, SharedQuantity::melanosome_fraction, any), 0.97, {0.85, 1.15}, summary);  // chosen
    const Compared hemoglobin = compared(study, SharedQuantity::dermal_hemoglobin_umol_per_l, any);
    add_order(hemoglobin, 0.80, anything, summary);  // chosen
    add_coverage(hemoglobin, "all", 0.88, summary);  // chosen
    return summary;
}

bool passes(const TransportSummary& summary) {
    constexpr std::size_t harmless = 20;  // chosen: one failure in so many
    if (summary.figures.empty() || harmless * summary.failed > summary.spectra) return false;
    return std::ranges::all_of(summary.figures, [](const JudgedFigure& figure) { return figure.passes(); });
}

}  // namespace skinfit
