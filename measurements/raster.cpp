#include "measurements/raster.hpp"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <dlfcn.h>
#include <fmt/format.h>
#include <gdal.h>
#include <gdal_frmts.h>

#include <array>
#include <cassert>
#include <limits>
#include <string>
#include <string_view>

#include "core/input_error.hpp"

namespace skinfit {
namespace {

/// The functions of GDAL that are used.
struct Gdal {
    decltype(&GDALOpenEx) open;
    decltype(&GDALClose) close;
    decltype(&GDALGetRasterXSize) columns;
    decltype(&GDALGetRasterYSize) rows;
    decltype(&GDALGetRasterBand) band;
    decltype(&GDALGetRasterDataType) data_type;
    decltype(&GDALDataTypeIsComplex) is_complex;
    decltype(&GDALRasterIO) transfer;
    decltype(&CPLGetLastErrorMsg) last_error;
};

void* open_library() {
    if (void* const library = ::dlopen(SKINFIT_GDAL_LIBRARY, RTLD_LAZY | RTLD_LOCAL)) return library;
    throw InputError({.where = SKINFIT_GDAL_LIBRARY,
                      .problem = "cannot be loaded",
                      .why = ::dlerror(),
                      .remedy = "install the Debian package libgdal-dev"});
}

template <typename Function>
Function symbol(void* library, const char* name) {
    void* const address = ::dlsym(library, name);
    assert(address != nullptr);
    return reinterpret_cast<Function>(address);
}

void CPL_STDCALL keep_quiet(CPLErr, CPLErrorNum, const char*) {}

Gdal load_gdal() {
    void* const library = open_library();
    symbol<decltype(&CPLSetErrorHandler)>(library, "CPLSetErrorHandler")(keep_quiet);
    const auto set_option = symbol<decltype(&CPLSetConfigOption)>(library, "CPLSetConfigOption");
    set_option("GDAL_PAM_ENABLED", "NO");                        // neither reads nor writes *.aux.xml
    set_option("GDAL_VRT_RAWRASTERBAND_ALLOWED_SOURCE", "ALL");  // GDAL 3.12 asks for it
    constexpr GIntBig cache_bytes = GIntBig{16} << 20;
    symbol<decltype(&GDALSetCacheMax64)>(library, "GDALSetCacheMax64")(cache_bytes);
    for (const char* const driver : {"GDALRegister_VRT", "GDALRegister_GTiff", "GDALRegister_PNG"}) {
        symbol<void (*)()>(library, driver)();
    }
    return {.open = symbol<decltype(&GDALOpenEx)>(library, "GDALOpenEx"),
            .close = symbol<decltype(&GDALClose)>(library, "GDALClose"),
            .columns = symbol<decltype(&GDALGetRasterXSize)>(library, "GDALGetRasterXSize"),
            .rows = symbol<decltype(&GDALGetRasterYSize)>(library, "GDALGetRasterYSize"),
            .band = symbol<decltype(&GDALGetRasterBand)>(library, "GDALGetRasterBand"),
            .data_type = symbol<decltype(&GDALGetRasterDataType)>(library, "GDALGetRasterDataType"),
            .is_complex = symbol<decltype(&GDALDataTypeIsComplex)>(library, "GDALDataTypeIsComplex"),
            .transfer = symbol<decltype(&GDALRasterIO)>(library, "GDALRasterIO"),
            .last_error = symbol<decltype(&CPLGetLastErrorMsg)>(library, "CPLGetLastErrorMsg")};
}

const Gdal& gdal() {
    static const Gdal functions = load_gdal();
    return functions;
}

std::string xml_text(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '<' || c == '>' || c == '&') {
            escaped += fmt::format("&#{};", static_cast<int>(c));
        } else {
            escaped += c;
        }
    }
    return escaped;
}

