#pragma once

#include <Eigen/SparseCore>
#include <optional>
#include <vector>

#include "measurements/spectrum.hpp"
#include "model/spectrophotometer.hpp"

namespace skinfit {

/// How the readings of an instrument are made of the model's readings at single wavelengths: a reading is the integral
/// of the model over the instrument's bandpass about the stated wavelength, with the model linear between the multiples
/// of 2 nm, at which the extinctions of hemoglobin are tabulated. The integral of that is exact.
struct BandSampling {
    std::vector<double> wavelength_nm;  ///< at which the model is needed, ascending
    /// Readings x wavelengths; the rows add up to 1. Without rows a reading is the model at its own wavelength.
    Eigen::SparseMatrix<double, Eigen::RowMajor> weights;

    /// The readings, or their derivatives, from those at `wavelength_nm` (rows).
    [[nodiscard]] Eigen::VectorXd readings(Eigen::VectorXd modelled) const;
    [[nodiscard]] Eigen::MatrixXd readings(Eigen::MatrixXd modelled) const;
};

/// The sampling for readings at `centres_nm`, ascending in any steps. No bandpass, or one without width: the
/// wavelengths themselves, and no weights.
[[nodiscard]] BandSampling sample_bands(const std::vector<double>& centres_nm, const std::optional<Bandpass>& bandpass);

/// Simulated readings at `centres_nm` from those at `bands.wavelength_nm`. Standard errors add up as readings do, since
/// neighbouring wavelengths share their random numbers; so they are an upper limit for those of the analog walk.
[[nodiscard]] std::vector<Reading> readings_in_bands(const std::vector<Reading>& modelled, const BandSampling& bands,
                                                     const std::vector<double>& centres_nm);

}  // namespace skinfit
