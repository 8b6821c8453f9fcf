#pragma once

#include <string>
#include <string_view>

#include "fit/settings.hpp"
#include "measurements/spectrum_file.hpp"

namespace skinfit {

/// What a file of spectra holds, for the page: the inspection with its findings, and under "measured" the spectra in
/// the form of `spectra_json`, which a fit takes back. Throws InputError for more than 200 spectra.
[[nodiscard]] Json uploaded_json(SpectrumFile file);

/// The same for bytes that a page sends; `name` stands for the file in messages and is never opened.
[[nodiscard]] Json uploaded_json(std::string_view bytes, const std::string& name);

}  // namespace skinfit
