#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "app/commands.hpp"
#include "app/option_limits.hpp"
#include "app/progress_line.hpp"
#include "app/shared_options.hpp"
#include "core/erase_repeated.hpp"
#include "core/input_error.hpp"
#include "core/memory.hpp"
#include "fit/configuration_json.hpp"
#include "fit/goniophotometer_output.hpp"
#include "fit/problem.hpp"
#include "fit/wavelength_sets.hpp"
#include "measurements/response.hpp"

namespace skinfit {
namespace {

struct GonioCommand {
    SharedOptions shared;
    std::string wavelengths;
    std::string rays;
    std::string seed;
    std::string illuminant = std::string(name_of(BandIlluminant::equal_energy));
    std::string response;
    std::string part = std::string(name_of(Light::reflected));
    double polar_step_deg = 5.0;
    double azimuth_step_deg = 10.0;
    bool reciprocity = false;
};

constexpr std::string_view green_light = "550";
constexpr std::string_view visible_band = "400:700:20";
constexpr std::uint64_t enough_rays = 1'000'000;  // for a per cent in most rings

constexpr std::array illuminants = {BandIlluminant::equal_energy, BandIlluminant::d65, BandIlluminant::d65_v};
constexpr std::array parts = {Light::reflected, Light::surface, Light::subsurface};

template <class Choices>
std::vector<std::string_view> names_of(const Choices& choices) {
    std::vector<std::string_view> names;
    for (const auto choice : choices) names.push_back(name_of(choice));
    return names;
}

template <class Choices>
auto choice(const std::string& name, const Choices& choices) {
    return *std::ranges::find_if(choices, [&](auto each) { return name_of(each) == name; });
}

/// Green light unless a band is asked for, then the visible.
Configuration gonio_defaults(const GonioCommand& command) {
    Configuration configuration = default_configuration();
    const bool band = !command.response.empty() || command.illuminant != name_of(BandIlluminant::equal_energy);
    configuration.wavelengths = band ? visible_band : green_light;
    configuration.rays = enough_rays;
    return configuration;
}

Configuration gonio_configuration(const GonioCommand& command) {
    Configuration configuration = configuration_from(command.shared, gonio_defaults(command));
    const auto take = [&](const char* key, const std::string& text) {
        if (!text.empty()) configuration = configured_by_word(configuration, key, text, std::string("--") + key);
    };
    take("wavelengths", command.wavelengths);
    take("rays", command.rays);
    take("seed", command.seed);
    return configuration;
}

/// The whole number of degrees next to `step_deg` that divides `whole_deg`.
int nearest_divisor(double whole_deg, double step_deg) {
    const int whole = static_cast<int>(whole_deg);
    int nearest = 1;
    for (int divisor = 1; divisor <= whole; ++divisor) {
        if (whole % divisor == 0 && std::abs(divisor - step_deg) < std::abs(nearest - step_deg)) nearest = divisor;
    }
    return nearest;
}

/// How many steps make `whole_deg`.
int steps_in(double whole_deg, double step_deg, const std::string& option) {
    const double steps = std::round(whole_deg / step_deg);
    // A decimal step and its product are each rounded once.
    if (std::abs(steps * step_deg - whole_deg) <= 2.0 * std::numeric_limits<double>::epsilon() * whole_deg) {
        return static_cast<int>(steps);
    }
    throw InputError({.where = option,
                      .problem = fmt::format("{} degrees do not divide {}", step_deg, whole_deg),
                      .why = "bins of equal width have to fill it",
                      .remedy = fmt::format("give a step such as {}", nearest_divisor(whole_deg, step_deg))});
}

AngularBins bins_of(const GonioCommand& command) {
    // Half a turn in whole steps: then one bin is centred on each half of the plane of incidence.
    return {.polar = steps_in(90.0, command.polar_step_deg, "--polar-step"),
            .azimuth = 2 * steps_in(180.0, command.azimuth_step_deg, "--azimuth-step")};
}

std::vector<double> weights_of(const GoniophotometerRun& run) {
    std::vector<double> weights = band_weights(run.wavelengths_nm, run.illuminant);
    if (!run.response.empty()) {
        const Response response = read_response(run.response);
        for (std::size_t i = 0; i < weights.size(); ++i) weights[i] *= response(run.wavelengths_nm[i]);
    }
    if (std::ranges::any_of(weights, [](double weight) { return weight > 0.0; })) return weights;
    throw InputError({.where = "wavelengths",
                      .problem = "none of them has any weight",
                      .why = "illuminant times response is zero at each",
                      .remedy = "choose wavelengths at which the band is not dark"});
}

/// Polar bins across the hemisphere, each once.
std::vector<int> compared_bins(const AngularBins& bins) {
    std::vector<int> polar_bins;
    for (const double polar_deg : {12.5, 32.5, 52.5, 72.5}) {
        polar_bins.push_back(static_cast<int>(polar_deg / 90.0 * bins.polar));
    }
    erase_repeated(polar_bins);
    return polar_bins;
}

/// The counts of all wavelengths, one after the other: the rays of each follow those of the one before.
std::vector<AngularCounts> counted(const Sample& sample, const std::vector<double>& wavelengths_nm,
                                   GoniophotometerOptions options, ProgressLine& line) {
    std::vector<AngularCounts> counts;
    for (const double wavelength_nm : wavelengths_nm) {
        line.show({.what = "following rays", .done = counts.size(), .total = wavelengths_nm.size()});
        counts.push_back(goniophotometer(sample, {wavelength_nm}, options).front());
        options.first_ray += options.rays;
    }
    return counts;
}

std::string measure(const GonioCommand& command, GoniophotometerRun& run, ProgressLine& line) {
    const Experiment experiment = make_experiment(run.configuration);
    const GoniophotometerOptions options{.incidence = {experiment.incidence_rad, experiment.incidence_rad},
                                         .rays = run.configuration.rays,
                                         .seed = run.configuration.seed,
                                         .bins = run.spectrum.bins};
    const bool json = command.shared.format == "json";
    if (command.reciprocity) {
        const std::vector<ReciprocityPair> pairs =
            compare_both_ways(experiment.sample(), run.wavelengths_nm, run.spectrum.weights, run.light,
                              compared_bins(run.spectrum.bins), options);
        return json ? reciprocity_json(pairs, run).dump(2) + "\n" : reciprocity_csv(pairs, run);
    }
    run.spectrum.counts = counted(experiment.sample(), run.wavelengths_nm, options, line);
    return json ? goniophotometer_json(run).dump(2) + "\n" : goniophotometer_csv(run);
}

/// Refuses more counts than fit into memory: three kinds of light per bin and wavelength, and those that the threads
/// are still adding up.
void check_memory(const GoniophotometerRun& run) {
    constexpr double bytes_per_bin = 3 * sizeof(std::uint64_t);
    constexpr double in_work = 64;  // chosen: as many parts of a wavelength at a time
    const auto bins = static_cast<double>(run.spectrum.bins.count());
    const std::size_t wavelengths = run.wavelengths_nm.size();
    refuse_beyond_memory(bytes_per_bin * bins * (static_cast<double>(wavelengths) + in_work),
                         fmt::format("gonio, {} bins at {} wavelengths", run.spectrum.bins.count(), wavelengths),
                         "take wider bins (--polar-step, --azimuth-step) or fewer wavelengths");
}

int run(const GonioCommand& command, Session& session) {
    GoniophotometerRun run;
    run.configuration = gonio_configuration(command);
    run.wavelengths_nm = parse_wavelengths(run.configuration.wavelengths, "wavelengths");
    run.illuminant = choice(command.illuminant, illuminants);
    run.response = command.response;
    run.light = choice(command.part, parts);
    run.spectrum.bins = bins_of(command);
    run.spectrum.weights = weights_of(run);
    check_memory(run);
    (void)extinctions(run.wavelengths_nm,
                      make_experiment(run.configuration).edition);  // refuses wavelengths outside the tables
    check_output(command.shared);
    const auto limit = thread_limit(command.shared);
    ProgressLine line(session, "following rays");
    const std::string text = measure(command, run, line);
    line.end();
    write_output(command.shared, text);
    return good_result;
}

}  // namespace

void add_gonio_command(CLI::App& app, Session& session) {
    const auto command = std::make_shared<GonioCommand>();
    CLI::App* const gonio = app.add_subcommand(
        "gonio", "compute into which directions a described skin sends light: BRDF, and BTDF through it");
    add_wavelengths_option(*gonio, command->wavelengths,
                           fmt::format("; {}, or {} with --illuminant or --response", green_light, visible_band));
    one_of(gonio->add_option(
               "--illuminant", command->illuminant,
               "weight of the wavelengths: all alike, daylight D65, or D65 as the eye weighs it (V(lambda))"),
           names_of(illuminants))
        ->capture_default_str();
    gonio
        ->add_option("--response", command->response,
                     "multiply the illuminant by the response in this file, lines of wavelength_nm,response")
        ->type_name("FILE");
    gonio->add_option("--rays", command->rays, fmt::format("per wavelength; {} if not configured", enough_rays))
        ->type_name("N");
    gonio->add_option("--seed", command->seed, "of the random numbers" + unless_configured("seed"))->type_name("N");
    number(gonio->add_option("--polar-step", command->polar_step_deg, "width of the bins of the polar angle"), 0.5,
           90.0, "DEGREES")
        ->capture_default_str();
    number(gonio->add_option("--azimuth-step", command->azimuth_step_deg, "width of the bins of the azimuth"), 0.5,
           180.0, "DEGREES")
        ->capture_default_str();
    one_of(gonio->add_option("--part", command->part,
                             "what of the reflected light: all, what the surface mirrors, what has been inside"),
           names_of(parts))
        ->capture_default_str();
    gonio->add_flag("--reciprocity", command->reciprocity,
                    "compare both ways between pairs of directions, which the model does not promise to be equal");
    add_shared_options(*gonio, command->shared, {"csv", "json"});
    add_examples(*gonio,
                 {"skinfit gonio --rays 100000", "skinfit gonio --illuminant d65_v --rays 20000 --out brdf.csv",
                  "skinfit gonio --wavelengths 633 --set incidence_deg=45 --part surface --rays 100000 --format json"});
    gonio->callback([command, &session] { session.exit_code = run(*command, session); });
}

}  // namespace skinfit
