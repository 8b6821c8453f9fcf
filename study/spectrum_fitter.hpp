#pragma once

#include "fit/model_cache.hpp"
#include "measurements/spectrum.hpp"
#include "study/studied_spectrum.hpp"
#include "study/study.hpp"

namespace skinfit {

/// Fits the spectra of a study one by one, as `skinfit fit` does, with models that they share.
class SpectrumFitter {
public:
    /// Refers to the study, which must outlive it.
    SpectrumFitter(const Study& study, const DiskCache& cache);

    /// The answer for one spectrum; never throws for what is wrong with it:
    ///   rejected where `findings_before_fit` has a warning that the study does not accept;
    ///   failed where it cannot be fitted or the search did not converge;
    ///   suspect or fitted as the verdict says.
    /// May be called from any thread; depends on nothing but the spectrum.
    [[nodiscard]] StudiedSpectrum fit(const Spectrum& spectrum);

private:
    [[nodiscard]] StudiedSpectrum fit_it(const Spectrum& spectrum);

    const Study* study_;
    DiskCache cache_;
    ModelCache shelf_;
};

}  // namespace skinfit
