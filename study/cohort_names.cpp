#include "study/cohort_names.hpp"

#include <algorithm>
#include <array>

#include "fit/settings.hpp"

namespace skinfit {

std::span<const std::string_view> model_settings() {
    static constexpr std::array<std::string_view, 12> names = {
        "edition",          "engine",   "layers",     "base",           "incidence_deg",     "specular",
        "viewing_cone_deg", "quantity", "instrument", "bandpass_shape", "bandpass_width_nm", "rays"};
    return names;
}

std::span<const std::string_view> reading_settings() {
    static constexpr std::array<std::string_view, 5> names = {"incidence_deg", "specular", "viewing_cone_deg",
                                                              "instrument", "bandpass_width_nm"};
    return names;
}

std::string read_cell(const Json& value, const std::string& where) {
    constexpr std::size_t longest = 100;
    const std::string remedy = "give a short name of letters, digits, blanks, _ and -";
    if (!value.is_string()) refuse(where, value, "text is needed", remedy);
    auto text = value.get<std::string>();
    const bool has_control = std::ranges::any_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x20; });
    const bool is_plain = !has_control && text.find_first_of(",;\"#") == std::string::npos;
    const bool is_trimmed = !text.empty() && text.front() != ' ' && text.back() != ' ';
    if (is_plain && is_trimmed && text.size() <= longest) return text;
    refuse(where, value, "it is to be a cell of a table", remedy);
}

void check_column_name(const std::string& name, const std::string& where) {
    constexpr std::array<std::string_view, 5> taken = {"file", "spectrum", "subject", "repeat", "group"};
    (void)read_cell(name, where);
    if (std::ranges::find(taken, name) == taken.end() && !name.starts_with("true_")) return;
    refuse(where, name, "the manifest has a column of that name already", "choose another name");
}

}  // namespace skinfit
