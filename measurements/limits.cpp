#include "measurements/limits.hpp"

#include <fmt/format.h>

#include "core/input_error.hpp"

namespace skinfit {

void refuse_long_line(std::size_t bytes, std::size_t number, const std::string& source) {
    if (bytes <= longest_line_bytes) return;
    throw InputError({.where = fmt::format("{}:{}", source, number),
                      .problem = fmt::format("has more than {} MiB in one line", longest_line_bytes >> 20U),
                      .why = "no file of spectra has such lines",
                      .remedy = "check that this is a file of spectra"});
}

void refuse_large_text(std::string_view text, const std::string& source) {
    if (text.size() <= largest_structured_bytes) return;
    throw InputError(
        {.where = source,
         .problem = fmt::format("has {} MiB", text.size() >> 20U),
         .why = fmt::format("at most {} MiB of JSON, JCAMP-DX or CGATS are read", largest_structured_bytes >> 20U),
         .remedy = "split it, or write it as CSV"});
}

}  // namespace skinfit
