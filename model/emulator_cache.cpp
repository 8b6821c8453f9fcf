#include "model/emulator_cache.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "model/sample_key.hpp"

// Layout of the data: EmulatorHeader, groups, coefficients, counts.
namespace skinfit {
namespace {

struct EmulatorHeader {
    double surface_share;
    std::uint64_t wavelengths;
    std::uint64_t groups;
    std::uint64_t coefficients;
    std::uint64_t counts;
};
static_assert(std::is_trivially_copyable_v<EmulatorHeader> && std::is_trivially_copyable_v<Emulator::Group>);

constexpr std::string_view emulator_format = "skinfit emul. 1\n";

}  // namespace

std::string emulator_key(const EmulatorDomain& domain) {
    const auto is_fixed = [&](const ParameterInfo& row) {
        return std::ranges::find(domain.ranges, row.parameter, &ParameterRange::parameter) == domain.ranges.end();
    };
    std::string key = fmt::format("program {:x}; side {}; wavelengths {:a}; {};", program_fingerprint(),
                                  static_cast<int>(domain.side), fmt::join(domain.wavelengths_nm, " "),
                                  sample_key(domain.sample, domain.incidence_rad, is_fixed));
    for (const ParameterRange& range : domain.ranges) {
        key += fmt::format(" {} {:a} to {:a}", info(range.parameter).name, range.lower, range.upper);
    }
    return key;
}

void write_emulator_file(const std::filesystem::path& path, std::string_view key, const Emulator& emulator,
                         const std::stop_token& stop) {
    const Emulator::Parts parts = emulator.parts();
    const EmulatorHeader header{.surface_share = parts.surface_share,
                                .wavelengths = parts.wavelength_count,
                                .groups = parts.groups.size(),
                                .coefficients = parts.coefficients.size(),
                                .counts = parts.counts.size()};
    const std::array bytes = {bytes_of(std::span<const EmulatorHeader>(&header, 1)),
                              bytes_of(std::span<const Emulator::Group>(parts.groups)), bytes_of(parts.coefficients),
                              bytes_of(parts.counts)};
    write_stored_file(path, emulator_format, key, bytes, stop);
}

std::variant<Emulator, Unusable> read_emulator_file(const std::filesystem::path& path, std::string_view key) {
    const auto stored = read_stored_file(path, emulator_format, key);
    if (const auto* const unusable = std::get_if<Unusable>(&stored)) return *unusable;
    const auto& [bytes, owner] = std::get<StoredData>(stored);
    EmulatorHeader header{};
    if (bytes.size() < sizeof header) return Unusable{"too short"};
    std::memcpy(&header, bytes.data(), sizeof header);
    if (!add_up(bytes.size() - sizeof header, {{header.groups, sizeof(Emulator::Group)},
                                               {header.coefficients, sizeof(float)},
                                               {header.counts, sizeof(std::uint8_t)}})) {
        return Unusable{"not as long as it says"};
    }
    std::vector<Emulator::Group> groups(header.groups);
    const char* const first_group = bytes.data() + sizeof header;
    std::memcpy(groups.data(), first_group, groups.size() * sizeof groups[0]);
    const char* const first_coefficient = first_group + groups.size() * sizeof groups[0];
    const char* const first_count = first_coefficient + header.coefficients * sizeof(float);
    return Emulator({.surface_share = header.surface_share,
                     .wavelength_count = header.wavelengths,
                     .groups = std::move(groups),
                     .coefficients = {reinterpret_cast<const float*>(first_coefficient), header.coefficients},
                     .counts = {reinterpret_cast<const std::uint8_t*>(first_count), header.counts},
                     .owner = owner});
}

Emulator cached_emulator(const EmulatorDomain& domain, const DiskCache& cache, const std::stop_token& stop) {
    const auto build = [&] {
        cache.inform(fmt::format("building the emulator of {} wavelengths", domain.wavelengths_nm.size()));
        return Emulator::build(domain, stop);
    };
    const auto write = [&](const std::filesystem::path& path, std::string_view key, const Emulator& emulator) {
        write_emulator_file(path, key, emulator, stop);
    };
    if (!cache.folder) return build();
    return cached<Emulator>(cache, emulator_key(domain), "emulator", build, read_emulator_file, write);
}

}  // namespace skinfit
