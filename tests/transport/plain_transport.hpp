#pragma once

#include <cstdint>
#include <vector>

#include "transport/photon_paths.hpp"

/// Photons followed one by one through a stack that absorbs, written without any part of the program's transport: in
/// space, with one kind of random number, absorbed where chance says so.
namespace skinfit::test {

/// How one photon ended. Coordinates are in cm, from the point where it met the surface; x lies in the plane of
/// incidence.
struct PlainPhoton {
    enum class Fate { first_reflection, top, bottom, absorbed };
    Fate fate;
    double x;
    double y;
    double cosine;  ///< of the direction in which it left, to the normal
};

/// As many photons as asked for, of a beam at `incidence_rad`, through layers that absorb so much per cm.
[[nodiscard]] std::vector<PlainPhoton> plain_transport(const TurbidStack& stack, const PerTurbidLayer& absorption,
                                                       double incidence_rad, std::uint64_t photons, unsigned seed);

/// How many of them ended so.
[[nodiscard]] std::uint64_t count_of(const std::vector<PlainPhoton>& photons, PlainPhoton::Fate fate);

}  // namespace skinfit::test
