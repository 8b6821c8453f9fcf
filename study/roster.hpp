#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "measurements/spectrum.hpp"
#include "measurements/wavelength_window.hpp"
#include "study/fit_status.hpp"
#include "study/study.hpp"

namespace skinfit {

/// What is known of a spectrum before any fit.
struct Refusal {
    FitStatus status;  ///< rejected or failed
    std::string reason;
};

/// A spectrum of a study, before it is fitted.
struct RosterEntry {
    std::string source;      ///< its file, as the ledger names it
    std::size_t number = 0;  ///< in the file, from 1; 0 stands for a file that cannot be read
    std::string name;
    Metadata metadata;
    std::string input_hash;          ///< changes when anything that a fit reads does
    std::optional<Refusal> refusal;  ///< it is not fitted
};

/// The spectra of one file of a study.
struct StudySpectra {
    std::vector<RosterEntry> entries;  ///< one per spectrum of the study; one for a file that cannot be read
    std::vector<Spectrum> spectra;     ///< of the entries; none for a file that cannot be read
    std::size_t left_out = 0;          ///< spectra that the study's pattern of names does not know
};

/// Reads one file; nothing outside `window` decides its unit. What cannot be read, a line of a manifest that names no
/// spectrum of it too, becomes an entry with a refusal.
[[nodiscard]] StudySpectra read_study_file(const StudyFile& file, const WavelengthWindow& window = {});

/// What a spectrum is to a fit, in one word; where it came from and what it is called have no part in it.
[[nodiscard]] std::string input_hash_of(const Spectrum& spectrum);

/// Refuses what repeats the values of an earlier entry in `window`; `seen` remembers them from file to file.
void refuse_duplicates(StudySpectra& spectra, std::map<std::string, std::string>& seen,
                       const WavelengthWindow& window = {});

}  // namespace skinfit
