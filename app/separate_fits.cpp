#include "app/separate_fits.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/session.hpp"
#include "fit/model_split.hpp"
#include "fit/parameter_words.hpp"
#include "fit/report.hpp"
#include "fit/tissue.hpp"

namespace skinfit {
namespace {

/// The parameters that any of the fits adjusted, in the order of their table.
std::vector<Parameter> adjusted(std::span<const SeparateFit> fits) {
    std::vector<Parameter> parameters;
    for (const SeparateFit& fit : fits) {
        if (!fit.result) continue;
        for (const FittedParameter& row : fit.result->free) parameters.push_back(row.parameter);
    }
    std::ranges::sort(parameters);
    const auto repeated = std::ranges::unique(parameters);
    parameters.erase(repeated.begin(), repeated.end());
    return parameters;
}

/// "0.0312 +/- 0.0011 AT LOWER BOUND"; "-" where it was not adjusted.
std::string cell(const FitResult& result, Parameter parameter) {
    const auto found = std::ranges::find(result.free, parameter, &FittedParameter::parameter);
    if (found == result.free.end()) return "-";
    const ParameterWords words = parameter_words(*found);
    return fmt::format("{} +/- {}{}{}", words.value, words.sigma, words.remark.empty() ? "" : " ", words.remark);
}

/// The quantities of the tissue that any of the fits tells, in the order of their table.
std::vector<const TissueQuantity*> told(std::span<const std::vector<TissueEstimate>> estimates) {
    std::vector<const TissueQuantity*> quantities;
    for (const TissueQuantity& quantity : tissue_quantities()) {
        const bool is_told = std::ranges::any_of(estimates, [&](const std::vector<TissueEstimate>& each) {
            return std::ranges::find(each, &quantity, &TissueEstimate::quantity) != each.end();
        });
        if (is_told) quantities.push_back(&quantity);
    }
    return quantities;
}

/// "12.3 (8.1 to 17)"; "-" where it is not told.
std::string cell(const std::vector<TissueEstimate>& estimates, const TissueQuantity* quantity) {
    const auto found = std::ranges::find(estimates, quantity, &TissueEstimate::quantity);
    return found == estimates.end() ? "-" : fmt::format("{:.3g} ({})", found->value, interval_words(*found));
}

std::vector<std::string> row_of(const SeparateFit& fit, std::span<const Parameter> parameters) {
    std::vector<std::string> row = {fit.file, "no result", "-"};
    if (fit.result) {
        row[1] = name_of(fit.result->verdict);
        row[2] = fmt::format("{:.5f}", fit.result->rmse);
    }
    for (const Parameter parameter : parameters) row.push_back(fit.result ? cell(*fit.result, parameter) : "-");
    return row;
}

/// Columns as wide as their widest cell.
std::string aligned(const std::vector<std::vector<std::string>>& rows) {
    std::vector<std::size_t> widths(rows.front().size());
    for (const auto& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    }
    std::string text;
    for (const auto& row : rows) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i) line += fmt::format("  {:<{}}", row[i], widths[i]);
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
}

}  // namespace

std::string separate_fits_text(std::span<const SeparateFit> fits) {
    const std::vector<Parameter> parameters = adjusted(fits);
    std::vector<std::vector<std::string>> rows = {{"spectrum", "verdict", "rmse"}};
    for (const Parameter parameter : parameters) {
        const ParameterInfo& row = info(parameter);
        rows.front().push_back(std::string(row.name));
    }
    std::vector<std::vector<TissueEstimate>> tissue;
    for (const SeparateFit& fit : fits) {
        rows.push_back(row_of(fit, parameters));
        tissue.push_back(fit.result ? tissue_estimates(*fit.result) : std::vector<TissueEstimate>());
    }
    for (const TissueQuantity* const quantity : told(tissue)) {
        rows.front().emplace_back(quantity->name);
        for (std::size_t i = 0; i < tissue.size(); ++i) rows[i + 1].push_back(cell(tissue[i], quantity));
    }
    std::string text = fmt::format("{} spectra, each fitted by itself; --joint explains all by one specimen\n\n{}\n",
                                   fits.size(), aligned(rows));
    for (const SeparateFit& fit : fits) {
        if (!fit.result) text += fmt::format("{}\n", fit.problem);
        if (!fit.result) continue;
        std::vector<std::string> remarks = fit.result->reasons;
        for (const ModelSplit& split : model_splits(*fit.result)) remarks.push_back(in_words(split));
        if (!remarks.empty()) text += fmt::format("{}:\n", fit.file);
        for (const std::string& remark : remarks) text += fmt::format("  - {}\n", remark);
    }
    return text;
}

Json separate_fits_json(std::span<const SeparateFit> fits) {
    Json list = Json::array();
    for (const SeparateFit& fit : fits) {
        list.push_back(fit.result ? json_report(*fit.result) : Json{{"file", fit.file}, {"error", fit.problem}});
    }
    return list;
}

int exit_code_of(std::span<const SeparateFit> fits) {
    int worst = good_result;
    for (const SeparateFit& fit : fits) {
        const bool is_good = fit.result && fit.result->verdict == Verdict::consistent;
        worst = std::max<int>(worst, !fit.result ? bad_input : is_good ? good_result : result_with_warning);
    }
    return worst;
}

}  // namespace skinfit
