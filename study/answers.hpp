#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/ledger.hpp"
#include "study/study.hpp"

namespace skinfit {

/// What an indicator says of one spectrum.
struct IndicatorAnswer {
    std::optional<double> probability;  ///< none where the spectrum does not tell
    std::string why_none;               ///< in a few words; empty where there is a probability
    /// The quantity or its reference is decided by its prior (`ParameterEstimate::decided_by_prior`): the probability
    /// is hardly the spectrum's.
    bool decided_by_prior = false;
};

/// A spectrum of a study with the answers to the study's questions.
struct AnsweredRow {
    LedgerRow row;
    std::vector<IndicatorAnswer> indicators;  ///< in the order of `Study::indicators`
};

/// The probabilities of the study's indicators for all spectra of its ledger: from the marginal posterior, else from
/// the interval of each quantity (`marginal_of`), never from the value alone. Where the indicator states a prevalence,
/// it takes the place of the share that the prior of the fit has beyond the threshold. A reference is the spectrum
/// measured where the indicator says on the same specimen; where there are several, the probability is the mean over
/// them. A spectrum without a word for the specimen has none.
[[nodiscard]] std::vector<AnsweredRow> answered(const Study& study, std::vector<LedgerRow> rows);

/// The estimate of a parameter, a quantity of the tissue or an index of a spectrum.
struct QuantityEstimate {
    double value;
    std::optional<double> sigma;        ///< of a parameter or an index, where it has one
    std::optional<Bounds> interval_95;  ///< of a parameter or a quantity of the tissue
    bool decided_by_prior = false;
    bool split_by_model = false;
};

/// Of a sampled posterior its mean and standard deviation, else value and sigma of the fit. None where the spectrum has
/// no such estimate, or no answer: `has_answer`.
[[nodiscard]] std::optional<QuantityEstimate> estimate_of(const LedgerRow& row, const std::string& quantity);

}  // namespace skinfit
