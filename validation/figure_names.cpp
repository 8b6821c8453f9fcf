#include "validation/figure_names.hpp"

namespace skinfit {

std::string_view name_of(Edition edition) {
    return edition == Edition::printed ? "printed" : "revised";
}

std::string_view quantity_name(FigureKind kind, const FigurePanel& panel) {
    if (kind == FigureKind::extinction) return "extinction_per_cm_per_g_per_l";
    const Quantity quantity = panel.series.front().configuration.quantity.value_or(default_quantity);
    return quantity_names.at(static_cast<std::size_t>(quantity));
}

std::span<const PigmentRow> pigment_table() {
    static constexpr std::array<PigmentRow, 6> rows = {{{"eumelanin", &Extinction::eumelanin},
                                                        {"pheomelanin", &Extinction::pheomelanin},
                                                        {"oxyhemoglobin", &Extinction::oxyhemoglobin},
                                                        {"deoxyhemoglobin", &Extinction::deoxyhemoglobin},
                                                        {"bilirubin", &Extinction::bilirubin},
                                                        {"carotene", &Extinction::carotene}}};
    return rows;
}

}  // namespace skinfit
