#include "measurements/row_uncertainties.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "measurements/column_words.hpp"
#include "measurements/uncertainty_name.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// What a row's name or label says of it.
std::optional<UncertaintyName> uncertainty_of(const ReadRow& row) {
    if (!row.statistic.empty()) return uncertainty_named(row.statistic);
    return uncertainty_named(row.spectrum.name);
}

using Uncertainties = std::vector<std::optional<UncertaintyName>>;

/// The row that row `i`, of uncertainties, belongs to.
std::optional<std::size_t> owner_of(const std::vector<ReadRow>& rows, const Uncertainties& named, std::size_t i) {
    const ReadRow& row = rows[i];
    const bool by_label = !row.statistic.empty();
    const std::string base = by_label ? plain_base(row.spectrum.name) : named[i]->base;
    for (std::size_t j = 0; j < rows.size() && !base.empty(); ++j) {
        const bool is_other = !named[j] && rows[j].block == row.block;
        if (is_other && plain_base(rows[j].spectrum.name) == base) return j;
    }
    if (by_label || !base.empty() || i == 0 || named[i - 1] || rows[i - 1].block != row.block) return std::nullopt;
    const bool is_its = rows.size() == 2 || is_name_of_values(rows[i - 1].spectrum.name);
    return is_its ? std::optional(i - 1) : std::nullopt;
}

}  // namespace

bool names_statistics(std::string_view label) {
    static constexpr std::array<std::string_view, 7> words = {"stat", "statistic", "statistics", "kind",
                                                              "type", "measure",   "parameter"};
    return std::ranges::find(words, plain_text(label)) != words.end();
}

void take_uncertainty_rows(std::vector<ReadRow>& rows) {
    Uncertainties named;
    for (const ReadRow& row : rows) named.push_back(uncertainty_of(row));
    std::vector<bool> taken(rows.size(), false);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::optional<std::size_t> owner = named[i] ? owner_of(rows, named, i) : std::nullopt;
        if (!owner) continue;
        taken[i] = true;
        ReadRow& of = rows[*owner];
        const std::string& shown = rows[i].statistic.empty() ? rows[i].spectrum.name : rows[i].statistic;
        if (!named[i]->is_standard || !of.sigma.empty()) {
            of.spectrum.remarks.push_back(fmt::format("left out: {} ({})", in_quotes(shown),
                                                      named[i]->is_standard
                                                          ? "another uncertainty of these values is used"
                                                          : "it is no standard uncertainty in the unit of the values"));
            continue;
        }
        of.sigma = rows[i].values;
        of.spectrum.sigma_source = fmt::format("given by the file as {}", shown);
    }
    std::size_t at = 0;
    std::erase_if(rows, [&](const ReadRow&) { return taken[at++]; });
}

}  // namespace skinfit
