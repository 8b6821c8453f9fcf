#include "measurements/spectrum_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "core/utf8.hpp"
#include "measurements/envi_reader.hpp"
#include "measurements/limits.hpp"
#include "measurements/readers.hpp"
#include "measurements/row_header.hpp"
#include "measurements/spectrum_choice.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

struct Reader {
    std::string_view name;
    bool (*recognises)(std::string_view text);
    std::vector<Spectrum> (*read)(std::string_view text, const std::string& source, const ReadOptions& options);
};

/// The last takes whatever the others leave, and says what is wrong with it.
constexpr std::array readers{
    Reader{.name = "qtx", .recognises = holds_qtx, .read = read_qtx},
    Reader{.name = "json", .recognises = holds_json, .read = read_json},
    Reader{.name = "jcamp_dx", .recognises = holds_jcamp_dx, .read = read_jcamp_dx},
    Reader{.name = "cgats", .recognises = holds_cgats, .read = read_cgats},
    Reader{.name = "nist_m38597", .recognises = holds_nist_m38597, .read = read_nist_m38597},
    Reader{.name = "rows", .recognises = holds_spectra_in_rows, .read = read_rows},
    Reader{.name = "columns", .recognises = [](std::string_view) { return true; }, .read = read_columns},
};

const Reader& find_reader(std::string_view text, const std::optional<std::string>& wanted) {
    if (!wanted) {
        return *std::ranges::find_if(readers, [text](const Reader& reader) { return reader.recognises(text); });
    }
    const auto named = std::ranges::find(readers, *wanted, &Reader::name);
    if (named != readers.end()) return *named;
    const std::vector<std::string_view> names = reader_names();
    throw InputError(
        {.where = fmt::format("--reader {}", *wanted),
         .problem = "there is no such reader",
         .why = fmt::format("it is none of {}", fmt::join(names, ", ")),
         .remedy = fmt::format("did you mean {}? Else leave the option out", nearest_name(*wanted, names))});
}

/// Spreadsheets are zip archives too.
void refuse_zip(std::string_view text, const std::string& source) {
    if (!text.starts_with("PK\x03\x04") && !text.starts_with("PK\x05\x06")) return;
    throw InputError({.where = source,
                      .problem = "is a zip archive",
                      .why = "plain text is needed; spreadsheets such as .xlsx and .ods are zip archives too",
                      .remedy = "unpack it, or export the spreadsheet as CSV in UTF-8"});
}

/// Leaves out what is no spectrum that can be used, and says so. Throws InputError where nothing else is left.
void leave_out_unusable(SpectrumFile& file) {
    const auto is_unusable = [](const Spectrum& spectrum) { return !spectrum.unusable.empty(); };
    const auto first = std::ranges::find_if(file.spectra, is_unusable);
    if (first == file.spectra.end()) return;
    if (std::ranges::all_of(file.spectra, is_unusable)) {
        throw InputError(
            {.where = first->line > 0 ? fmt::format("{}:{}", file.source, first->line) : file.source,
             .problem = fmt::format("{} cannot be used", in_quotes(first->name)),
             .why = first->unusable,
             .remedy = "export the reflectance or transmittance; of an absorbance A or log(1/R) it is 10^-A"});
    }
    const std::string remark = fmt::format("left out: {} of {} spectra, the first of them {} ({})",
                                           std::ranges::count_if(file.spectra, is_unusable), file.spectra.size(),
                                           in_quotes(first->name), first->unusable);
    std::erase_if(file.spectra, is_unusable);
    for (Spectrum& spectrum : file.spectra) spectrum.remarks.push_back(remark);
}

/// Text has no pixels to choose.
void refuse_region(const RegionChoice& region, const std::string& source) {
    if (!region.mask && !region.rectangle) return;
    throw InputError({.where = source,
                      .problem = "is no ENVI cube",
                      .why = "a mask or rectangle chooses pixels of one",
                      .remedy = "leave the mask and the rectangle out"});
}

