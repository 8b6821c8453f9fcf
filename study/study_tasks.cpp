#include "study/study_tasks.hpp"

#include <cstdint>

namespace skinfit {
namespace {

// CBOR keeps doubles to the last bit and bytes as they are.
std::string packed(const Json& json) {
    std::string bytes;
    Json::to_cbor(json, nlohmann::detail::output_adapter<char>(bytes));
    return bytes;
}

Json tile_json(const CubeTile& tile) {
    return {tile.first_line, tile.lines};
}

CubeTile tile_from(const Json& json) {
    return {.first_line = json.at(0).get<std::size_t>(), .lines = json.at(1).get<std::size_t>()};
}

}  // namespace

std::string bytes_of(const StudyTask& task) {
    if (const auto* const spectra = std::get_if<SpectraTask>(&task)) {
        Json list = Json::array();
        for (const auto& [number, name, hash] : spectra->spectra) list.push_back({number, name, hash});
        return packed({{"file", spectra->file}, {"spectra", list}});
    }
    const auto& tile = std::get<TileTask>(task);
    return packed({{"cube", tile.cube}, {"tile", tile_json(tile.tile)}});
}

StudyTask task_in(const std::string& bytes) {
    const Json json = Json::from_cbor(bytes);
    if (json.contains("file")) {
        SpectraTask task{.file = json.at("file").get<std::size_t>(), .spectra = {}};
        for (const Json& each : json.at("spectra")) {
            task.spectra.push_back({.number = each.at(0).get<std::size_t>(),
                                    .name = each.at(1).get<std::string>(),
                                    .input_hash = each.at(2).get<std::string>()});
        }
        return task;
    }
    return TileTask{.cube = json.at("cube").get<std::size_t>(), .tile = tile_from(json.at("tile"))};
}

std::string bytes_of(const SpectraDone& done) {
    Json answers = Json::array();
    for (const auto& [key, studied] : done.answers) {
        answers.push_back(
            {{"source", key.source}, {"number", key.number}, {"name", key.name}, {"studied", to_json(studied)}});
    }
    return packed({{"answers", answers}});
}

std::string bytes_of(const TileDone& done) {
    const std::string& map = done.tile.bytes;
    return packed({{"cube", done.cube},
                   {"tile", tile_json(done.tile.tile)},
                   {"pixels", done.tile.pixels},
                   {"bytes", Json::binary(std::vector<std::uint8_t>(map.begin(), map.end()))},
                   {"seconds", done.tile.seconds},
                   {"problem", done.problem}});
}

StudyDone done_in(const std::string& bytes) {
    const Json json = Json::from_cbor(bytes);
    if (json.contains("answers")) {
        SpectraDone done;
        for (const Json& each : json.at("answers")) {
            done.answers.push_back({.key = {.source = each.at("source").get<std::string>(),
                                            .number = each.at("number").get<std::size_t>(),
                                            .name = each.at("name").get<std::string>()},
                                    .studied = studied_from_json(each.at("studied"))});
        }
        return done;
    }
    const Json::binary_t& map = json.at("bytes").get_binary();
    return TileDone{.cube = json.at("cube").get<std::size_t>(),
                    .tile = {.tile = tile_from(json.at("tile")),
                             .pixels = json.at("pixels").get<StatusCounts>(),
                             .bytes = std::string(map.begin(), map.end()),
                             .seconds = json.at("seconds").get<double>()},
                    .problem = json.at("problem").get<std::string>()};
}

}  // namespace skinfit
