#include <fmt/format.h>

#include "core/input_error.hpp"
#include "core/version.hpp"
#include "fit/configuration_json.hpp"
#include "fit/sensitivity.hpp"

namespace skinfit {
namespace {

using Index = Eigen::Index;

std::string_view quantity_name(const Sensitivity& sensitivity) {
    return quantity_names.at(static_cast<std::size_t>(sensitivity.configuration.quantity));
}

Eigen::MatrixXd entries(const Sensitivity& sensitivity, Derivative derivative) {
    return derivative == Derivative::relative ? relative_derivative(sensitivity) : sensitivity.derivative;
}

std::string_view meaning(Derivative derivative) {
    return derivative == Derivative::relative ? "parameter x d(reading)/d(parameter)"
                                              : "d(reading)/d(parameter), per unit of the parameter";
}

std::string word(const Json& json) {
    return json.is_string() ? json.get<std::string>() : json.dump();
}

}  // namespace

std::string sensitivity_csv(const Sensitivity& sensitivity, Derivative derivative) {
    const Json settings = to_json(sensitivity.configuration);
    std::string text = fmt::format("# skinfit {} sensitivity\n", version);
    for (const char* key : {"quantity", "edition", "engine", "layers", "base", "incidence_deg", "specular"}) {
        text += fmt::format("# {}: {}\n", key, word(settings[key]));
    }
    if (const auto cone_deg = sensitivity.configuration.viewing_cone_deg) {
        text += fmt::format("# viewing_cone_deg: {}\n", *cone_deg);
    }
    text += "# parameters:";
    for (const ParameterInfo& row : parameter_table()) {
        text += fmt::format(" {}={}", row.name, value_of(sensitivity.configuration.values, row.parameter));
    }
    text += "\n# without effect:";
    for (const Parameter parameter : sensitivity.without_effect) text += fmt::format(" {}", info(parameter).name);
    text += fmt::format("\n# derivatives: {}\nwavelength_nm,reading", meaning(derivative));
    for (const Parameter parameter : sensitivity.parameters) text += fmt::format(",{}", info(parameter).name);
    text += "\n";
    const Eigen::MatrixXd table = entries(sensitivity, derivative);
    for (std::size_t i = 0; i < sensitivity.wavelength_nm.size(); ++i) {
        text += fmt::format("{},{}", sensitivity.wavelength_nm[i], sensitivity.reading[i]);
        for (const double entry : table.row(static_cast<Index>(i))) text += fmt::format(",{}", entry);
        text += "\n";
    }
    return text;
}

Json sensitivity_json(const Sensitivity& sensitivity, Derivative derivative) {
    Json json = {{"quantity", quantity_name(sensitivity)},
                 {"derivatives", meaning(derivative)},
                 {"wavelength_nm", sensitivity.wavelength_nm},
                 {"reading", sensitivity.reading},
                 {"derivative", Json::object()},
                 {"without_effect", Json::array()}};
    const Eigen::MatrixXd table = entries(sensitivity, derivative);
    for (std::size_t i = 0; i < sensitivity.parameters.size(); ++i) {
        const auto column = table.col(static_cast<Index>(i));
        json["derivative"][info(sensitivity.parameters[i]).name] = std::vector<double>(column.begin(), column.end());
    }
    for (const Parameter parameter : sensitivity.without_effect) {
        json["without_effect"].push_back(info(parameter).name);
    }
    json["version"] = version;
    json["configuration"] = to_json(sensitivity.configuration);
    return json;
}

Plot sensitivity_plot(const Sensitivity& sensitivity) {
    const ResolvedConfiguration& configuration = sensitivity.configuration;
    const std::string_view quantity = quantity_name(sensitivity);
    const auto cone_deg = configuration.viewing_cone_deg;
    Plot plot{
        .title = fmt::format("Sensitivity of {}: edition {}, {} layers, incidence {} deg, specular {}{}", quantity,
                             word(to_json(configuration)["edition"]), configuration.layers, configuration.incidence_deg,
                             specular_names.at(static_cast<std::size_t>(configuration.specular)),
                             cone_deg ? fmt::format(", viewing cone {} deg", *cone_deg) : ""),
        .x_label = "wavelength (nm)",
        .y_label = fmt::format("parameter x d({}) / d(parameter)  (fraction)", quantity),
        .lines = {}};
    const Eigen::MatrixXd relative = relative_derivative(sensitivity);
    for (std::size_t i = 0; i < sensitivity.parameters.size(); ++i) {
        const Parameter parameter = sensitivity.parameters[i];
        if (!configuration.free[static_cast<std::size_t>(parameter)]) continue;
        const auto column = relative.col(static_cast<Index>(i));
        plot.lines.push_back(
            {.label = fmt::format("{} = {}", info(parameter).name, value_of(configuration.values, parameter)),
             .x = sensitivity.wavelength_nm,
             .y = std::vector<double>(column.begin(), column.end())});
    }
    if (!plot.lines.empty()) return plot;
    throw InputError({.where = "free",
                      .problem = fmt::format("no free parameter has an effect on {}", quantity),
                      .why = "the plot has a line for each",
                      .remedy = "free another with --free, or change the settings"});
}

}  // namespace skinfit
