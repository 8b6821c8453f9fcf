#include "tests/study/transport_cohort.hpp"

namespace skinfit::test {

Json transport_cohort_json() {
    return Json::parse(R"({
        "name": "other", "seed": 5, "wavelengths": "450:650:100", "noise": 0.004,
        "transport": {
            "scattering_at_500_nm_per_cm": {"kind": "log_normal", "median": 46, "sigma_log": 0.3, "lower": 20, "upper": 90},
            "scattering_power": {"kind": "uniform", "lower": 0.5, "upper": 1.5},
            "photons": 1000
        },
        "population": {
            "melanosome_fraction": {"kind": "log_normal", "median": 0.06, "sigma_log": 0.7, "lower": 0.01, "upper": 0.5},
            "oxygen_saturation": {"kind": "uniform", "lower": 0.3, "upper": 0.95},
            "dermal_bilirubin_g_per_l": 0
        },
        "groups": [
            {"name": "first", "subjects": 3},
            {"name": "second", "subjects": 2,
             "population": {"dermal_bilirubin_g_per_l": {"kind": "uniform", "lower": 0.01, "upper": 0.1}}}
        ],
        "labels": {"bilirubin": {"parameter": "dermal_bilirubin_g_per_l", "above": 0.005},
                   "pale": {"parameter": "melanosome_fraction", "below": 0.05}}
    })");
}

}  // namespace skinfit::test
