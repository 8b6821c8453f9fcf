#include "fit/model_split.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace skinfit {
namespace {

/// Parameters that share an amount.
struct SharedAmount {
    Parameter first;
    Parameter second;
    std::string_view use;
};

constexpr std::array shared_amounts = {
    SharedAmount{Parameter::papillary_blood_fraction, Parameter::reticular_blood_fraction,
                 "dermal_hemoglobin_umol_per_l"},
    SharedAmount{Parameter::bilirubin_g_per_l, Parameter::dermal_bilirubin_g_per_l, "tissue_bilirubin_mg_per_dl"},
};

std::optional<ModelSplit> split_of(const FitResult& result, const SharedAmount& amount) {
    const auto first = std::ranges::find(result.free, amount.first, &FittedParameter::parameter);
    const auto second = std::ranges::find(result.free, amount.second, &FittedParameter::parameter);
    if (first == result.free.end() || second == result.free.end()) return std::nullopt;
    const double correlation = result.correlation(first - result.free.begin(), second - result.free.begin());
    const auto is_open = [](const FittedParameter& each) {
        return each.uncertainty.decided_by_prior || each.uncertainty.status == Status::not_identifiable;
    };
    constexpr double sum_is_known_better = -0.5;  // chosen: of equal errors, the difference has sqrt(3) times the sum's
    if (!(correlation <= sum_is_known_better) && !is_open(*first) && !is_open(*second)) return std::nullopt;
    return ModelSplit{.first = info(amount.first).name,
                      .second = info(amount.second).name,
                      .use = amount.use,
                      .correlation = correlation};
}

}  // namespace

std::vector<ModelSplit> model_splits(const FitResult& result) {
    const std::array<bool, parameter_count>& own = result.configuration.own;
    if (std::ranges::find(own, true) != own.end()) return {};
    std::vector<ModelSplit> splits;
    for (const SharedAmount& amount : shared_amounts) {
        if (const std::optional<ModelSplit> split = split_of(result, amount)) splits.push_back(*split);
    }
    return splits;
}

bool is_split_by_model(const std::vector<ModelSplit>& splits, std::string_view parameter) {
    return std::ranges::any_of(
        splits, [&](const ModelSplit& each) { return each.first == parameter || each.second == parameter; });
}

std::string in_words(const ModelSplit& split) {
    return fmt::format(
        "SPLIT BY THE MODEL: {} and {}; the spectrum does not say how the two share what it shows (correlation "
        "{:+.2f}), the model and its priors do: use {}",
        split.first, split.second, split.correlation, split.use);
}

}  // namespace skinfit
