#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/geometry.hpp"
#include "fit/derived.hpp"
#include "fit/named_instrument.hpp"
#include "measurements/unit_rule.hpp"
#include "measurements/wavelength_window.hpp"
#include "model/parameters.hpp"
#include "model/skin.hpp"

namespace skinfit {

/// How the model is computed.
enum class Engine {
    paths,     ///< recorded walks: smooth in the pigments
    walk,      ///< the analog walk: simulation only
    solver,    ///< the angular solver: without noise, smooth in every parameter
    emulator,  ///< the angular solver as a polynomial in what absorbs, within the bounds of the free parameters
};
inline constexpr std::array<std::string_view, 4> engine_names = {"paths", "walk", "solver", "emulator"};

/// What minimises the misfit.
enum class Solver {
    ceres,   ///< trust region with the exact Jacobian
    bobyqa,  ///< quadratic model without derivatives, NLopt
    sbplx,   ///< simplices in subspaces, without derivatives, NLopt
    slsqp,   ///< sequential quadratic programming with the exact gradient, NLopt
    crs2,    ///< controlled random search over the whole box, then bobyqa, NLopt
};
inline constexpr std::size_t solver_count = 5;
inline constexpr std::array<std::string_view, solver_count> solver_names = {"ceres", "bobyqa", "sbplx", "slsqp",
                                                                            "crs2"};

/// Where the intervals of a fit come from.
enum class UncertaintyMethod {
    covariance,  ///< the model linearised at the minimum
    profile,     ///< profile likelihood, right at bounds
    posterior,   ///< Markov chain Monte Carlo
};
inline constexpr std::size_t uncertainty_method_count = 3;
inline constexpr std::array<std::string_view, uncertainty_method_count> uncertainty_names = {"covariance", "profile",
                                                                                             "posterior"};

/// Where values, priors, noise and the choice of what is adjusted come from, unless stated.
enum class Preset {
    paper,  ///< [KA04, Table 1]
    skin,   ///< chosen for measured skin: fit/presets/skin.json
};
inline constexpr std::array<std::string_view, 2> preset_names = {"paper", "skin"};

/// Limits of a free parameter, or of a range.
struct Bounds {
    double lower;
    double upper;
};

/// What is known of a quantity beside the spectrum: its distribution.
struct NormalPrior {
    double mean;
    double sigma;  ///< above 0
};
struct LogNormalPrior {
    double median;     ///< above 0
    double sigma_log;  ///< standard deviation of the natural logarithm, above 0
};
/// Proportional to x^(a-1) (1-x)^(b-1) on (0, 1).
struct BetaPrior {
    double a;  ///< above 1: the density has one maximum, inside
    double b;  ///< above 1
};
using Prior = std::variant<NormalPrior, LogNormalPrior, BetaPrior>;

/// How a residual counts.
enum class Loss {
    squares,  ///< its square
    huber,    ///< linearly beyond the scale
    cauchy,   ///< logarithmically beyond the scale
};

/// How the correlation of the model's departure from real skin falls with distance in wavelength.
enum class Kernel { squared_exponential, matern_3_2 };

/// The model's departure from real skin, a Gaussian process over wavelength. Real skin, five pigments fitted, departs
/// smoothly by 0.005-0.01; the length is that of the bends of fitted residuals, which are as wide as a hemoglobin
/// band.
struct Discrepancy {
    double sigma = 0.005;  ///< standard deviation, fraction
    double length_nm = 30;
    Kernel kernel = Kernel::squared_exponential;
};

/// How much the squared residuals of a range of wavelengths count.
struct Weight {
    Bounds range_nm;  ///< both ends included
    double weight;    ///< above 0
};

/// What a fit does with a spectrum, however it was measured. Nothing of it depends on the spectrum.
struct FitSettings {
    Preset preset = Preset::paper;      ///< by which the rest began
    std::optional<std::string> column;  ///< of the measured file; unset: its only spectrum
    std::optional<Unit> unit;           ///< of the measured file; unset: found by `find_unit`
    Engine engine = Engine::paths;
    Solver solver = Solver::ceres;
    UncertaintyMethod uncertainty = UncertaintyMethod::covariance;
    std::uint64_t rays = 100'000;
    std::uint64_t seed = 1;
    std::string wavelengths = "400:700:10";  ///< of a simulation, nm; see `parse_wavelengths`
    double wavelength_min_nm = 400;          ///< of a fit
    double wavelength_max_nm = 700;          ///< of a fit
    std::vector<Bounds> exclude_nm;          ///< ranges of wavelengths a fit leaves out, both ends included
    std::vector<Weight> weights;             ///< 1 elsewhere
    Loss loss = Loss::squares;
    std::optional<double> loss_scale;        ///< sigmas; unset: `default_loss_scale`
    std::optional<Discrepancy> discrepancy;  ///< unset: none
    std::uint64_t starts = 8;                ///< of a fit: the configured one, and points spread over the bounds
    std::array<std::optional<Prior>, parameter_count> priors{};        ///< unset: uniform within the bounds
    std::array<std::optional<Prior>, derived_count> derived_priors{};  ///< unset: none
    ParameterValues values;                                            ///< fixed values, and starts of free parameters
    std::array<bool, parameter_count> free{};
    std::array<bool, parameter_count> own{};  ///< of those: with a value in each of several spectra
    std::array<Bounds, parameter_count> bounds{};
};

/// Everything a user can set. What is optional and unset is taken from the instrument or the measured file, else from
/// the defaults below, by `resolved`.
struct Configuration : FitSettings {
    std::optional<Edition> edition;
    std::optional<int> layers;
    std::optional<Base> base;  ///< unset: hypodermis under four layers, air under two
    std::optional<double> incidence_deg;
    std::optional<Specular> specular;
    std::optional<double> viewing_cone_deg;     ///< half angle about the normal; unset: the hemisphere is collected
    std::optional<NamedInstrument> instrument;  ///< read when it was stated, and never again
    std::optional<BandpassShape> bandpass_shape;
    std::optional<double> bandpass_width_nm;  ///< full width at half maximum; 0: none
    std::optional<Quantity> quantity;
    std::optional<double> noise;  ///< standard uncertainty of a value where the file states none, fraction
};

/// Used where neither the configuration nor the measured file states the geometry: the common d/8 and 8/d
/// instruments with the specular reflection included; with a viewing cone the 45/0 instruments, which exclude it.
inline constexpr Edition default_edition = Edition::revised;
inline constexpr int default_layers = 4;
inline constexpr double default_incidence_deg = 8.0;
inline constexpr Specular default_specular = Specular::included;
inline constexpr double default_incidence_deg_with_cone = 45.0;
inline constexpr Specular default_specular_with_cone = Specular::excluded;
inline constexpr BandpassShape default_bandpass_shape = BandpassShape::triangular;
inline constexpr Quantity default_quantity = Quantity::reflectance;
inline constexpr double default_noise = 0.006;  ///< fraction; the median repeat scatter of [COOKSEY17]

/// The scale of `loss` in sigmas at which a fit to normal noise keeps 95 % of the efficiency of least squares
/// [HOLLAND77].
[[nodiscard]] double default_loss_scale(Loss loss);

/// [KA04, Table 1], five free pigment parameters, 400-700 nm.
[[nodiscard]] Configuration default_configuration();

/// The free parameters, in the order of the parameter table.
[[nodiscard]] std::vector<Parameter> free_parameters(const FitSettings& settings);

/// The wavelengths that a fit uses.
[[nodiscard]] WavelengthWindow window_of(const FitSettings& settings);

}  // namespace skinfit
