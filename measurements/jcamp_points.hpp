#pragma once

#include <optional>
#include <vector>

#include "measurements/jcamp_blocks.hpp"
#include "measurements/spectrum.hpp"

namespace skinfit {

/// The points of a block of JCAMP-DX, in the order of the file, in its units, scaled by its factors.
struct JcampPoints {
    std::vector<double> x;
    std::vector<double> y;          ///< NaN where one is missing
    std::optional<double> fill{};   ///< a number of the file that stands for missing ordinates, where there is one
    std::vector<FileDoubt> doubts;  ///< where records of the block contradict the points
};

/// Reads the record `data` in the form `(X++(Y..Y))`, or `(XY..XY)` where `in_pairs`. Decimal commas are read where
/// records of the block such as ##FIRSTX= are written with them, or where only so the points are as many as ##NPOINTS=
/// promises.
///
/// ##NPOINTS=, the abscissae of lines and the checks of differences must agree with the data. ##FIRSTX=, ##LASTX=,
/// ##DELTAX=, ##MINX=, ##MAXX=, ##FIRSTY=, ##MINY= and ##MAXY= make a doubt where they do not, beyond the rounding of
/// their last digit and of the ordinates; those of y may be written before or after multiplication by ##YFACTOR=.
///
/// Throws InputError for data that are malformed or contradict that.
[[nodiscard]] JcampPoints jcamp_points(const JcampBlock& block, const JcampRecord& data, bool in_pairs);

}  // namespace skinfit
