#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "measurements/envi_reader.hpp"
#include "study/map_tile.hpp"
#include "tests/fit/synthetic.hpp"
#include "tests/study/synthetic_cube.hpp"
#include "tests/support/statistics.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit::test {
namespace {

class MapTruth : public TemporaryFolder {};

/// The probability below a standard normal number.
double normal_share(double z) {
    return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

/// For each parameter, that its errors in sigmas are standard normal in the pixels that are fitted: the p-values of
/// their squares' sum and of their distribution.
struct PValues {
    double of_squares;
    double of_distribution;
};

std::vector<PValues> p_values(const std::vector<PixelFit>& fits, const std::vector<std::vector<double>>& truth) {
    std::vector<PValues> found;
    for (std::size_t i = 0; i < truth.front().size(); ++i) {
        double squares = 0.0;
        std::vector<double> shares;
        for (std::size_t pixel = 0; pixel < fits.size(); ++pixel) {
            if (fits[pixel].status != FitStatus::fitted) continue;
            const double z = (fits[pixel].values[i] - truth[pixel][i]) / fits[pixel].sigmas[i];
            squares += z * z;
            shares.push_back(normal_share(z));
        }
        found.push_back({.of_squares = chi_square_p_value(squares, static_cast<double>(shares.size())),
                         .of_distribution = uniformity_p_value(shares)});
    }
    return found;
}

TEST_F(MapTruth, ErrorsInSigmasAreStandardNormal) {
    // Noise so low that the model is straight over the errors it makes.
    const SyntheticCube made = synthetic_cube(40, 40, 0.0003, 3);
    write_synthetic_cube(made, in_folder("cube.hdr"));
    const SpectralCube cube(in_folder("cube.hdr"));
    const PixelFitter fitter(made.configuration, common_spectrum(cube), no_cache());
    const std::vector<double> fractions = cube.read_lines(0, cube.lines());
    std::vector<PixelFit> fits;
    std::size_t fitted = 0;
    for (std::size_t pixel = 0; pixel < made.truth.size(); ++pixel) {
        fits.push_back(fitter.fit(std::span(fractions).subspan(pixel * 31, 31)));
        fitted += fits.back().status == FitStatus::fitted ? 1 : 0;
    }
    // One in a thousand is a misfit by chance, and a few end in a higher minimum, which shows as a misfit too.
    EXPECT_GE(fitted, made.truth.size() * 99 / 100);
    for (const PValues& each : p_values(fits, made.truth)) {
        EXPECT_GT(each.of_squares, passing_p_value);
        EXPECT_GT(each.of_distribution, passing_p_value);
        std::printf("p of squares %.3g, of the distribution %.3g\n", each.of_squares, each.of_distribution);
    }

    // Truths that are off by half a sigma are told from the right ones.
    std::vector<std::vector<double>> perturbed = made.truth;
    for (std::size_t pixel = 0; pixel < fits.size(); ++pixel) {
        for (std::size_t i = 0; i < perturbed[pixel].size(); ++i) perturbed[pixel][i] += 0.5 * fits[pixel].sigmas[i];
    }
    for (const PValues& each : p_values(fits, perturbed)) {
        EXPECT_LT(each.of_squares, passing_p_value);
        EXPECT_LT(each.of_distribution, passing_p_value);
    }
}

}  // namespace
}  // namespace skinfit::test
