#include "study/study.hpp"

#include <algorithm>

#include "fit/configuration_json.hpp"
#include "fit/file_settings.hpp"

namespace skinfit {
namespace {

Configuration studied_by_default() {
    Configuration configuration = default_configuration();
    configuration.engine = Engine::emulator;
    return configuration;
}

Configuration configured_for(const Study& study, const Configuration& defaults) {
    Configuration configuration = configured(defaults, study.fit, study.file.string() + ".fit");
    if (study.instrument) configuration.instrument = study.instrument;
    return configuration;
}

}  // namespace

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

Configuration configuration_of(const Study& study) {
    return configured_for(study, studied_by_default());
}

Configuration configuration_of(const Study& study, const Spectrum& spectrum) {
    if (spectrum.notes.empty()) return configuration_of(study);
    return configured_for(study, with_file_settings(studied_by_default(), {&spectrum, 1}));
}

}  // namespace skinfit
