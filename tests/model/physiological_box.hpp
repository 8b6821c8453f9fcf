#pragma once

#include <cmath>
#include <vector>

#include "model/emulator.hpp"

namespace skinfit::test {

/// The absorbing parameters of a fit, over more than healthy skin has.
inline const std::vector<ParameterRange> physiological_box = {{Parameter::melanosome_fraction, 0, 0.5},
                                                              {Parameter::papillary_blood_fraction, 0, 0.3},
                                                              {Parameter::reticular_blood_fraction, 0, 0.3},
                                                              {Parameter::oxygen_saturation, 0, 1},
                                                              {Parameter::bilirubin_g_per_l, 0, 3}};

/// Specimen `number` of a low-discrepancy sequence in the domain; other numbers than those that certify.
inline Skin specimen(const EmulatorDomain& domain, int number) {
    ParameterValues values{.skin = domain.sample.skin, .instrument = {}};
    for (std::size_t i = 0; i < domain.ranges.size(); ++i) {
        const double turns = number * std::pow(0.754877666246693, static_cast<double>(i + 1));
        const double place = turns - std::floor(turns);
        const ParameterRange& range = domain.ranges[i];
        value_of(values, range.parameter) =
            std::lerp(range.lower, range.upper, number % 2 == 0 ? place : std::pow(place, 3.0));
    }
    return values.skin;
}

}  // namespace skinfit::test
