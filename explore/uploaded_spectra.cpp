#include "explore/uploaded_spectra.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "core/embedded_file.hpp"
#include "core/input_error.hpp"
#include "explore/server.hpp"
#include "fit/inspection.hpp"
#include "measurements/envi_header.hpp"
#include "measurements/spectrum_writer.hpp"
#include "measurements/words.hpp"

namespace skinfit {

namespace explore_files {
std::span<const EmbeddedFile> embedded_files();
}  // namespace explore_files

namespace {

/// Without its readings: of one that stands for all of them.
Spectrum statement_of(Spectrum spectrum) {
    spectrum.name.clear();
    spectrum.wavelength_nm = {500.0};
    spectrum.value = {0.5};
    spectrum.sigma.clear();
    spectrum.repeats.clear();
    spectrum.missing_nm.clear();
    spectrum.repeated.clear();
    return spectrum;
}

Json list_of(const std::vector<Spectrum>& spectra) {
    return Json::parse(spectra_json(spectra))["spectra"];
}

/// Text has none of these.
bool is_binary(std::string_view bytes) {
    return bytes.find('\0') != std::string_view::npos;
}

/// Whether `name` is one that the data of an ENVI cube have. Text files have some of them too.
bool is_named_as_cube(const std::string& name) {
    static constexpr std::array<std::string_view, 9> endings = {".img", ".dat", ".raw",  ".bin", ".bsq",
                                                                ".bil", ".bip", ".cube", ".sli"};
    const std::string ending = lower_case(std::filesystem::path(name).extension().string());
    return std::ranges::find(endings, ending) != endings.end();
}

[[noreturn]] void refuse_cube(const std::string& name, std::string_view part) {
    throw InputError({.where = name,
                      .problem = fmt::format("is {} of an ENVI cube", part),
                      .why = "a cube is two files, the header (.hdr) and the data, and a page sends each file alone",
                      .remedy =
                          "give it to a command, which finds the other file beside it: skinfit fit FILE fits the mean "
                          "spectrum, skinfit explore FILE opens this page with it; FILE is either of the two"});
}

void refuse_what_a_page_cannot_send(std::string_view bytes, const std::string& name, std::uint64_t size_bytes) {
    const bool is_cut = size_bytes > bytes.size();
    if (is_envi_header(bytes)) refuse_cube(name, "the header");
    if ((is_cut || is_binary(bytes)) && is_named_as_cube(name)) refuse_cube(name, "by its name the data");
    if (!is_cut) return;
    throw InputError({.where = name,
                      .problem = fmt::format("has {:.1f} MiB", static_cast<double>(size_bytes) / (1U << 20U)),
                      .why = fmt::format("a page sends {} MiB at most", largest_body_bytes >> 20U),
                      .remedy = "give it to a command, such as skinfit inspect FILE, or pick some of its spectra with "
                                "skinfit convert --column"});
}

}  // namespace

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
    json["measured"] = list_of(inspection.file.spectra);
    std::vector<Spectrum> statements;
    for (const Spectrum& spectrum : inspection.file.spectra) statements.push_back(statement_of(spectrum));
    json["statements"] = list_of(statements);
    return json;
}

Json uploaded_json(std::string_view bytes, const std::string& name, const std::optional<std::uint64_t>& size_bytes) {
    refuse_what_a_page_cannot_send(bytes, name, size_bytes.value_or(bytes.size()));
    return uploaded_json(parse_spectra(bytes, name, {.window = usual_window()}));
}

Json sample_json() {
    const EmbeddedFile& sample = explore_files::embedded_files().front();
    return uploaded_json(parse_spectra(sample.text, std::string(sample.name), {.window = usual_window()}));
}

}  // namespace skinfit
