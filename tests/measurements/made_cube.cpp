#include "tests/measurements/made_cube.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace skinfit::test {
namespace {

template <typename Type>
std::string bytes_of(double number) {
    const auto typed = static_cast<Type>(number);
    std::string bytes(sizeof typed, '\0');
    std::memcpy(bytes.data(), &typed, sizeof typed);
    return bytes;  // least significant first, as on every machine this project runs on
}

std::string bytes_of(double number, int data_type) {
    switch (data_type) {
        case 1:
            return bytes_of<std::uint8_t>(number);
        case 2:
            return bytes_of<std::int16_t>(number);
        case 3:
            return bytes_of<std::int32_t>(number);
        case 4:
            return bytes_of<float>(number);
        case 5:
            return bytes_of<double>(number);
        case 12:
            return bytes_of<std::uint16_t>(number);
        case 13:
            return bytes_of<std::uint32_t>(number);
        case 14:
            return bytes_of<std::int64_t>(number);
        case 15:
            return bytes_of<std::uint64_t>(number);
        default:
            throw std::logic_error("no such type");
    }
}

}  // namespace

std::string header_text(const MadeCube& cube) {
    return fmt::format(
        "ENVI\ndescription = {{\n  made up = by a test}}\nsamples = {}\nlines   = {}\nbands   = {}\n"
        "header offset = {}\nfile type = ENVI Standard\ndata type = {}\ninterleave = {}\nbyte order = {}\n{}",
        cube.samples, cube.lines, cube.bands, cube.header_offset, cube.data_type, cube.interleave,
        cube.most_significant_byte_first ? 1 : 0, cube.more);
}

std::string stored(const std::vector<double>& numbers, int data_type, bool most_significant_byte_first) {
    std::string bytes;
    for (const double number : numbers) {
        std::string one = bytes_of(number, data_type);
        if (most_significant_byte_first) std::ranges::reverse(one);
        bytes += one;
    }
    return bytes;
}

std::vector<double> numbers_in_order(const MadeCube& cube) {
    std::vector<double> numbers;
    if (cube.interleave == "bsq") {
        for (std::size_t band = 0; band < cube.bands; ++band) {
            for (std::size_t line = 0; line < cube.lines; ++line) {
                for (std::size_t i = 0; i < cube.samples; ++i) numbers.push_back(cube.number(line, i, band));
            }
        }
    } else if (cube.interleave == "bil") {
        for (std::size_t line = 0; line < cube.lines; ++line) {
            for (std::size_t band = 0; band < cube.bands; ++band) {
                for (std::size_t i = 0; i < cube.samples; ++i) numbers.push_back(cube.number(line, i, band));
            }
        }
    } else {
        for (std::size_t line = 0; line < cube.lines; ++line) {
            for (std::size_t i = 0; i < cube.samples; ++i) {
                for (std::size_t band = 0; band < cube.bands; ++band) numbers.push_back(cube.number(line, i, band));
            }
        }
    }
    return numbers;
}

void write_cube(const std::filesystem::path& header, const MadeCube& cube) {
    write_text(header, header_text(cube));
    write_text(std::filesystem::path(header).replace_extension("dat"),
               std::string(cube.header_offset, '#') +
                   stored(numbers_in_order(cube), cube.data_type, cube.most_significant_byte_first));
}

void write_text(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

}  // namespace skinfit::test
