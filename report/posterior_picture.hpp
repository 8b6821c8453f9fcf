#pragma once

#include <string>

#include "fit/result.hpp"

namespace skinfit {

/// Equal bins over the range of some values.
struct Histogram {
    std::vector<double> centre;
    std::vector<double> share;  ///< of the values; they add up to 1
    double bin_width;
};

/// The histogram of `values` (at least one, not all of them the same) in `bins` bins.
[[nodiscard]] Histogram histogram(const std::vector<double>& values, std::size_t bins);

/// The marginal histograms of the posterior of `result`, which has one, with the best fit and the ends of the 95 %
/// intervals; parameters whose draws are all the same are left out. As SVG by gnuplot; empty where none is left. Throws
/// InputError when gnuplot is missing or fails.
[[nodiscard]] std::string posterior_picture(const FitResult& result);

}  // namespace skinfit
