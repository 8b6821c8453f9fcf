#include "tests/support/known_names.hpp"

#include "core/vocabulary.hpp"
#include "fit/settings.hpp"
#include "model/parameters.hpp"

namespace skinfit::test {
namespace {

// Of JSON Schema, in which `skinfit config schema` is written.
const Names schema_words = {"$schema",     "additionalProperties",
                            "anyOf",       "array",
                            "boolean",     "default",
                            "description", "enum",
                            "integer",     "items",
                            "maximum",     "minimum",
                            "null",        "number",
                            "object",      "pattern",
                            "properties",  "required",
                            "string",      "title",
                            "type"};

void add_strings(const Json& json, Names& names) {
    if (json.is_string()) names.insert(json.get<std::string>());
    if (!json.is_structured()) return;
    for (const Json& each : json) add_strings(each, names);
}

}  // namespace

Names known_names() {
    Names names = schema_words;
    for (const ParameterInfo& each : parameter_table()) names.emplace(each.name);
    for (const Setting& each : setting_table()) {
        names.emplace(each.name);
        add_strings(each.schema, names);
    }
    for (const Word& each : vocabulary()) names.emplace(each.name);
    return names;
}

}  // namespace skinfit::test