/// The text of a file. One whose first line is too long is refused before all of it is read. JSON may be one line; the
/// rest of the lines is checked where they are taken apart.
std::string text_of(const std::filesystem::path& path) {
    std::size_t looked_at = 0;
    bool is_good = false;
    return read_input(path, [&](std::string_view so_far) {
        is_good = is_good || trimmed(so_far).starts_with('{') || trimmed(so_far).starts_with('[') ||
                  so_far.find_first_of("\r\n", looked_at) != std::string_view::npos;
        looked_at = so_far.size();
        if (!is_good) refuse_long_line(so_far.size(), 1, path.string());
        return true;
    });
}

/// What the file calls things, as it may be shown.
SpectrumFile with_printable_words(SpectrumFile file) {
    for (Spectrum& spectrum : file.spectra) {
        for (std::string* word : {&spectrum.name, &spectrum.source, &spectrum.unit_rule, &spectrum.sigma_source,
                                  &spectrum.instrument, &spectrum.site}) {
            *word = printable(*word);
        }
        for (FileNote& note : spectrum.notes) {
            note.key = printable(note.key);
            note.value = printable(note.value);
        }
        for (std::string& remark : spectrum.remarks) remark = printable(remark);
        for (FileDoubt& doubt : spectrum.doubts) doubt.message = printable(doubt.message);
    }
    file.source = printable(file.source);
    return file;
}

}  // namespace

OpenedSpectra open_spectra(const std::filesystem::path& path, const std::optional<std::string>& reader) {
    OpenedSpectra opened{.source = path.string(), .text = {}, .cube = {}, .reader = reader};
    if (reader == envi_reader_name) {
        opened.cube = find_envi_files(path);
        return opened;
    }
    const std::optional<EnviHeaderFile> beside = reader ? std::nullopt : envi_header_beside(path);
    if (beside) {
        opened.cube = EnviFiles{.header = beside->path, .data = path, .header_text = beside->text};
        return opened;
    }
    opened.text = text_of(path);
    if (!reader && is_envi_header(opened.text)) {
        opened.cube = files_of({.path = path, .text = std::move(opened.text)});
        opened.text.clear();
    }
    return opened;
}

std::vector<std::string_view> reader_names() {
    std::vector<std::string_view> names;
    names.push_back(envi_reader_name);
    for (const Reader& reader : readers) names.push_back(reader.name);
    return names;
}

SpectrumFile parse_spectra(std::string_view text, const std::string& source, const ReadOptions& options,
                           const std::optional<std::string>& reader) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    refuse_zip(text, source);
    refuse_region(options.region, source);
    if (!reader) refuse_two_axes(text, source);
    const Reader& chosen = find_reader(text, reader);
    SpectrumFile file{
        .source = source, .format = std::string(chosen.name), .spectra = chosen.read(text, source, options)};
    if (file.spectra.empty()) {
        throw InputError({.where = source,
                          .problem = "holds no numbers",
                          .why = "every value of every spectrum is missing",
                          .remedy = "check that the file is complete"});
    }
    if (options.column && chosen.read != read_columns) {
        file.spectra = {choose_spectrum(std::move(file.spectra), source, *options.column)};
    }
    leave_out_unusable(file);
    return with_printable_words(std::move(file));
}

SpectrumFile spectra_in(const OpenedSpectra& opened, const ReadOptions& options) {
    if (!opened.cube) return parse_spectra(opened.text, opened.source, options, opened.reader);
    SpectrumFile file{
        .source = opened.source, .format = std::string(envi_reader_name), .spectra = read_envi(*opened.cube, options)};
    if (options.column) file.spectra = {choose_spectrum(std::move(file.spectra), file.source, *options.column)};
    return with_printable_words(std::move(file));
}

SpectrumFile read_spectra(const std::filesystem::path& path, const ReadOptions& options,
                          const std::optional<std::string>& reader) {
    return spectra_in(open_spectra(path, reader), options);
}

}  // namespace skinfit
