#include "explore/api.hpp"

#include <fmt/format.h>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "explore/measured_request.hpp"
#include "explore/uploaded_spectra.hpp"
#include "explore/vocabulary.hpp"
#include "fit/band_sampling.hpp"
#include "fit/configuration_json.hpp"
#include "fit/report.hpp"
#include "fit/sensitivity.hpp"

namespace skinfit {
namespace {

Json request_json(const ApiRequest& request) {
    Json json = parsed_json(request.body, "request", "docs/explore.md describes requests", Texts::as_they_are);
    if (json.is_object()) return json;
    refuse("request", json, "an object is needed", "see docs/explore.md");
}

/// The models that a request asks for: a page draws what a fit of its spectra would take.
std::vector<MeasuredModel> models_of(const ApiRequest& request) {
    return measured_models(measured_request(request_json(request)));
}

/// Of a drawn model: what it is drawn for.
Json measurement_json(const MeasuredModel& model) {
    const Json configuration = to_json(model.configuration);
    Json json = {{"noise", configuration["noise"]}};
    for (const std::string_view name : measurement_settings) {
        json[std::string(name)] = configuration[std::string(name)];
    }
    return json;
}

/// The simulation once more, with the errors that the solver states.
std::vector<Reading> readings(const Simulation& simulation) {
    const BandSampling bands = sample_bands(simulation.wavelength_nm, bandpass_of(simulation.configuration));
    const Experiment experiment = make_experiment(simulation.configuration);
    return readings_in_bands(read_by_solver(experiment, bands.wavelength_nm), bands, simulation.wavelength_nm);
}

}  // namespace

ApiAnswer json_answer(const Json& json, int status) {
    return {.status = status, .body = json.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

ApiAnswer error_answer(const std::string& message, int status) {
    return json_answer({{"error", message}}, status);
}

Api::Api(DiskCache cache, std::optional<SpectrumFile> file)
    : file_(file ? uploaded_json(std::move(*file)) : Json()), jobs_(std::move(cache)) {}

Json Api::vocabulary() const {
    Json json = vocabulary_json();
    json["file"] = file_;
    return json;
}

Json Api::simulated(const std::vector<MeasuredModel>& models) {
    Json all = Json::array();
    for (const MeasuredModel& model : models) {
        Json json = simulation_json(simulator_.simulate(model.configuration));
        json["spectra"] = model.spectra;
        json["measurement"] = measurement_json(model);
        json["decided_by"] = model.decided_by;
        all.push_back(std::move(json));
    }
    return {{"models", std::move(all)}};
}

Json Api::exported(const MeasuredRequest& request) {
    const std::vector<MeasuredModel> models = measured_models(request);
    Json simulations = Json::array();
    for (const MeasuredModel& model : models) {
        const Simulation simulation = simulator_.simulate(model.configuration);
        const Configuration configuration = as_stated(simulation.configuration);
        simulations.push_back({{"csv", simulation_csv(readings(simulation), configuration)},
                               {"json", simulation_json(readings(simulation), configuration)}});
    }
    // Of several the geometry stays open: each spectrum states its own.
    const bool is_one = models.size() == 1;
    return {{"simulations", std::move(simulations)},
            {"configuration", to_json(is_one ? models.front().configuration : stated_configuration(request))}};
}

ApiAnswer Api::started(const Json& request) {
    const std::optional<std::string> name = jobs_.start(fit_order(request));
    if (name) return json_answer({{"name", *name}});
    return error_answer("two fits are running; wait for one of them, or cancel it", 429);
}

ApiAnswer Api::on_fit(const ApiRequest& request) {
    if (request.method == "DELETE" && jobs_.cancel(request.name)) return json_answer({{"cancelled", request.name}});
    const std::optional<Json> state = request.method == "GET" ? jobs_.state(request.name) : std::nullopt;
    return state ? json_answer(*state) : error_answer("there is no fit of that name; start it again", 404);
}

ApiAnswer Api::report(const std::string& name) {
    std::optional<std::string> page = jobs_.page(name);
    if (!page) return error_answer("there is no such fit that is done; wait for it, or start it again", 404);
    return {.body = std::move(*page), .saved_as = fmt::format("fit_{}.html", name)};
}

ApiAnswer Api::dispatched(const ApiRequest& request) {
    const std::string route = request.method + " " + request.path;
    if (route == "GET /api/vocabulary") return json_answer(vocabulary());
    if (route == "GET /api/sample") return json_answer(sample_json());
    if (route == "POST /api/spectra") {
        return json_answer(uploaded_json(request.body, request.name, parse_count(request.size)));
    }
    if (route == "GET /api/fit" || route == "DELETE /api/fit") return on_fit(request);
    if (route == "GET /api/report") return report(request.name);
    if (route == "POST /api/fit") return started(request_json(request));
    if (route == "POST /api/simulate") return json_answer(simulated(models_of(request)));
    if (route == "POST /api/sensitivity") {
        return json_answer(
            sensitivity_json(sensitivity(models_of(request).front().configuration), Derivative::relative));
    }
    if (route == "POST /api/export") return json_answer(exported(measured_request(request_json(request))));
    return error_answer("there is nothing at this address", 404);
}

ApiAnswer Api::answer(const ApiRequest& request) {
    try {
        return dispatched(request);
    } catch (const InputError& error) {
        return error_answer(error.what(), 400);
    } catch (const std::exception& error) {
        return error_answer(std::string("internal error: ") + error.what(), 500);
    }
}

}  // namespace skinfit
