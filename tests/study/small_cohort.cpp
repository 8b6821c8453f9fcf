#include "tests/study/small_cohort.hpp"

namespace skinfit::test {

Json small_cohort() {
    return Json::parse(R"({
        "name": "small", "seed": 5, "wavelengths": "450:650:100", "noise": 0.004,
        "population": {
            "melanosome_fraction": {"kind": "uniform", "lower": 0.01, "upper": 0.1},
            "hemoglobin_g_per_l": {"kind": "normal", "mean": 150, "sigma": 10},
            "oxygen_saturation": {"kind": "beta", "a": 6, "b": 3},
            "bilirubin_g_per_l": {"kind": "log_normal", "median": 0.2, "sigma_log": 1}
        },
        "groups": [
            {"name": "first", "subjects": 4, "metadata": {"skin_type": "II", "age": 30}},
            {"name": "second one", "subjects": 3, "metadata": {"site": "cheek", "skin_type": "V"},
             "population": {"melanosome_fraction": {"kind": "uniform", "lower": 0.2, "upper": 0.4},
                            "bilirubin_g_per_l": 0.3}}
        ],
        "labels": {"jaundiced": {"parameter": "bilirubin_g_per_l", "above": 0.25},
                   "pale": {"parameter": "melanosome_fraction", "below": 0.05}}
    })");
}

Cohort cohort_of(const Json& json) {
    return read_cohort(json, "cohort.json");
}

DiskCache without_cache() {
    return {.folder = std::nullopt, .warn = [](const std::string&) {}, .inform = [](const std::string&) {}};
}

}  // namespace skinfit::test
