#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fit/gnuplot.hpp"
#include "study/agreement.hpp"
#include "study/calibration.hpp"
#include "study/power.hpp"
#include "study/repeatability.hpp"
#include "study/roc.hpp"

/// Pictures of studies. All text is UTF-8 and printed as it is.
namespace skinfit {

/// A picture: gnuplot's commands but for the choice of a terminal.
struct StudyFigure {
    std::string script;
    PictureSize size;
};

/// The picture as SVG text, which stands alone.
[[nodiscard]] std::string svg_of(const StudyFigure& figure);

/// Draws `figure` as `draw(Plot, path)` does, with the same errors.
void draw(const StudyFigure& figure, const std::filesystem::path& path);

/// The curve with its area and interval, and up to six operating points with theirs. Without an area the picture
/// says why.
[[nodiscard]] StudyFigure roc_figure(const RocAnalysis& roc, const std::vector<OperatingPoint>& marked,
                                     const std::string& title);

/// Observed shares against mean probabilities, with the Brier score and its test.
[[nodiscard]] StudyFigure calibration_figure(const CalibrationAnalysis& calibration, const std::string& title);

/// What is compared with a reference.
struct ComparedQuantity {
    std::string name;  ///< "bilirubin"
    std::string unit;  ///< "g/L"; empty: none
};

/// Differences against means [BLAND86], with bias and limits of agreement and their intervals as bands. `agreement` is
/// that of `pairs`.
[[nodiscard]] StudyFigure bland_altman_figure(const std::vector<ReferencePair>& pairs, const MethodAgreement& agreement,
                                              const ComparedQuantity& quantity);

/// Estimates, with their claimed sigmas, against reference values, with identity and the fitted line.
[[nodiscard]] StudyFigure reference_figure(const std::vector<ReferencePair>& pairs, const MethodAgreement& agreement,
                                           const ComparedQuantity& quantity);

/// One row of a picture of repeatability.
struct NamedScatter {
    std::string name;
    ClaimedScatter claimed;
};

/// The scatter of repeats over what is claimed, one row per parameter, from above; at least one.
[[nodiscard]] StudyFigure repeatability_figure(const std::vector<NamedScatter>& parameters, const std::string& title);

/// The values of one group.
struct ValueGroup {
    std::string name;
    std::vector<double> values;  ///< values that are not numbers are left out
};

/// All values of each group, with boxes of their quartiles; at least one number in all.
[[nodiscard]] StudyFigure group_figure(const std::vector<ValueGroup>& groups, const ComparedQuantity& quantity);

/// One curve of a picture of power.
struct NamedDesign {
    std::string name;
    TwoGroupDesign design;  ///< of a slope other than 0
};

/// The true difference found with probability `power` against the number of subjects per group, from 2 to
/// `most_subjects`, above 2; one to seven designs.
[[nodiscard]] StudyFigure power_figure(const std::vector<NamedDesign>& designs, double power, std::size_t most_subjects,
                                       const ComparedQuantity& quantity);

}  // namespace skinfit
