#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "measurements/number_type.hpp"

namespace skinfit {

/// Numbers in rows of equal length, one after another in a file.
struct RawNumbers {
    std::filesystem::path path;
    std::uint64_t first_byte;  ///< where the first number is
    NumberType type;
    std::size_t columns;  ///< at most 2^31 - 1
    std::size_t rows;     ///< at most 2^31 - 1
};

/// Rows of numbers in a file, read through GDAL.
///
/// GDAL is loaded when the first raster is opened, not with the program: it brings fifty libraries, which would make
/// every command start 60 ms later. Of its drivers only those for plain numbers, GeoTIFF and PNG are registered, none
/// of which reaches the network; it writes nothing, and caches at most 16 MB. One thread at a time may use a raster.
class Raster {
public:
    /// The file must hold all the numbers. Throws InputError when it cannot be opened.
    explicit Raster(const RawNumbers& numbers);

    /// The first band of a GeoTIFF or PNG. Throws InputError for anything else and for complex numbers.
    explicit Raster(const std::filesystem::path& picture);

    /// Pixels of a line, and lines.
    [[nodiscard]] std::size_t columns() const { return columns_; }
    [[nodiscard]] std::size_t rows() const { return rows_; }

    /// The numbers of `count` rows from row `first` on, row after row. Throws InputError when the file cannot be read.
    [[nodiscard]] std::vector<double> read_rows(std::size_t first, std::size_t count) const;

private:
    struct Close {
        void operator()(void* dataset) const;
    };

    std::filesystem::path path_;
    std::unique_ptr<void, Close> dataset_;
    std::size_t columns_ = 0;
    std::size_t rows_ = 0;
};

}  // namespace skinfit
