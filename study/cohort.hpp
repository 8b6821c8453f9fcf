#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "fit/configuration.hpp"
#include "study/transport_plan.hpp"

namespace skinfit {

/// Something that is true of a subject or not: whether the value of a parameter lies beyond a limit.
struct CohortLabel {
    std::string name;
    Parameter parameter;
    bool above;    ///< true of values above the limit, else of those below
    double limit;  ///< belongs to neither side

    /// Whether `values` lie within the limits.
    [[nodiscard]] bool holds(const ParameterValues& values) const;
};

/// Subjects who come from one population.
struct CohortGroup {
    std::string name;
    std::uint64_t subjects;
    /// Of the simulation. What is drawn for each subject is free: from its prior within its bounds, uniform where it
    /// has none. The rest is the same in all of them.
    Configuration configuration;
    std::vector<std::string> metadata;  ///< one cell per `Cohort::metadata_names`; empty where it has none
};

/// A study that could be made: who is measured, how often, and how well.
struct Cohort {
    std::string name;
    std::uint64_t repeats;                    ///< measurements of each subject
    Configuration configuration;              ///< what the groups have in common: model, noise, wavelengths, seed
    std::optional<TransportPlan> transport;   ///< that makes the spectra in place of an engine of the model
    std::vector<CohortGroup> groups;          ///< at least one, of different names
    std::vector<std::string> metadata_names;  ///< in the order of their first appearance
    std::vector<CohortLabel> labels;
    Json study;     ///< keys that replace those of the study made for it; an object
    Json resolved;  ///< the cohort with every default filled in: `read_cohort` makes the same cohort of it
};

/// Reads a cohort, see docs/studies.md. Throws InputError, naming `where`, for anything unknown, for values out of
/// range, for what a simulation or the tables written could not hold, and as `make_problem` does for populations.
[[nodiscard]] Cohort read_cohort(const Json& json, const std::string& where);

/// The parameters that are not the same in all subjects, in the order of the parameter table.
[[nodiscard]] std::vector<Parameter> varying_parameters(const Cohort& cohort);

}  // namespace skinfit
