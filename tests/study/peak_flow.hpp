#pragma once

#include <vector>

namespace skinfit::test {

/// Peak expiratory flow of 17 subjects in l/min, twice by each of two meters: the data of [BLAND86].
inline const std::vector<double> wright_first = {494, 395, 516, 434, 476, 557, 413, 442, 650,
                                                 433, 417, 656, 267, 478, 178, 423, 427};
inline const std::vector<double> wright_second = {490, 397, 512, 401, 470, 611, 415, 431, 638,
                                                  429, 420, 633, 275, 492, 165, 372, 421};
inline const std::vector<double> mini_wright_first = {512, 430, 520, 428, 500, 600, 364, 380, 658,
                                                      445, 432, 626, 260, 477, 259, 350, 451};
inline const std::vector<double> mini_wright_second = {525, 415, 508, 444, 500, 625, 460, 390, 642,
                                                       432, 420, 605, 227, 467, 268, 370, 443};

}  // namespace skinfit::test
