#pragma once

#include "study/cohort.hpp"

namespace skinfit {

/// Throws InputError, naming `where`, for entries of `cohort.study` that a study of its spectra could not use.
void check_study(const Cohort& cohort, const std::string& where);

/// The settings of a fit that knows of the cohort what there is to know: geometry, noise, discrepancy and what is held;
/// free is what differs between subjects, with the prior from which it is drawn where that is the same in all groups,
/// else uniform over what the groups allow together. By the emulator where that can be, else by the solver. Of a cohort
/// by transport, whose skin the model does not have, the preset for measured skin with geometry and noise alone.
[[nodiscard]] Configuration planned_fit(const Cohort& cohort);

/// The study of the cohort's spectra, as `skinfit study run` takes it: they are fitted by `planned_fit`, every label is
/// an indicator that is held against the truth, and every parameter against its true value, as far as it means the same
/// in the physics that made the spectra; with what `cohort.study`
/// replaces.
[[nodiscard]] Json study_json(const Cohort& cohort);

}  // namespace skinfit
