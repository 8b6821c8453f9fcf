#pragma once

#include <array>
#include <string_view>

namespace skinfit {

/// Of lines and points: told apart on white, by most who see colours differently too.
inline constexpr std::array<std::string_view, 7> plot_colours = {"#0072b2", "#e69f00", "#009e73", "#cc3311",
                                                                 "#9467bd", "#8c564b", "#56b4e9"};

}  // namespace skinfit
