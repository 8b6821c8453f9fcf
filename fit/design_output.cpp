#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/version.hpp"
#include "fit/configuration_json.hpp"
#include "fit/design.hpp"

namespace skinfit {
namespace {

Json limit_json(const DetectionLimit& limit) {
    return {{"sigma", limit.sigma}, {"detection_limit", limit.limit}};
}

std::string limit_row(std::string_view what, const DetectionLimit& limit) {
    return fmt::format("  {:<44}{:>12.3g}{:>18.3g}\n", what, limit.sigma, limit.limit);
}

std::string others(const Design& design) {
    std::string text;
    for (const Parameter parameter : free_parameters(design.configuration)) {
        if (parameter != design.parameter) text += fmt::format(" {}", info(parameter).name);
    }
    return text.empty() ? " none" : text;
}

}  // namespace

std::string design_text(const Design& design) {
    const ParameterInfo& row = info(design.parameter);
    std::string text =
        fmt::format("{} around {:.6g}{}{}, noise {:g}, {} wavelengths from {:g} to {:g} nm\n", row.name, design.value,
                    row.unit.empty() ? "" : " ", row.unit, design.configuration.noise, design.wavelength_nm.size(),
                    design.wavelength_nm.front(), design.wavelength_nm.back());
    if (design.configuration.discrepancy) {
        text += "of noise alone: the discrepancy is not counted, so a fit with it finds less\n";
    }
    text += fmt::format("  {:<44}{:>12}{:>18}\n", "", "1 sigma", "detection limit");
    text += limit_row("others free", design.others_free);
    text += limit_row("others fixed", design.others_fixed);
    if (design.by_best) {
        text += limit_row(fmt::format("others free, best {} wavelengths", design.best_nm.size()), *design.by_best);
        text += fmt::format("best wavelengths: {} nm\n", fmt::join(design.best_nm, ", "));
    }
    text += fmt::format("others, each known beforehand as its prior says, else only to lie within its bounds:{}\n",
                        others(design));
    text +=
        fmt::format("detection limit: {:.3f} sigma, found in 80 % of spectra by a one-sided test at the 5 % level\n",
                    detection_factor());
    return text + fmt::format("skinfit {}, research software, not a medical device\n", version);
}

std::string design_csv(const Design& design) {
    std::string text =
        fmt::format("# skinfit {} design\nparameter,value,noise,wavelengths,others,sigma,detection_limit\n", version);
    const auto row = [&](std::size_t wavelengths, std::string_view words, const DetectionLimit& limit) {
        text += fmt::format("{},{},{},{},{},{},{}\n", info(design.parameter).name, design.value,
                            design.configuration.noise, wavelengths, words, limit.sigma, limit.limit);
    };
    row(design.wavelength_nm.size(), "free", design.others_free);
    row(design.wavelength_nm.size(), "fixed", design.others_fixed);
    if (design.by_best) {
        row(design.best_nm.size(), "free", *design.by_best);
        text += fmt::format("# best_nm: {}\n", fmt::join(design.best_nm, " "));
    }
    return text;
}

Json design_json(const Design& design) {
    Json json = {{"parameter", info(design.parameter).name},
                 {"unit", info(design.parameter).unit},
                 {"value", design.value},
                 {"noise", design.configuration.noise},
                 {"wavelength_nm", design.wavelength_nm},
                 {"alpha", 0.05},
                 {"power", 0.8},
                 {"others_free", limit_json(design.others_free)},
                 {"others_fixed", limit_json(design.others_fixed)}};
    if (design.by_best) {
        json["best_nm"] = design.best_nm;
        json["by_best"] = limit_json(*design.by_best);
    }
    json["version"] = version;
    json["configuration"] = to_json(design.configuration);
    return json;
}

}  // namespace skinfit
