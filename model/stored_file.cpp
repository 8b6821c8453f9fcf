#include "model/stored_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "core/file.hpp"

// Layout: FileHeader, key, data, checksum of all before it.
namespace skinfit {
namespace {

struct FileHeader {
    std::array<char, format_name_length> format;
    std::uint64_t key_bytes;
};

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

/// Why a file is not read, by what it is; empty where it is.
std::string objection_to(int descriptor, struct stat& status) {
    if (descriptor < 0 && errno == ELOOP) return "a link, which is not followed";
    if (descriptor < 0 || ::fstat(descriptor, &status) != 0) return "unreadable";
    if (!S_ISREG(status.st_mode)) return "no ordinary file";
    if (status.st_uid != ::geteuid()) return "of another user";
    if ((status.st_mode & (S_IWGRP | S_IWOTH)) != 0) return "open to changes by other users";
    return status.st_size > 0 ? "" : "empty";
}

std::variant<MappedFile, Unusable> map_file(const std::filesystem::path& path) {
    // Without O_NONBLOCK, opening a pipe waits for whoever writes into it.
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    struct stat status {};
    std::string objection = objection_to(descriptor, status);
    void* address = MAP_FAILED;
    const auto size = static_cast<std::size_t>(status.st_size);
    if (objection.empty()) {
        address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE | MAP_POPULATE, descriptor, 0);
        if (address == MAP_FAILED) objection = "unreadable";
    }
    if (descriptor >= 0) ::close(descriptor);
    if (!objection.empty()) return Unusable{std::move(objection)};
    const auto unmap = [address, size](const char* /*data*/) { ::munmap(address, size); };
    return MappedFile{{static_cast<const char*>(address), unmap}, size};
}

}  // namespace

bool add_up(std::size_t bytes, std::initializer_list<StoredParts> parts) {
    for (const StoredParts& part : parts) {
        if (part.count > bytes / part.bytes) return false;
        bytes -= part.count * part.bytes;
    }
    return bytes == 0;
}

void write_stored_file(const std::filesystem::path& path, std::string_view format, std::string_view key,
                       std::span<const std::string_view> parts, const std::stop_token& stop) {
    assert(format.size() == format_name_length);
    const std::string key_field = padded(key);
    FileHeader header{.format = {}, .key_bytes = key_field.size()};
    std::memcpy(header.format.data(), format.data(), format_name_length);
    std::vector<std::string_view> all = {bytes_of(std::span<const FileHeader>(&header, 1)), key_field};
    all.insert(all.end(), parts.begin(), parts.end());
    const std::uint64_t sum = checksum(all);
    all.push_back(bytes_of(std::span<const std::uint64_t>(&sum, 1)));
    write_scratch_file_atomically(path, all, stop);
}

std::variant<StoredData, Unusable> read_stored_file(const std::filesystem::path& path, std::string_view format,
                                                    std::string_view key) {
    const std::variant<MappedFile, Unusable> mapped = map_file(path);
    if (const auto* const unusable = std::get_if<Unusable>(&mapped)) return *unusable;
    const MappedFile& file = std::get<MappedFile>(mapped);
    const std::string_view bytes(file.data.get(), file.size);
    FileHeader header{};
    if (bytes.size() < sizeof header + sizeof(std::uint64_t)) return Unusable{"truncated"};
    std::memcpy(&header, bytes.data(), sizeof header);
    if (std::string_view(header.format.data(), format_name_length) != format) {
        return Unusable{"of another kind or version of this program"};
    }
    std::uint64_t stored_sum = 0;
    const std::string_view body = bytes.substr(0, bytes.size() - sizeof stored_sum);
    std::memcpy(&stored_sum, bytes.data() + body.size(), sizeof stored_sum);
    if (checksum({&body, 1}) != stored_sum) return Unusable{"truncated or damaged: its checksum does not match"};
    // From here on the file is what was written.
    const std::string key_field = padded(key);
    if (body.substr(sizeof header, header.key_bytes) != key_field) return Unusable{"made for other settings"};
    return StoredData{.bytes = body.substr(sizeof header + key_field.size()), .owner = file.data};
}

}  // namespace skinfit
