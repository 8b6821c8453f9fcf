#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "measurements/spectrum.hpp"
#include "measurements/text_reader.hpp"

/// One reader per form of text. Each says whether it recognises a text and takes all spectra out of one that has its
/// form: those with at least one value, missing values left out and counted. `source` names the text in messages; of
/// `options`, only `columns` heeds the choice of a column. All throw InputError for text that is not of their form.
namespace skinfit {

/// Wavelengths in the first column, one spectrum in each other one.
[[nodiscard]] std::vector<Spectrum> read_columns(std::string_view text, const std::string& source,
                                                 const ReadOptions& options);

/// One spectrum per row: labels, the first of which names it, then its values. The header holds names of the labels,
/// then at least three wavelengths in nm that ascend or descend, as in Xiao et al. 2016, Opt. Express 24, 14934:
/// `id,360,370,...`. The other labels become notes.
[[nodiscard]] bool holds_spectra_in_rows(std::string_view text);
[[nodiscard]] std::vector<Spectrum> read_rows(std::string_view text, const std::string& source,
                                              const ReadOptions& options);

/// The form of NIST data set M38597 (Cooksey, Allen, Tsai 2017, J. Res. NIST 122, 26): prose, a line of subjects, a
/// line of their readings (R1, R2, ... and Average), then wavelengths and values in columns. Every reading is a
/// spectrum; the average, called `mean`, carries the subject's readings as its repeats and takes its uncertainty from
/// them.
[[nodiscard]] bool holds_nist_m38597(std::string_view text);
[[nodiscard]] std::vector<Spectrum> read_nist_m38597(std::string_view text, const std::string& source,
                                                     const ReadOptions& options);

/// CGATS.17 tables, such as Argyll's `.ti3` and `.sp` (Argyll CMS, "File formats"): keywords, fields between
/// BEGIN_DATA_FORMAT and END_DATA_FORMAT, sets between BEGIN_DATA and END_DATA (`cgats_tables`). `cgats_bands` says
/// which fields are a spectrum; 0 stands for a missing value. Sets are called by SAMPLE_NAME, else by SAMPLE_ID. All
/// sets of a table have one unit: percent or fraction by the names of the fields, else readings are divided by
/// SPECTRAL_NORM. Keywords and labels state quantity, geometry and instrument (`cgats_statements`). A set that cannot
/// be used is left out with a remark where there are others.
[[nodiscard]] bool holds_cgats(std::string_view text);
[[nodiscard]] std::vector<Spectrum> read_cgats(std::string_view text, const std::string& source,
                                               const ReadOptions& options);

/// JCAMP-DX (McDonald and Wilks 1988, Appl. Spectrosc. 42, 151): labelled records `##LABEL= value` in blocks from
/// ##TITLE to ##END, which LINK blocks may hold several of; `$$` starts a comment. Read are XYDATA=(X++(Y..Y)), in all
/// the forms that `decode_jcamp_line` states and with the checks of `jcamp_points`, and XYPOINTS or XYDATA=(XY..XY);
/// what stands in XYDATA decides. XUNITS are a unit of length, of frequency or 1/CM; YUNITS REFLECTANCE or
/// TRANSMITTANCE in some words, with `%` where they are percent. Blocks that cannot be used, as those of COUNTS, are
/// left out with a remark where there are others.
[[nodiscard]] bool holds_jcamp_dx(std::string_view text);
[[nodiscard]] std::vector<Spectrum> read_jcamp_dx(std::string_view text, const std::string& source,
                                                  const ReadOptions& options);

/// QTX, as Datacolor and other colour software exchange: sections [STANDARD_DATA n] and [BATCH_DATA n] with the
/// readings in percent, STD_R= or BAT_R=, every REFLINTERVAL from REFLLOW nm, as many as REFLPOINTS; NAME, VIEWING (SCI
/// or SCE). A section that cannot be used is left out with a remark where there are others.
[[nodiscard]] bool holds_qtx(std::string_view text);
[[nodiscard]] std::vector<Spectrum> read_qtx(std::string_view text, const std::string& source,
                                             const ReadOptions& options);

/// JSON: a spectrum, a list of them, or `{"spectra": [...]}` as `spectra_json` writes. A spectrum is an object of
/// `value` (or `values`), null where one is missing, and of `wavelength_nm` or `start` and `step` in nm; beside them
/// `sigma`, and the names under which comments of text files describe a measurement. Other names become notes.
[[nodiscard]] bool holds_json(std::string_view text);
[[nodiscard]] std::vector<Spectrum> read_json(std::string_view text, const std::string& source,
                                              const ReadOptions& options);

}  // namespace skinfit
