#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <string>

#include "measurements/spectrum_file.hpp"

namespace skinfit {
namespace {

/// Made-up numbers of four decimals, as instruments write them.
double made_up(std::size_t i, std::size_t j) {
    return 0.1 + static_cast<double>((i * 7919 + j * 104729) % 9000) / 10000.0;
}

/// `columns` spectra beside the wavelengths, in `lines` lines.
std::string wide_text(std::size_t columns, std::size_t lines) {
    std::string text = "wavelength_nm";
    for (std::size_t j = 0; j < columns; ++j) text += fmt::format(",s{}", j);
    for (std::size_t i = 0; i < lines; ++i) {
        text += fmt::format("\n{:.1f}", 300 + 0.5 * static_cast<double>(i));
        for (std::size_t j = 0; j < columns; ++j) text += fmt::format(",{:.4f}", made_up(i, j));
    }
    return text + "\n";
}

/// `lines` spectra of `values` wavelengths.
std::string rows_text(std::size_t values, std::size_t lines) {
    std::string text = "id";
    for (std::size_t j = 0; j < values; ++j) text += fmt::format(",{}", 300 + j);
    for (std::size_t i = 0; i < lines; ++i) {
        text += fmt::format("\n{}", i);
        for (std::size_t j = 0; j < values; ++j) text += fmt::format(",{:.4f}", made_up(i, j));
    }
    return text + "\n";
}

void read(benchmark::State& state, const std::string& text) {
    for (auto _ : state) benchmark::DoNotOptimize(parse_spectra(text, "made_up"));
    state.SetBytesProcessed(static_cast<std::int64_t>(text.size()) * static_cast<std::int64_t>(state.iterations()));
}

/// 100 MB each: one core, text in memory.
void read_wide_text(benchmark::State& state) {
    read(state, wide_text(10000, 1430));
}
BENCHMARK(read_wide_text)->Unit(benchmark::kMillisecond);

void read_narrow_text(benchmark::State& state) {
    read(state, wide_text(20, 19000));
}  // 3 MB, a usual wide file
BENCHMARK(read_narrow_text)->Unit(benchmark::kMillisecond);

void read_rows_text(benchmark::State& state) {
    read(state, rows_text(39, 357000));
}
BENCHMARK(read_rows_text)->Unit(benchmark::kMillisecond);

void read_jcamp_text(benchmark::State& state) {
    std::string text =
        "##TITLE= a\n##XUNITS= NANOMETERS\n##YUNITS= REFLECTANCE\n##FIRSTX= 300\n##LASTX= 1300\n"
        "##NPOINTS= 100001\n##XYPOINTS= (XY..XY)\n";
    for (std::size_t i = 0; i <= 100000; ++i)
        text += fmt::format("{:.2f} {:.4f}\n", 300 + 0.01 * static_cast<double>(i), made_up(i, 1));
    read(state, text + "##END=\n");
}
BENCHMARK(read_jcamp_text)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace skinfit
