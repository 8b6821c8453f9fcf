#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "model/emulator_sums.hpp"
#include "model/parameters.hpp"
#include "model/path_ensemble.hpp"
#include "model/skin.hpp"

namespace skinfit {

/// The values one parameter may take.
struct ParameterRange {
    Parameter parameter;
    double lower;
    double upper;
};

/// What an emulator is to stand for: the light that leaves through one side of a sample.
struct EmulatorDomain {
    Sample sample;  ///< everything that steers rays, and the values of the parameters that have no range
    double incidence_rad = 0.0;
    Side side = Side::top;
    std::vector<double> wavelengths_nm;
    std::vector<ParameterRange> ranges;  ///< of parameters that absorb without steering
};

/// Whether an emulator can stand for a range of `parameter`: of all that steers, for that of the fibril radius alone.
[[nodiscard]] bool can_be_emulated(Parameter parameter);

/// Throws InputError where `parameter` steers: no emulator stands for a range of it, but for that of the fibril radius,
/// of which a `RadiusEmulator` does.
void refuse_to_emulate(Parameter parameter);

/// The share of the light that leaves, and how it answers to absorption.
struct EmulatedShare {
    double share = 0.0;
    PerLayer<double> by_optical_depth{};  ///< zero for a layer whose depth does not vary over the domain
};

/// The angular solver for one geometry, as a polynomial per wavelength: what absorbs is free within the domain, what
/// steers is fixed. The share is a Chebyshev series in log(depth + twice the least depth) of each layer, made from the
/// solver's own shares (`AngularComposition`); terms too small to matter are left out. docs/model.md, section
/// "Emulator", has accuracy and cost. Copies share the series, which never change; calls may come from any thread.
class Emulator {
public:
    /// Takes about a hundredth of a second per wavelength. Throws InputError outside the tables, and for a range of a
    /// parameter that steers, and Cancelled soon after `stop` is requested.
    [[nodiscard]] static Emulator build(const EmulatorDomain& domain, const std::stop_token& stop = {});

    /// The share of the light that the surface reflects.
    [[nodiscard]] double surface_share() const { return surface_share_; }
    [[nodiscard]] std::size_t wavelength_count() const { return wavelength_count_; }

    /// The largest deviation from the angular solver at its default resolution on 2048 specimens of the domain that had
    /// no part in the making, and half as much again, plus the error that the solver states there: a share of the
    /// incident light; an observation, no proven bound.
    [[nodiscard]] double certified_error(std::size_t wavelength) const;
    /// The largest over all wavelengths.
    [[nodiscard]] double certified_error() const;

    /// The share at each wavelength for the layers' optical depths there. Throws InputError outside the domain.
    [[nodiscard]] std::vector<EmulatedShare> respond(std::span<const PerLayer<double>> optical_depths) const;

    /// Neighbouring wavelengths, computed side by side; what lies behind the last wavelength repeats it.
    struct Group {
        EmulatorCoordinate coordinate;
        PerLayer<Lanes<double>> lowest;  ///< optical depth of the domain
        PerLayer<Lanes<double>> highest;
        Lanes<double> certified_error;
        PerLayer<int> most;  ///< as `EmulatorSeries`, and the sizes of its parts
        std::uint64_t count_count;
        std::uint64_t coefficient_count;
    };
    /// An emulator as plain data, group after group. `counts` and `coefficients` live as long as `owner`.
    struct Parts {
        double surface_share;
        std::size_t wavelength_count;
        std::vector<Group> groups;
        std::span<const float> coefficients;
        std::span<const std::uint8_t> counts;
        std::shared_ptr<const void> owner;
    };
    /// From stored parts, and back to them.
    explicit Emulator(Parts parts);
    [[nodiscard]] Parts parts() const;

private:
    [[nodiscard]] PerLayer<Lanes<double>> depths_of(std::size_t group,
                                                    std::span<const PerLayer<double>> optical_depths) const;

    double surface_share_;
    std::size_t wavelength_count_;
    std::vector<Group> groups_;
    std::vector<EmulatorSeries> series_;
    std::span<const float> coefficients_;
    std::span<const std::uint8_t> counts_;
    std::shared_ptr<const void> owner_;
};

}  // namespace skinfit
