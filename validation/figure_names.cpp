#include "validation/figure_names.hpp"

namespace skinfit {

std::string_view name_of(Edition edition) {
    return edition == Edition::printed ? "printed" : "revised";
}

std::string_view quantity_name(const FigurePanel& panel) {
    const Quantity quantity = panel.series.front().configuration.quantity.value_or(default_quantity);
    return quantity_names.at(static_cast<std::size_t>(quantity));
}

}  // namespace skinfit
