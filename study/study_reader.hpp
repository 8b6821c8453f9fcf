#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>

#include "measurements/envi_files.hpp"
#include "study/roster.hpp"
#include "study/study.hpp"

namespace skinfit {

/// The inputs of a study as one process reads them: once, as long as their numbers take no more than 256 MB; of what is
/// beyond, the last files are kept, and others are read again when they are asked for again. Calls may come from any
/// thread.
class StudyReader {
public:
    /// Refers to the study, which must outlive it.
    explicit StudyReader(const Study& study) : study_(study), window_(window_of(study.configuration)) {}

    /// The study whose inputs these are.
    [[nodiscard]] const Study& study() const { return study_; }

    /// What a fit of the study uses.
    [[nodiscard]] const WavelengthWindow& window() const { return window_; }

    /// The spectra of this one of `Study::files`.
    [[nodiscard]] std::shared_ptr<const StudySpectra> spectra_of(std::size_t file);

    /// The files of this one of `Study::cubes`, with the text of its header. Throws InputError as `find_envi_files`.
    [[nodiscard]] EnviFiles files_of_cube(std::size_t cube);

private:
    const Study& study_;
    WavelengthWindow window_;
    std::mutex mutex_;
    std::size_t numbers_ = 0;  ///< in `kept_`
    std::map<std::size_t, std::shared_ptr<const StudySpectra>> kept_;
    std::map<std::size_t, std::shared_ptr<const StudySpectra>> last_;
    std::map<std::size_t, EnviFiles> cubes_;
};

}  // namespace skinfit
