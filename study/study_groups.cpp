#include "study/study_groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "fit/tissue.hpp"
#include "model/parameters.hpp"

namespace skinfit {
namespace {

std::string group_name(const Study& study, const LedgerRow& row) {
    std::string name;
    for (const std::string& key : study.group_by) {
        const std::string word = word_of(row.metadata, key);
        name += (name.empty() ? "" : ", ") + (word.empty() ? fmt::format("no {}", key) : word);
    }
    return name.empty() ? "all" : name;
}

double median_of(std::vector<double> values) {
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    std::ranges::sort(values);
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2.0;
}

/// One reason why a spectrum is not simply fitted.
struct Reason {
    std::string_view words;  ///< the first of them: "AT BOUND", or "collapse_at_end"
    std::string_view whole;
};

/// The first words of what is wrong with a fit, in capitals, without the names that follow them.
std::string_view capitals(std::string_view reason) {
    const std::string_view words = reason.substr(0, reason.find(':'));
    const std::size_t lower = words.find_first_of("abcdefghijklmnopqrstuvwxyz");
    return lower == std::string_view::npos || lower < 2 ? words : words.substr(0, lower - 1);
}

/// Of the message of an error, `<where>: <problem> (<why>); <remedy>`, the problem.
std::string_view problem_of(std::string_view message) {
    const std::size_t colon = message.find(": ");
    if (colon != std::string_view::npos) message.remove_prefix(colon + 2);
    return message.substr(0, message.find(" ("));
}

std::vector<Reason> reasons_of(const StudiedSpectrum& studied) {
    constexpr std::string_view between = " | ";
    std::vector<Reason> reasons;
    std::string_view rest = studied.reason;
    while (!rest.empty()) {
        const std::size_t end = rest.find(between);
        const std::string_view whole = rest.substr(0, end);
        rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + between.size());
        const bool is_error = studied.status == FitStatus::failed && studied.verdict.empty();
        const std::string_view words = is_error                                ? problem_of(whole)
                                       : studied.status == FitStatus::rejected ? whole.substr(0, whole.find(':'))
                                                                               : capitals(whole);
        if (std::ranges::find(reasons, words, &Reason::words) == reasons.end()) reasons.push_back({words, whole});
    }
    return reasons;
}

}  // namespace

std::vector<StudyGroup> groups_of(const Study& study, const std::vector<AnsweredRow>& rows) {
    std::vector<StudyGroup> groups;
    std::map<std::string, std::size_t> places;
    for (const AnsweredRow& each : rows) {
        const auto [place, is_new] = places.try_emplace(group_name(study, each.row), groups.size());
        if (is_new) groups.push_back({.name = place->first, .rows = {}});
        StudyGroup& group = groups[place->second];
        ++group.counts[static_cast<std::size_t>(each.row.studied.status)];
        if (has_answer(each.row.studied.status)) group.rows.push_back(&each);
    }
    return groups;
}

std::vector<std::string> quantities_in(const std::vector<AnsweredRow>& rows) {
    std::vector<std::string> known;
    for (const ParameterInfo& info : parameter_table()) known.emplace_back(info.name);
    for (const TissueQuantity& quantity : tissue_quantities()) known.emplace_back(quantity.name);
    for (const IndexInfo& info : index_table()) known.emplace_back(info.name);
    std::erase_if(known, [&](const std::string& name) {
        return std::ranges::none_of(rows,
                                    [&](const AnsweredRow& each) { return estimate_of(each.row, name).has_value(); });
    });
    return known;
}

std::string unit_of(const std::string& quantity) {
    if (const std::optional<Parameter> parameter = find_parameter(quantity)) return std::string(info(*parameter).unit);
    if (const TissueQuantity* const tissue = find_tissue_quantity(quantity)) return std::string(tissue->unit);
    const auto found = std::ranges::find(index_table(), quantity, &IndexInfo::name);
    return found == index_table().end() ? std::string() : std::string(found->unit);
}

std::optional<GroupSummary> summary_of(const StudyGroup& group, const std::string& quantity) {
    std::vector<double> values;
    std::vector<double> sigmas;
    std::size_t decided_by_prior = 0;
    std::size_t split_by_model = 0;
    for (const AnsweredRow* const each : group.rows) {
        const std::optional<QuantityEstimate> estimate = estimate_of(each->row, quantity);
        if (!estimate) continue;
        values.push_back(estimate->value);
        if (estimate->sigma) sigmas.push_back(*estimate->sigma);
        if (estimate->decided_by_prior) ++decided_by_prior;
        if (estimate->split_by_model) ++split_by_model;
    }
    if (values.empty()) return std::nullopt;
    const auto n = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    double squares = 0.0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    return GroupSummary{.spectra = values.size(),
                        .mean = mean,
                        .sd = std::sqrt(squares / (n - 1.0)),  // NaN for one
                        .median = median_of(values),
                        .median_sigma = median_of(sigmas),
                        .decided_by_prior = decided_by_prior,
                        .split_by_model = split_by_model};
}

std::vector<RepeatedEstimate> repeats_of(const Study& study, const std::vector<AnsweredRow>& rows,
                                         const std::string& quantity) {
    std::vector<RepeatedEstimate> repeats;
    for (const AnsweredRow& each : rows) {
        const std::string specimen = word_of(each.row.metadata, study.repeats_of);
        if (specimen.empty() || !has_answer(each.row.studied.status)) continue;
        const std::optional<QuantityEstimate> estimate = estimate_of(each.row, quantity);
        if (estimate) repeats.push_back({.specimen = specimen, .estimate = estimate->value, .sigma = estimate->sigma});
    }
    return repeats;
}

std::vector<ReasonCount> reasons_in(const std::vector<AnsweredRow>& rows) {
    std::vector<ReasonCount> counts;
    for (const AnsweredRow& each : rows) {
        const StudiedSpectrum& studied = each.row.studied;
        if (studied.status == FitStatus::fitted || studied.status == FitStatus::pending) continue;
        for (const Reason& reason : reasons_of(studied)) {
            const auto found = std::ranges::find_if(counts, [&](const ReasonCount& count) {
                return count.status == studied.status && count.reason == reason.words;
            });
            if (found != counts.end()) {
                ++found->spectra;
                continue;
            }
            counts.push_back(
                {.status = studied.status,
                 .reason = std::string(reason.words),
                 .spectra = 1,
                 .example = fmt::format("{} {}: {}", each.row.key.source, each.row.key.name, studied.reason)});
        }
    }
    std::ranges::stable_sort(counts, std::greater<>(), &ReasonCount::spectra);
    return counts;
}

}  // namespace skinfit
