#include "measurements/response.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "measurements/cell_numbers.hpp"
#include "measurements/columns.hpp"

namespace skinfit {

double Response::operator()(double at_nm) const {
    if (at_nm < wavelength_nm.front() || at_nm > wavelength_nm.back()) return 0.0;
    const auto above = std::ranges::lower_bound(wavelength_nm, at_nm);
    const auto i = static_cast<std::size_t>(above - wavelength_nm.begin());
    if (*above == at_nm) return value[i];
    const double share = (at_nm - wavelength_nm[i - 1]) / (wavelength_nm[i] - wavelength_nm[i - 1]);
    return value[i - 1] + share * (value[i] - value[i - 1]);
}

Response parse_response(std::string_view text, const std::string& source) {
    const Columns columns = split_columns(text, source);
    std::vector<std::vector<double>> numbers = read_numbers(columns, std::array<std::size_t, 2>{0, 1});
    Response response{.wavelength_nm = std::move(numbers[0]), .value = std::move(numbers[1])};
    for (std::size_t i = 0; i < response.value.size(); ++i) {
        const std::string where = at_line(columns, columns.rows[i].line);
        if (i > 0 && response.wavelength_nm[i] <= response.wavelength_nm[i - 1]) {
            throw InputError({.where = where,
                              .problem = fmt::format("{} nm follows {} nm", response.wavelength_nm[i],
                                                     response.wavelength_nm[i - 1]),
                              .why = "wavelengths must ascend",
                              .remedy = "sort the lines and keep one for each wavelength"});
        }
        if (response.value[i] < 0.0) {
            throw InputError({.where = where,
                              .problem = fmt::format("the response {} is negative", response.value[i]),
                              .why = "it is the weight of a wavelength",
                              .remedy = "correct it or set it to 0"});
        }
    }
    return response;
}

Response read_response(const std::filesystem::path& path) {
    return parse_response(read_input(path), path.string());
}

}  // namespace skinfit
