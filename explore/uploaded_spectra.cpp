#include "explore/uploaded_spectra.hpp"

#include <fmt/format.h>

#include "core/input_error.hpp"
#include "fit/inspection.hpp"
#include "measurements/spectrum_writer.hpp"

namespace skinfit {

Json uploaded_json(SpectrumFile file) {
    constexpr std::size_t most = 200;
    if (file.spectra.size() > most) {
        throw InputError({.where = file.source,
                          .problem = fmt::format("holds {} spectra", file.spectra.size()),
                          .why = fmt::format("a page shows {} at most", most),
                          .remedy = "pick some of them with `skinfit convert --column`"});
    }
    const Inspection inspection = inspected(std::move(file));
    Json json = inspection_json(inspection);
    json["measured"] = Json::parse(spectra_json(inspection.file.spectra))["spectra"];
    return json;
}

Json uploaded_json(std::string_view bytes, const std::string& name) {
    return uploaded_json(parse_spectra(bytes, name, {.window = usual_window()}));
}

}  // namespace skinfit
