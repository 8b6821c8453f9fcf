#pragma once

#include <vector>

#include "model/emulator.hpp"

namespace skinfit::test {

/// The absorbing parameters of a fit, over more than healthy skin has.
inline const std::vector<ParameterRange> physiological_box = {{Parameter::melanosome_fraction, 0, 0.5},
                                                              {Parameter::papillary_blood_fraction, 0, 0.3},
                                                              {Parameter::reticular_blood_fraction, 0, 0.3},
                                                              {Parameter::oxygen_saturation, 0, 1},
                                                              {Parameter::bilirubin_g_per_l, 0, 3}};

}  // namespace skinfit::test
