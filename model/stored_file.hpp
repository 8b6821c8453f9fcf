#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <variant>

/// Files of plain data that can be made again: a format's name, a key that tells what was asked for, the data, and a
/// checksum over all of it, in the byte order of the machine.
namespace skinfit {

/// Names of formats have this many characters.
inline constexpr std::size_t format_name_length = 16;

/// Stores `parts` under `key` in the file at `path`. Throws InputError where the file cannot be written; then nothing
/// has changed, as when Cancelled is thrown because `stop` is requested meanwhile.
void write_stored_file(const std::filesystem::path& path, std::string_view format, std::string_view key,
                       std::span<const std::string_view> parts, const std::stop_token& stop = {});

/// Why a file is not what was asked for, in words.
struct Unusable {
    std::string reason;
};

/// The data of a file, mapped into memory for as long as `owner` lives; aligned to 8 bytes.
struct StoredData {
    std::string_view bytes;
    std::shared_ptr<const void> owner;
};

/// The data stored under `key` in the file at `path`, or why it cannot be used: a link or no ordinary file, another
/// user's or open to changes by others, foreign, truncated, damaged or of another key. `path` must exist.
[[nodiscard]] std::variant<StoredData, Unusable> read_stored_file(const std::filesystem::path& path,
                                                                  std::string_view format, std::string_view key);

/// So many values of so many bytes each.
struct StoredParts {
    std::uint64_t count;
    std::size_t bytes;
};

/// Whether `parts` fill `bytes` exactly.
[[nodiscard]] bool add_up(std::size_t bytes, std::initializer_list<StoredParts> parts);

/// Plain values as bytes.
template <class Value>
std::string_view bytes_of(std::span<const Value> values) {
    return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

}  // namespace skinfit
