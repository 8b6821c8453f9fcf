#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "fit/settings.hpp"
#include "measurements/spectrum_file.hpp"

namespace skinfit {

/// What a file of spectra holds, for the page: the inspection with its findings; under "measured" the spectra in the
/// form of `spectra_json`, which a fit takes back; and under "statements", for each, all that it states beside its
/// values, in the same form with one reading: enough to draw the model that a fit of it takes. Throws InputError for
/// more than 200 spectra.
[[nodiscard]] Json uploaded_json(SpectrumFile file);

/// The same for bytes that a page sends; `name` stands for the file in messages and is never opened. Of a file too
/// large to be sent, `bytes` are the beginning and `size_bytes` is larger. Throws InputError for such a file, and for
/// either of the two files of an ENVI cube, naming the command that reads it.
[[nodiscard]] Json uploaded_json(std::string_view bytes, const std::string& name,
                                 const std::optional<std::uint64_t>& size_bytes);

/// The same for a specimen that comes with the program, to begin with.
[[nodiscard]] Json sample_json();

}  // namespace skinfit
