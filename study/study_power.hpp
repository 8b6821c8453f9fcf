#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "study/power.hpp"
#include "study/study_groups.hpp"

namespace skinfit {

/// What is planned: a comparison of two groups of subjects by one quantity.
struct PowerQuestion {
    std::string quantity;               ///< a parameter, a quantity of the tissue or an index
    std::vector<std::size_t> subjects;  ///< per group, each 2 or more
    double power = 0.8;                 ///< of finding the difference, above 0.05 and below 1
    std::size_t repeats = 1;            ///< measurements of each subject, averaged
};

/// A mean of a group, for comparison with another.
struct GroupMean {
    std::string name;
    std::size_t spectra;
    double mean;
};

/// The subjects it takes to tell two groups of the study apart.
struct GroupContrast {
    std::string first;
    std::string second;
    double difference;                    ///< of the means of the estimates, second less first
    std::optional<std::size_t> subjects;  ///< per group; none where a million do not suffice
};

/// What a study says of a planned comparison.
struct PowerAnswer {
    PowerQuestion question;
    bool knows_repeats;  ///< of the study; else `design.measurement_sd` is 0 and that of repeats lies in the other
    TwoGroupDesign design;
    std::string slope_source;  ///< where `design.slope` comes from, in words
    std::vector<GroupMean> groups;
    std::vector<std::optional<double>> detectable;  ///< true difference, in the order of `question.subjects`
    std::vector<GroupContrast> contrasts;           ///< of the first group with each other one
};

/// Answers from the spectra of a study, measured or simulated. The scatter is that of estimates about the mean of their
/// group: between specimens and between repeats where `Study::repeats_of` names them, else between spectra. How much of
/// a true difference estimates show is the slope of estimates against `true_<quantity>` in the metadata where it is
/// there, as in simulated cohorts, else taken as 1. Throws InputError where fewer than two spectra in a group have the
/// quantity, where there is none of that name or the fits hold it, and for repeats whose scatter the study does not
/// know.
[[nodiscard]] PowerAnswer power_answer(const Study& study, const std::vector<AnsweredRow>& rows,
                                       const PowerQuestion& question);

/// As text and as JSON.
[[nodiscard]] std::string power_text(const PowerAnswer& answer);
[[nodiscard]] Json power_json(const PowerAnswer& answer);

}  // namespace skinfit
