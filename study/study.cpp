#include "study/study.hpp"

#include <algorithm>

namespace skinfit {
std::string word_of(const Metadata& metadata, std::string_view name) {
    const auto found = std::ranges::find(metadata, name, &Metadata::value_type::first);
    return found == metadata.end() ? std::string() : found->second;
}

Metadata merged(Metadata metadata, const Metadata& more) {
    for (const auto& [name, word] : more) {
        const auto found = std::ranges::find(metadata, name, &Metadata::value_type::first);
        if (found == metadata.end()) {
            metadata.emplace_back(name, word);
        } else {
            found->second = word;
        }
    }
    return metadata;
}

Json metadata_json(const Metadata& metadata) {
    Json json = Json::object();
    for (const auto& [name, word] : metadata) json[name] = word;
    return json;
}

Metadata metadata_from(const Json& json) {
    Metadata metadata;
    for (const auto& [name, word] : json.items()) metadata.emplace_back(name, word.get<std::string>());
    return metadata;
}

Configuration default_study_configuration() {
    Configuration configuration = default_configuration();
    configuration.engine = Engine::emulator;
    return configuration;
}

}  // namespace skinfit
