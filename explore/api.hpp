#pragma once

#include <optional>
#include <string>
#include <vector>

#include "explore/fit_jobs.hpp"
#include "explore/measured_request.hpp"
#include "explore/simulation.hpp"
#include "measurements/spectrum_file.hpp"

namespace skinfit {

/// A request to the application, its access already granted.
struct ApiRequest {
    std::string method;
    std::string path;
    std::string name;    ///< of a fit, or of an uploaded file: of the query
    std::string size{};  ///< of an uploaded file of which only the beginning is sent, bytes: of the query
    std::string body;
};

/// The answer: JSON, `{"error": "..."}` where the status is not 200.
struct ApiAnswer {
    int status = 200;
    std::string body;
    std::string saved_as{};  ///< the name of a file: the body is an HTML page, to be saved and not shown; else empty
};

/// Everything the page can ask for, whatever carries the requests. Calls may come from any thread.
///
///     GET    /api/vocabulary           parameters, settings, defaults; and "file", where one was given at the start
///     GET    /api/sample               a specimen that comes with the program, as a file that was sent
///     POST   /api/simulate             a `MeasuredRequest` -> of each of its `measured_models` spectrum, shares,
///     colour POST   /api/sensitivity          the same -> relative derivatives of the first model, as
///     `sensitivity_json` POST   /api/spectra?name=FILE    the bytes of a file -> its spectra and findings POST
///     /api/export               a `MeasuredRequest` -> the simulations as files (csv, json), the configuration POST
///     /api/fit                  the same, with at least one spectrum -> {"name": ...} GET    /api/fit?name=NAME how
///     far it is, and in the end its documents DELETE /api/fit?name=NAME        asks it to stop GET
///     /api/report?name=NAME     its report as an HTML page, once it is done
class Api {
public:
    /// `file`: spectra to begin with. Throws InputError as `uploaded_json`.
    Api(DiskCache cache, std::optional<SpectrumFile> file);

    /// The answer to one request, an error of the user's as status 400. Calls may come from any thread.
    [[nodiscard]] ApiAnswer answer(const ApiRequest& request);

private:
    [[nodiscard]] Json vocabulary() const;
    [[nodiscard]] Json simulated(const std::vector<MeasuredModel>& models);
    [[nodiscard]] Json exported(const MeasuredRequest& request);
    [[nodiscard]] ApiAnswer started(const Json& request);
    [[nodiscard]] ApiAnswer on_fit(const ApiRequest& request);
    [[nodiscard]] ApiAnswer report(const std::string& name);
    [[nodiscard]] ApiAnswer dispatched(const ApiRequest& request);

    Json file_;
    LiveSimulator simulator_;
    FitJobs jobs_;
};

/// `json` as the body of an answer.
[[nodiscard]] ApiAnswer json_answer(const Json& json, int status = 200);

/// The answer to what cannot be done.
[[nodiscard]] ApiAnswer error_answer(const std::string& message, int status);

}  // namespace skinfit
