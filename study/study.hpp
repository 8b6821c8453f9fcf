#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/json.hpp"
#include "fit/configuration.hpp"
#include "measurements/region_choice.hpp"
#include "measurements/spectrum.hpp"

/// Studies: many spectra and whole hyperspectral images, described by one file.
namespace skinfit {

/// What refusals of study files point at.
inline constexpr const char* study_example = "configs/study_example.json, which comes with skinfit, is an example";

/// What is known of a spectrum beside its values, such as its subject: names and words, in the order of their source.
using Metadata = std::vector<std::pair<std::string, std::string>>;

/// The word called `name`; empty where there is none.
[[nodiscard]] std::string word_of(const Metadata& metadata, std::string_view name);

/// `metadata` with what `more` says, which goes before.
[[nodiscard]] Metadata merged(Metadata metadata, const Metadata& more);

/// `metadata` as an object, and back.
[[nodiscard]] Json metadata_json(const Metadata& metadata);
[[nodiscard]] Metadata metadata_from(const Json& json);

/// One spectrum of a file that a manifest names, and what it says of it.
struct SelectedSpectrum {
    std::string spectrum;  ///< its name, else its number in the file; empty: every spectrum of the file
    Metadata metadata;
    std::string where;  ///< the line of the manifest
};

/// How the names of spectra are read: a regular expression and what its groups mean.
struct NamePattern {
    std::string expression;           ///< of RE2, found anywhere in the name in linear time
    std::vector<std::string> fields;  ///< one per group
};

/// A file of spectra.
struct StudyFile {
    std::string source;  ///< as the ledger names it: relative to the study's folder where it lies below it
    std::filesystem::path path;
    std::optional<Unit> unit;
    std::optional<std::string> reader;
    Metadata metadata;                       ///< of all its spectra
    std::optional<NamePattern> names;        ///< spectra with other names do not belong to the study
    std::vector<SelectedSpectrum> selected;  ///< empty: all
};

/// A hyperspectral image, of which every pixel is fitted.
struct StudyCube {
    std::string source;
    std::filesystem::path path;
    std::optional<Unit> unit;
    RegionChoice region;
    Metadata metadata;
};

/// Other spectra with which one is compared: those of the same word under `same` whose metadata hold `where`.
struct ReferenceSite {
    std::string same;
    Metadata where;
};

/// A question with a probability for an answer.
struct Indicator {
    std::string name;
    std::string quantity;                    ///< name of a parameter, a quantity of the tissue or an index
    bool above = true;                       ///< above the threshold, else below
    std::optional<double> threshold;         ///< in the quantity's unit; set where `reference` is not
    std::optional<ReferenceSite> reference;  ///< a value measured elsewhere is the threshold
    std::string source;                      ///< where the threshold comes from
    /// The share of those who are measured that lies beyond the threshold, 0 to 1 exclusive; unset: as the prior says.
    std::optional<double> prevalence{};
};

/// A check of the study's answers against what is known of its spectra.
struct Assessment {
    std::string name;                     ///< of an indicator; or as `Indicator::quantity`
    bool is_indicator = true;             ///< compared with a label, else with numbers
    std::string metadata;                 ///< the label, or the reference value in the quantity's unit
    std::string positive;                 ///< the word of the label that stands for yes
    std::vector<double> thresholds{0.5};  ///< probabilities from which the answer is yes
};

/// The configuration of the fits of a study with preset paper: fitted by the emulator.
[[nodiscard]] Configuration default_study_configuration();

/// A study, as its file describes it.
struct Study {
    std::string name;
    std::filesystem::path file;
    std::vector<StudyFile> files;  ///< in the order of `inputs`; no two have the same source
    std::vector<StudyCube> cubes;
    Json fit = Json::object();                                    ///< settings of the fits, as the file states them
    std::optional<std::string> instrument;                        ///< beside them
    Configuration configuration = default_study_configuration();  ///< of the fits, with both of these; begins with
                                                                  ///< preset skin, with paper where there are images
    std::vector<std::string> accept;                              ///< quality findings that do not reject a spectrum
    std::vector<std::string> group_by;
    std::string repeats_of;  ///< metadata that name a specimen: spectra with the same word are repeats; empty: none
    std::vector<Indicator> indicators;
    std::vector<Assessment> assessments;
    std::filesystem::path output;  ///< folder of the ledger, maps and reports
};

/// The study that the file at `path` describes; what it names lies relative to its folder, and its inputs relative to
/// the folder `data` where that is given. Throws InputError for a file that is missing, no JSON or has unknown names,
/// for a pattern of files that none matches, a file that two inputs name, a manifest that cannot be read, and as
/// `configured`. Files of spectra are not read.
[[nodiscard]] Study read_study(const std::filesystem::path& path, const std::filesystem::path& data = {});

/// The same from text; `path` names it in messages and is where relative names start.
[[nodiscard]] Study parse_study(std::string_view text, const std::filesystem::path& path,
                                const std::filesystem::path& data = {});

}  // namespace skinfit
