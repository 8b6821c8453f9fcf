#include "study/study_inputs.hpp"

#include <fmt/format.h>
#include <glob.h>

#include <re2/re2.h>
#include <algorithm>
#include <array>
#include <map>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "fit/json_reading.hpp"
#include "fit/settings.hpp"
#include "measurements/spectrum_file.hpp"
#include "study/manifest_reader.hpp"

namespace skinfit {
namespace {

namespace fs = std::filesystem;

std::string word(const Json& value, const std::string& where) {
    if (value.is_string() && !value.get<std::string>().empty()) return value.get<std::string>();
    refuse(where, value, "a word is needed", "write it between double quotes");
}

/// `folder` as a pattern that matches itself alone.
std::string literal(const fs::path& folder) {
    std::string pattern;
    for (const char c : folder.string()) {
        if (std::string_view("*?[]\\").find(c) != std::string_view::npos) pattern += '\\';
        pattern += c;
    }
    return pattern;
}

/// A pattern that is also the name of a file, which as a pattern does not match itself: `a[1].csv`.
[[noreturn]] void refuse_ambiguous(const fs::path& whole, const fs::path& matched, const std::string& where) {
    throw InputError(
        {.where = where,
         .problem = fmt::format("{} is a file, and as a pattern names {}", whole.string(), matched.string()),
         .why = "either may be meant",
         .remedy = "for the file write a backslash before each of *, ? and [ (in JSON two: \\\\[), or rename it"});
}

/// The files that a pattern names, sorted. A name without wildcards is itself, whether there is such a file or not, and
/// so is that of a file that as a pattern names nothing.
std::vector<fs::path> matches(const std::string& pattern, const fs::path& folder, const std::string& where) {
    const fs::path whole = folder / pattern;
    std::error_code none;
    if (pattern.find_first_of("*?[") == std::string::npos) return {whole};
    glob_t found{};
    const int status = ::glob((fs::path(literal(folder)) / pattern).c_str(), GLOB_ERR, nullptr, &found);
    std::vector<fs::path> paths;
    if (status == 0) paths.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
    ::globfree(&found);
    std::erase_if(paths, [&](const fs::path& path) { return fs::is_directory(path, none); });
    const bool is_file = fs::exists(whole, none) && !fs::is_directory(whole, none);
    if (is_file && !paths.empty() &&
        std::ranges::none_of(paths, [&](const fs::path& path) { return fs::equivalent(path, whole, none); })) {
        refuse_ambiguous(whole, paths.front(), where);
    }
    if (is_file && paths.empty()) return {whole};
    if (!paths.empty()) return paths;
    throw InputError({.where = where,
                      .problem = fmt::format("no file matches {}", whole.string()),
                      .why = status == GLOB_ABORTED ? "a folder cannot be read" : "the study would lack its spectra",
                      .remedy = "correct the pattern, or name the folder of the data with --data"});
}

/// As the ledger names it, however the study's own file is named: relative to its folder, unless the study names the
/// file (`named`) by an absolute path.
std::string source_of(const fs::path& path, const fs::path& named, const fs::path& folder) {
    if (named.is_absolute()) return path.lexically_normal().string();
    const fs::path from = folder.empty() ? fs::path(".") : folder;
    return path.lexically_normal().lexically_relative(from.lexically_normal()).string();
}

Metadata read_metadata(const Json& json, const std::string& where) {
    Metadata metadata;
    if (!json.contains("metadata")) return metadata;
    require_object(json["metadata"], where + ".metadata", study_example);
    for (const auto& [name, value] : json["metadata"].items()) {
        if (value.is_structured() || value.is_null()) {
            refuse(fmt::format("{}.metadata.{}", where, name), value, "a word or a number is needed", study_example);
        }
        metadata.emplace_back(name, value.is_string() ? value.get<std::string>() : value.dump());
    }
    return metadata;
}

std::optional<NamePattern> read_pattern(const Json& json, const std::string& where) {
    if (!json.contains("names")) return std::nullopt;
    const std::string here = where + ".names";
    require_names(json["names"], {"pattern", "fields"},
                  {{"pattern", "fields"}, "names are read by both", study_example}, here);
    NamePattern pattern{.expression = word(json["names"]["pattern"], here + ".pattern"), .fields = {}};
    const Json& fields = json["names"]["fields"];
    if (!fields.is_array()) refuse(here + ".fields", fields, "a list of words is needed", study_example);
    for (const Json& field : fields) {
        const std::string name = word(field, here + ".fields");
        if (std::ranges::find(pattern.fields, name) != pattern.fields.end()) {
            refuse(here + ".fields", field, "another group has it", "give each a name of its own");
        }
        pattern.fields.push_back(name);
    }
    const re2::RE2 compiled(pattern.expression, re2::RE2::Quiet);
    if (!compiled.ok()) {
        refuse(here + ".pattern", json["names"]["pattern"], compiled.error(),
               "write a regular expression of RE2, which has no look-ahead and no back-references");
    }
    if (static_cast<std::size_t>(compiled.NumberOfCapturingGroups()) != pattern.fields.size()) {
        refuse(here + ".fields", fields, fmt::format("the pattern has {} groups", compiled.NumberOfCapturingGroups()),
               "name each group once");
    }
    return pattern;
}

std::optional<Unit> read_unit(const Json& json, const std::string& where) {
    if (!json.contains("unit")) return std::nullopt;
    return static_cast<Unit>(read_choice(json["unit"], unit_names, where + ".unit"));
}

std::optional<std::string> read_reader(const Json& json, const std::string& where) {
    if (!json.contains("reader")) return std::nullopt;
    const std::vector<std::string_view> names = reader_names();
    return std::string(names[read_choice(json["reader"], names, where + ".reader")]);
}

std::vector<std::string> patterns_of(const Json& value, const std::string& where) {
    if (!value.is_array()) return {word(value, where)};
    std::vector<std::string> patterns;
    for (const Json& each : value) patterns.push_back(word(each, where));
    if (patterns.empty()) refuse(where, value, "it names no file", study_example);
    return patterns;
}

/// The entry of a study for what all files of `json` share.
StudyFile common_file(const Json& json, const std::string& where) {
    return {.source = {},
            .path = {},
            .unit = read_unit(json, where),
            .reader = read_reader(json, where),
            .metadata = read_metadata(json, where),
            .names = read_pattern(json, where),
            .selected = {}};
}

void add_files(const Json& json, const fs::path& folder, const std::string& where, StudyInputs& inputs) {
    require_names(json, {"files", "unit", "reader", "metadata", "names"}, {{}, "", study_example}, where);
    const StudyFile common = common_file(json, where);
    for (const std::string& pattern : patterns_of(json["files"], where + ".files")) {
        for (const fs::path& path : matches(pattern, folder, where + ".files")) {
            inputs.files.push_back(common);
            inputs.files.back().path = path;
            inputs.files.back().source = source_of(path, pattern, folder);
        }
    }
}

void add_manifest(const Json& json, const fs::path& folder, const std::string& where, StudyInputs& inputs) {
    require_names(json, {"manifest", "unit", "reader", "metadata"}, {{}, "", study_example}, where);
    const StudyFile common = common_file(json, where);
    const fs::path named = word(json["manifest"], where + ".manifest");
    const fs::path path = folder / named;
    const std::size_t first = inputs.files.size();
    std::map<std::string, std::size_t> places;
    for (const ManifestRow& row : parse_manifest(read_input(path), path.string())) {
        const fs::path file = path.parent_path() / row.file;
        const auto [place, is_new] =
            places.try_emplace(source_of(file, named.parent_path() / row.file, folder), first + places.size());
        if (is_new) {
            inputs.files.push_back(common);
            inputs.files.back().path = file;
            inputs.files.back().source = place->first;
        }
        inputs.files[place->second].selected.push_back(row.selected);
    }
}

void add_cubes(const Json& json, const fs::path& folder, const std::string& where, StudyInputs& inputs) {
    require_names(json, {"cube", "mask", "rectangle", "unit", "metadata"}, {{}, "", study_example}, where);
    StudyCube common{
        .source = {}, .path = {}, .unit = read_unit(json, where), .region = {}, .metadata = read_metadata(json, where)};
    if (json.contains("mask")) common.region.mask = folder / word(json["mask"], where + ".mask");
    if (json.contains("rectangle")) {
        common.region.rectangle = parse_rectangle(word(json["rectangle"], where + ".rectangle"), where + ".rectangle");
    }
    for (const std::string& pattern : patterns_of(json["cube"], where + ".cube")) {
        for (const fs::path& path : matches(pattern, folder, where + ".cube")) {
            inputs.cubes.push_back(common);
            inputs.cubes.back().path = path;
            inputs.cubes.back().source = source_of(path, pattern, folder);
        }
    }
}

}  // namespace

StudyInputs read_inputs(const Json& json, const fs::path& folder, const std::string& where) {
    if (!json.is_array() || json.empty()) refuse(where, json, "a list of files is needed", study_example);
    StudyInputs inputs;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const Json& each = json[i];
        const std::string here = fmt::format("{}[{}]", where, i);
        if (each.is_string()) {
            add_files({{"files", each}}, folder, here, inputs);
            continue;
        }
        require_object(each, here, study_example);
        const std::array<std::string_view, 3> kinds = {"files", "manifest", "cube"};
        const auto kind = std::ranges::find_if(kinds, [&](std::string_view name) { return each.contains(name); });
        if (kind == kinds.end()) refuse(here, each, R"(it names no "files", "manifest" or "cube")", study_example);
        if (std::any_of(kind + 1, kinds.end(), [&](std::string_view name) { return each.contains(name); })) {
            refuse(here, each, "it is two kinds of input", "make an input of each");
        }
        if (*kind == "files") add_files(each, folder, here, inputs);
        if (*kind == "manifest") add_manifest(each, folder, here, inputs);
        if (*kind == "cube") add_cubes(each, folder, here, inputs);
    }
    return inputs;
}

}  // namespace skinfit
