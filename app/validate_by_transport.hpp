#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/session.hpp"
#include "app/shared_options.hpp"

namespace skinfit {

/// What `validate inverse --simulate-by transport` takes.
struct TransportValidation {
    SharedOptions shared;
    std::filesystem::path output;
    std::string cohort;
    std::optional<std::uint64_t> spectra;
    std::optional<double> port_diameter_mm;
    std::string seed;
    std::string engine;
    std::vector<std::string> free;
    std::vector<std::string> fix;
};

/// Makes spectra by the layered transport, fits them, and writes transport.csv and summary.json. Returns the exit code.
[[nodiscard]] int validate_by_transport(const TransportValidation& command, Session& session);

}  // namespace skinfit
