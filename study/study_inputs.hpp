#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "study/study.hpp"

namespace skinfit {

/// What a study reads.
struct StudyInputs {
    std::vector<StudyFile> files;
    std::vector<StudyCube> cubes;
};

/// The files that `json`, the list of a study's inputs, names, in its order; each entry is a file or a pattern of
/// files, or an object
///
///   {"files": "*.csv" or [...], "unit", "reader", "metadata": {...}, "names": {"pattern", "fields"}}
///   {"manifest": "manifest.csv", "unit", "reader", "metadata"}
///   {"cube": "hand.hdr", "mask": "mask.png", "rectangle": "x,y,width,height", "unit", "metadata"}
///
/// Names are relative to `folder`, those of a manifest to its own folder. Throws InputError naming `where` as
/// `read_study` states.
[[nodiscard]] StudyInputs read_inputs(const Json& json, const std::filesystem::path& folder, const std::string& where);

}  // namespace skinfit
