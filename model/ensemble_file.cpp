#include "model/ensemble_file.hpp"

#include <array>
#include <cstring>
#include <span>
#include <type_traits>

// Layout of the data: EnsembleHeader, segments, lengths.
namespace skinfit {
namespace {

struct EnsembleHeader {
    std::uint64_t rays;
    std::uint64_t wavelengths;
    std::uint64_t floats;
    double surface_share;
};
static_assert(std::is_trivially_copyable_v<EnsembleHeader> && std::is_trivially_copyable_v<PathEnsemble::Segments>);

constexpr std::string_view recording_format = "skinfit paths 2\n";

}  // namespace

void write_ensemble_file(const std::filesystem::path& path, std::string_view key, const PathEnsemble& ensemble,
                         const std::stop_token& stop) {
    const PathEnsemble::Recording recording = ensemble.recording();
    const EnsembleHeader header{.rays = ensemble.rays(),
                                .wavelengths = recording.segments.size(),
                                .floats = recording.lengths.size(),
                                .surface_share = ensemble.surface_share()};
    const std::array parts = {bytes_of(std::span<const EnsembleHeader>(&header, 1)), bytes_of(recording.segments),
                              bytes_of(recording.lengths)};
    write_stored_file(path, recording_format, key, parts, stop);
}

std::variant<PathEnsemble, Unusable> read_ensemble_file(const std::filesystem::path& path, std::string_view key) {
    const auto stored = read_stored_file(path, recording_format, key);
    if (const auto* const unusable = std::get_if<Unusable>(&stored)) return *unusable;
    const auto& [bytes, owner] = std::get<StoredData>(stored);
    EnsembleHeader header{};
    if (bytes.size() < sizeof header) return Unusable{"too short"};
    std::memcpy(&header, bytes.data(), sizeof header);
    if (!add_up(bytes.size() - sizeof header,
                {{header.wavelengths, sizeof(PathEnsemble::Segments)}, {header.floats, sizeof(float)}})) {
        return Unusable{"not as long as it says"};
    }
    const char* const first_segment = bytes.data() + sizeof header;
    std::vector<PathEnsemble::Segments> segments(header.wavelengths);
    std::memcpy(segments.data(), first_segment, segments.size() * sizeof segments[0]);
    const auto* const lengths = reinterpret_cast<const float*>(first_segment + segments.size() * sizeof segments[0]);
    return PathEnsemble({.surface_share = header.surface_share,
                         .rays = header.rays,
                         .segments = std::move(segments),
                         .lengths = {lengths, header.floats},
                         .owner = owner});
}

}  // namespace skinfit