/// The description of the file that GDAL's driver for virtual rasters reads (gdal.org/drivers/raster/vrt.html).
std::string virtual_raster(const RawNumbers& numbers) {
    static constexpr std::array type_names = {"Byte",  "Int16",  "UInt16",  "Int32",  "UInt32",
                                              "Int64", "UInt64", "Float32", "Float64"};
    return fmt::format(
        R"(<VRTDataset rasterXSize="{columns}" rasterYSize="{rows}">)"
        R"(<VRTRasterBand dataType="{type}" band="1" subClass="VRTRawRasterBand">)"
        R"(<SourceFilename relativeToVRT="0">{path}</SourceFilename><ImageOffset>{offset}</ImageOffset>)"
        R"(<PixelOffset>{bytes}</PixelOffset><LineOffset>{row_bytes}</LineOffset><ByteOrder>{order}</ByteOrder>)"
        R"(</VRTRasterBand></VRTDataset>)",
        fmt::arg("columns", numbers.columns), fmt::arg("rows", numbers.rows),
        fmt::arg("type", type_names[static_cast<std::size_t>(numbers.type.kind)]),
        fmt::arg("path", xml_text(std::filesystem::absolute(numbers.path).string())),
        fmt::arg("offset", numbers.first_byte), fmt::arg("bytes", numbers.type.bytes),
        fmt::arg("row_bytes", numbers.columns * numbers.type.bytes),
        fmt::arg("order", numbers.type.most_significant_byte_first ? "MSB" : "LSB"));
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& remedy) {
    const std::string said = gdal().last_error();
    throw InputError({.where = path.string(),
                      .problem = "cannot be read",
                      .why = said.empty() ? "GDAL does not say why" : "GDAL: " + said,
                      .remedy = remedy});
}

void* open_dataset(const char* name, std::initializer_list<const char*> drivers) {
    const std::vector<const char*> names(drivers);
    return gdal().open(name, GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, names.data(), nullptr, nullptr);
}

}  // namespace

void Raster::Close::operator()(void* dataset) const {
    gdal().close(dataset);
}

Raster::Raster(const RawNumbers& numbers) : path_(numbers.path), columns_(numbers.columns), rows_(numbers.rows) {
    assert(columns_ * numbers.type.bytes <= std::numeric_limits<std::int32_t>::max());
    assert(rows_ <= std::numeric_limits<std::int32_t>::max());
    dataset_.reset(open_dataset(virtual_raster(numbers).c_str(), {"VRT", nullptr}));
    if (!dataset_) refuse(path_, "check the permission to read it");
}

Raster::Raster(const std::filesystem::path& picture) : path_(picture) {
    if (!std::filesystem::is_regular_file(picture)) {
        throw InputError({.where = picture.string(),
                          .problem = "is no file",
                          .why = "a picture is needed",
                          .remedy = "check the name"});
    }
    dataset_.reset(open_dataset(std::filesystem::absolute(picture).c_str(), {"GTiff", "PNG", nullptr}));
    if (!dataset_) refuse(path_, "give an ENVI file, a GeoTIFF or a PNG");
    columns_ = static_cast<std::size_t>(gdal().columns(dataset_.get()));
    rows_ = static_cast<std::size_t>(gdal().rows(dataset_.get()));
    void* const band = gdal().band(dataset_.get(), 1);
    if (band == nullptr || gdal().is_complex(gdal().data_type(band)) != 0) {
        throw InputError({.where = path_.string(),
                          .problem = "holds no real numbers",
                          .why = "a picture of plain numbers is needed",
                          .remedy = "give an ENVI file, a GeoTIFF or a PNG with such"});
    }
}

std::vector<double> Raster::read_rows(std::size_t first, std::size_t count) const {
    assert(first + count <= rows_);
    std::vector<double> numbers(columns_ * count);
    const auto width = static_cast<int>(columns_);
    const auto height = static_cast<int>(count);
    const CPLErr status = gdal().transfer(gdal().band(dataset_.get(), 1), GF_Read, 0, static_cast<int>(first), width,
                                          height, numbers.data(), width, height, GDT_Float64, 0, 0);
    if (status != CE_None) refuse(path_, "check that the file is complete");
    return numbers;
}

}  // namespace skinfit
