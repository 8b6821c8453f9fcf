#include "model/ensemble_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <array>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>

#include "core/file.hpp"

// Layout, in the byte order of the machine: Header, key, segments, lengths, checksum of all before it.
namespace skinfit {
namespace {

struct Header {
    std::array<char, 16> magic;
    std::uint64_t key_bytes;
    std::uint64_t rays;
    std::uint64_t wavelengths;
    std::uint64_t floats;
    double surface_share;
};
static_assert(std::is_trivially_copyable_v<Header> && std::is_trivially_copyable_v<PathEnsemble::Segments>);

constexpr std::array<char, 16> magic = {'s', 'k', 'i', 'n', 'f', 'i', 't', ' ',
                                        'p', 'a', 't', 'h', 's', ' ', '1', '\n'};

template <class Value>
std::string_view bytes_of(std::span<const Value> values) {
    return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

std::uint64_t checksum(std::span<const std::string_view> parts) {
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
    XXH3_64bits_reset(state.get());
    for (const std::string_view part : parts) XXH3_64bits_update(state.get(), part.data(), part.size());
    return XXH3_64bits_digest(state.get());
}

/// The padding that keeps what follows the key aligned.
std::string padded(std::string_view key) {
    std::string result(key);
    result.append((8 - key.size() % 8) % 8, ' ');
    return result;
}

/// A file mapped for reading; unmapped with the last copy.
struct MappedFile {
    std::shared_ptr<const char> data;
    std::size_t size;
};

std::optional<MappedFile> map_file(const std::filesystem::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return std::nullopt;
    struct stat status {};
    std::optional<MappedFile> mapped;
    if (::fstat(descriptor, &status) == 0 && status.st_size > 0) {
        const auto size = static_cast<std::size_t>(status.st_size);
        void* const address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE | MAP_POPULATE, descriptor, 0);
        if (address != MAP_FAILED) {
            const auto unmap = [size](const char* data) { ::munmap(const_cast<char*>(data), size); };
            mapped = MappedFile{{static_cast<const char*>(address), unmap}, size};
        }
    }
    ::close(descriptor);
    return mapped;
}

}  // namespace

void write_ensemble_file(const std::filesystem::path& path, std::string_view key, const PathEnsemble& ensemble) {
    const PathEnsemble::Recording recording = ensemble.recording();
    const std::string key_field = padded(key);
    const Header header{.magic = magic,
                        .key_bytes = key_field.size(),
                        .rays = ensemble.rays(),
                        .wavelengths = recording.segments.size(),
                        .floats = recording.lengths.size(),
                        .surface_share = ensemble.surface_share()};
    std::array<std::string_view, 5> parts = {
        bytes_of(std::span(&header, 1)), key_field, bytes_of(recording.segments), bytes_of(recording.lengths), {}};
    const std::uint64_t sum = checksum(std::span(parts).first(4));
    parts[4] = bytes_of(std::span(&sum, 1));
    write_scratch_file_atomically(path, parts);
}

std::variant<PathEnsemble, Unusable> read_ensemble_file(const std::filesystem::path& path, std::string_view key) {
    const std::optional<MappedFile> file = map_file(path);
    if (!file) return Unusable{"empty or unreadable"};
    const std::string_view bytes(file->data.get(), file->size);
    Header header{};
    if (bytes.size() < sizeof header + sizeof(std::uint64_t)) return Unusable{"truncated"};
    std::memcpy(&header, bytes.data(), sizeof header);
    if (header.magic != magic) return Unusable{"not an ensemble of this program"};
    std::uint64_t stored_sum = 0;
    const std::string_view body = bytes.substr(0, bytes.size() - sizeof stored_sum);
    std::memcpy(&stored_sum, bytes.data() + body.size(), sizeof stored_sum);
    if (checksum({&body, 1}) != stored_sum) return Unusable{"truncated or damaged: its checksum does not match"};
    // From here on the file is what was written.
    const std::string key_field = padded(key);
    if (body.substr(sizeof header, header.key_bytes) != key_field) return Unusable{"recorded for other settings"};
    const char* const first_segment = body.data() + sizeof header + key_field.size();
    std::vector<PathEnsemble::Segments> segments(header.wavelengths);
    std::memcpy(segments.data(), first_segment, segments.size() * sizeof segments[0]);
    const auto* const lengths = reinterpret_cast<const float*>(first_segment + segments.size() * sizeof segments[0]);
    return PathEnsemble({.surface_share = header.surface_share,
                         .rays = header.rays,
                         .segments = std::move(segments),
                         .lengths = {lengths, header.floats},
                         .owner = file->data});
}

}  // namespace skinfit
