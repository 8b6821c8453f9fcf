#include "fit/configuration_json.hpp"
#include "validation/figure.hpp"
#include "validation/figure_names.hpp"

namespace skinfit {
namespace {

Json object_schema(const Json& properties, const std::vector<std::string_view>& required) {
    return {{"type", "object"}, {"properties", properties}, {"required", required}, {"additionalProperties", false}};
}

Json list_schema(const Json& items) {
    return {{"type", "array"}, {"items", items}, {"minItems", 1}};
}

Json text_schema(std::string_view description) {
    return {{"type", "string"}, {"minLength", 1}, {"description", description}};
}

/// What a fit's configuration holds, without its own title.
Json configuration_part() {
    Json schema = configuration_schema();
    schema.erase("$schema");
    schema.erase("title");
    return schema;
}

}  // namespace

Json figure_schema() {
    const Json configuration = configuration_part();
    std::vector<std::string_view> claims;
    for (const ClaimInfo& row : claim_table()) claims.push_back(row.name);
    const Json series =
        object_schema({{"name", text_schema("for legends and tables")}, {"configuration", configuration}}, {"name"});
    const Json panel = object_schema({{"title", text_schema("of the plot")},
                                      {"light", {{"enum", figure_light_names}}},
                                      {"swatches", {{"type", "boolean"}}},
                                      {"configuration", configuration},
                                      {"series", list_schema(series)},
                                      {"measured", text_schema("a shipped file, or one below shared/")},
                                      {"claims", list_schema({{"enum", claims}})}},
                                     {"title", "series"});
    const Json& properties = configuration["properties"];
    const Json variants = object_schema(
        {{"edition", list_schema(properties["edition"])},
         {"fibril_radius_nm", list_schema(properties["parameters"]["properties"]["fibril_radius_nm"]["anyOf"][0])}},
        {"edition", "fibril_radius_nm"});
    Json schema = object_schema({{"figure", {{"type", "integer"}}},
                                 {"title", text_schema("of the figure")},
                                 {"shows", text_schema("what the paper shows there")},
                                 {"kind", {{"enum", figure_kind_names}}},
                                 {"configuration", configuration},
                                 {"variants", variants},
                                 {"panels", list_schema(panel)},
                                 {"sources",
                                  {{"type", "object"},
                                   {"description", "of every value set anywhere"},
                                   {"additionalProperties", {{"type", "string"}, {"pattern", "^(paper|chosen): "}}}}}},
                                {"figure", "title", "shows", "kind", "variants", "panels", "sources"});
    schema["$schema"] = "http://json-schema.org/draft-07/schema#";
    schema["title"] = "skinfit figure";
    return schema;
}

}  // namespace skinfit
