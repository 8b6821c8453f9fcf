#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fit/result.hpp"
#include "study/cohort_simulation.hpp"
#include "validation/inverse_study.hpp"

/// Fits of spectra that another physics has made, held against its truth in what means the same in both.
namespace skinfit {

/// What is compared. Melanin means the same up to a factor, dermal hemoglobin as far as the depths are weighed alike.
enum class SharedQuantity : std::size_t {
    oxygen_saturation,
    dermal_bilirubin_g_per_l,      ///< in the tissue, outside vessels
    melanosome_fraction,           ///< of the epidermis; there of another table of melanin
    dermal_hemoglobin_umol_per_l,  ///< of `tissue_quantities`: each depth z of the dermis weighted by exp(-z / 0.03 cm)
};
inline constexpr std::size_t shared_quantity_count = 4;
inline constexpr std::array<std::string_view, shared_quantity_count> shared_quantity_names = {
    "oxygen_saturation", "dermal_bilirubin_g_per_l", "melanosome_fraction", "dermal_hemoglobin_umol_per_l"};

/// The fit of one skin.
struct TransportFit {
    std::string name;  ///< of group and number
    std::array<double, shared_quantity_count> truth;
    struct Estimate {
        double value;
        std::optional<Bounds> interval_95;  ///< none where not identifiable
    };
    std::array<std::optional<Estimate>, shared_quantity_count> estimate;  ///< none of what the fit does not adjust
    Verdict verdict;
    std::vector<double> measured;  ///< fractions
};

/// A study by the second physics.
struct TransportStudy {
    std::string cohort;
    std::vector<double> wavelength_nm;
    std::vector<TransportFit> fits;
};

/// The cohort called `name`, `natural` or `factorial`, which is compiled in, else that of the file `name`; of `spectra`
/// skins where that is stated, shared among the groups as theirs are. Throws InputError for one that is not by
/// transport, and as `read_cohort`.
[[nodiscard]] Cohort transport_cohort(const std::string& name, std::optional<std::uint64_t> spectra);

/// `cohort` measured as `configuration` says: its wavelengths, noise, geometry and seed; through a port of
/// `port_diameter_mm` where that is stated. Throws InputError as `read_cohort`.
[[nodiscard]] Cohort measured_as(const Cohort& cohort, const Configuration& configuration,
                                 std::optional<double> port_diameter_mm);

/// Fits every subject's first reading by `configuration`, as `fit_spectrum` does. Where `watch.stop` ends it, those
/// that are finished are returned. In parallel, the same bits on any number of threads. Throws InputError as
/// `make_problem`.
[[nodiscard]] TransportStudy fit_transport_skins(const Cohort& cohort, const SimulatedCohort& simulated,
                                                 const Configuration& configuration, const DiskCache& cache,
                                                 const RecoveryWatch& watch = {});

}  // namespace skinfit
