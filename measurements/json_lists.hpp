#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measurements/abscissa.hpp"
#include "measurements/json_object.hpp"

/// The lists of numbers in an object of JSON that make a spectrum. All throw InputError that names the object.
namespace skinfit {

/// The numbers along a spectrum.
struct JsonAbscissa {
    std::vector<double> numbers;
    std::optional<Abscissa> stated{};  ///< by the name of their list, as `frequency_thz`
};

/// The list of values: called `value` or `values`, else by a quantity, as `reflectance`.
struct JsonValues {
    std::string name;
    std::vector<double> numbers;  ///< NaN where null
};
[[nodiscard]] JsonValues values_in(const JsonObject& object);

/// Of `count` values: the list `wavelength_nm`, else one called by an abscissa, else from `start` on by `step`. Throws
/// InputError, too, where `start` or `step` contradict the list.
[[nodiscard]] JsonAbscissa abscissa_in(const JsonObject& object, std::size_t count);

/// Uncertainties of values, and what the file calls them; empty where there are none.
struct JsonUncertainty {
    std::string name{};
    std::vector<double> sigma{};  ///< NaN where one is missing
    std::vector<std::string> remarks{};
};
/// Of `count` values: `sigma`, else the list or number under the best of names such as `sd`, `stderr` or `uncertainty`.
/// A number is that of all values.
[[nodiscard]] JsonUncertainty uncertainty_in(const JsonObject& object, std::size_t count);

/// True for names of lists that these take.
[[nodiscard]] bool is_taken_list(std::string_view name, const Json& value);

}  // namespace skinfit
