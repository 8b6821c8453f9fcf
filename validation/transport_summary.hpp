#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/json.hpp"
#include "study/interval_estimate.hpp"
#include "validation/transport_study.hpp"

namespace skinfit {

/// One number by which a study is judged.
struct JudgedFigure {
    std::string_view quantity;  ///< that it is about, a name of `shared_quantity_names`
    std::string_view figure;    ///< JSON key and report row
    std::string_view spectra;   ///< of which it is taken
    std::size_t count;          ///< how many
    IntervalEstimate found;
    Bounds wanted;  ///< infinite where there is no limit

    /// Unless its 95 % interval lies wholly beyond what is wanted.
    [[nodiscard]] bool passes() const;
};

/// What a study by another physics has found.
struct TransportSummary {
    std::string cohort;
    std::size_t spectra;
    std::size_t consistent;  ///< answers without a reason for doubt
    std::size_t failed;
    std::vector<JudgedFigure> figures;  ///< those for which there are spectra enough
};

/// Saturation, of skins without and with bilirubin: mean absolute error, which has to be below that of the best
/// constant and, without bilirubin, below that of a linear regression of log(1/R) from 500 to 650 nm on these very
/// skins, each left out of its own; bias; coverage of 95 % intervals. Bilirubin of the tissue: area under the ROC curve
/// of above 0.01 g/L against none in the lighter and the darker half, and how often the interval of a consistent answer
/// lies below the truth. Melanin: rank correlation and log-log slope. Dermal hemoglobin: the same, the ratio to the
/// truth and coverage.
[[nodiscard]] TransportSummary summarised(const TransportStudy& study);

/// Whether there are figures, all of them pass, and no more than one fit in twenty failed.
[[nodiscard]] bool passes(const TransportSummary& summary);

/// For people: the verdict first.
[[nodiscard]] std::string transport_text(const TransportSummary& summary);

/// For programs.
[[nodiscard]] Json transport_json(const TransportSummary& summary);

/// A row per skin and quantity.
[[nodiscard]] std::string transport_csv(const TransportStudy& study);

}  // namespace skinfit
