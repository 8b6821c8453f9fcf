#include "explore/configuration_request.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "fit/configuration_json.hpp"
#include "fit/named_instrument.hpp"

namespace skinfit {
namespace {

const std::string where = "configuration";

/// `configured` would read a file of that name.
void refuse_instrument_files(const Json& json) {
    if (!json.is_object()) return;
    if (json.contains("configuration")) refuse_instrument_files(json["configuration"]);
    if (!json.contains("instrument") || !json["instrument"].is_string()) return;
    const std::vector<std::string> names = instrument_names();
    if (std::ranges::find(names, json["instrument"].get<std::string>()) != names.end()) return;
    refuse(where + ".instrument", json["instrument"], "a page cannot name files of this machine",
           fmt::format("choose one of {}", fmt::join(names, ", ")));
}

}  // namespace

Configuration explore_configuration() {
    Configuration configuration = default_configuration();
    configuration.engine = Engine::emulator;
    configuration.wavelengths = "400:700:2";  // shows both dips of oxygenated blood, at 542 and 577 nm
    return configuration;
}

Configuration requested_configuration(const Configuration& base, const Json& json) {
    refuse_instrument_files(json);
    return configured(base, json, where);
}

}  // namespace skinfit
