#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <thread>

#include "fit/fit.hpp"
#include "fit/models.hpp"
#include "tests/fit/synthetic.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit::test {
namespace {

using Clock = std::chrono::steady_clock;

/// A fit whose model takes half a minute of processor time to make, or more.
struct Slow {
    const char* name;
    Engine engine;
    std::uint64_t rays;
    double step_nm;
};
const std::vector<Slow> slow_ones = {{"paths", Engine::paths, 3'000'000, 10},
                                     {"emulator", Engine::emulator, 1000, 0.05}};

class Cancelling : public TemporaryFolder {
protected:
    void SetUp() override {
        TemporaryFolder::SetUp();
        cache_ = {.folder = in_folder(""), .warn = [](const std::string&) {}, .inform = [](const std::string&) {}};
    }

    static Spectrum ramp(double step_nm) {
        Spectrum spectrum;
        spectrum.name = spectrum.source = "ramp";
        spectrum.wavelength_nm = grid_nm(400, 700, step_nm);
        for (const double nm : spectrum.wavelength_nm) spectrum.value.push_back(0.2 + 1e-3 * (nm - 400));
        return spectrum;
    }

    static Configuration configuration(const Slow& slow) {
        Configuration configuration = default_configuration();
        configuration.engine = slow.engine;
        configuration.rays = slow.rays;
        return configuration;
    }

    DiskCache cache_;
};

#ifdef __SANITIZE_ADDRESS__
constexpr double slowest_answer_s = 20.0;  // all takes ten times as long
#else
constexpr double slowest_answer_s = 2.0;
#endif

TEST_F(Cancelling, EndsTheMakingOfAModelAndKeepsNoPartOfIt) {
    for (const Slow& slow : slow_ones) {
        std::stop_source stop;
        std::optional<Clock::time_point> asked;
        const std::jthread canceller([&] {
            // In the middle of the making.
            std::this_thread::sleep_for(std::chrono::milliseconds(400));
            asked = Clock::now();
            stop.request_stop();
        });
        std::string stage;
        const FitWatch watch{.stop = stop.get_token(),
                             .progress = [&](const FitProgress& now) { stage = std::string(now.stage); }};
        EXPECT_THROW((void)fit_spectrum(configuration(slow), ramp(slow.step_nm), {.cache = cache_, .watch = watch}),
                     Cancelled)
            << slow.name;
        ASSERT_TRUE(asked) << slow.name << " had ended before";
        const std::chrono::duration<double> late = Clock::now() - *asked;
        EXPECT_EQ(stage, "preparing the model") << slow.name;
        // 0.2 s are meant; a busy machine may add to that, and without cancelling there is much more to go.
        EXPECT_LT(late.count(), slowest_answer_s) << slow.name;
        RecordProperty(std::string(slow.name) + "_late_ms", static_cast<int>(1000.0 * late.count()));
        EXPECT_EQ(entries(), 0) << slow.name;
    }
}

TEST_F(Cancelling, BeforeTheStartMakesNothing) {
    std::stop_source stop;
    stop.request_stop();
    for (const Slow& slow : slow_ones) {
        EXPECT_THROW(
            (void)fit_spectrum(configuration(slow), ramp(20), {.cache = cache_, .watch = {.stop = stop.get_token()}}),
            Cancelled)
            << slow.name;
    }
    EXPECT_EQ(entries(), 0);
}

TEST_F(Cancelling, LeavesACacheFromWhichTheNextFitStartsAsFromAnEmptyOne) {
    for (const Slow& slow : slow_ones) {
        Configuration quick = quick_configuration();
        quick.engine = slow.engine;
        const Spectrum spectrum = ramp(20);
        std::stop_source stop;
        DiskCache cancelled = cache_;
        cancelled.inform = [&](const std::string&) { stop.request_stop(); };
        EXPECT_THROW((void)fit_spectrum(quick, spectrum, {.cache = cancelled, .watch = {.stop = stop.get_token()}}),
                     Cancelled);
        const FitResult kept = fit_spectrum(quick, spectrum, {.cache = cache_});
        const FitResult made = fit_spectrum(quick, spectrum, {.cache = no_cache()});
        EXPECT_EQ(kept.answer.minimum.values, made.answer.minimum.values) << slow.name;
        EXPECT_EQ(kept.spectra.front().modelled, made.spectra.front().modelled) << slow.name;
    }
}

}  // namespace
}  // namespace skinfit::test
