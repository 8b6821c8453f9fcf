#pragma once

#include "model/disk_cache.hpp"
#include "study/cube_ledger.hpp"
#include "study/study_reader.hpp"

namespace skinfit {

/// How this one of the study's cubes is fitted. Its input hash is that of its header, its region, and of the size and
/// the time of the last change of its data and mask: gigabytes are not read to see whether they are the same. What
/// cannot be read, is a spectral library or is in doubt by the remarks on its header becomes an entry with a problem
/// and without tiles.
[[nodiscard]] CubeEntry planned(StudyReader& reader, std::size_t cube);

/// The file of the map of a cube, in the study's folder of maps: its source, in which folders become underscores.
[[nodiscard]] std::string map_name(const std::string& source);

/// Writes the map of this one of the study's cubes, whose tiles are all done, into the study's folder of maps, with its
/// pictures, and notes that in the ledger; what keeps the pictures from being drawn is returned, and the ledger then
/// does not know the map yet. Throws InputError when the map cannot be written.
[[nodiscard]] std::optional<std::string> write_map(const Ledger& ledger, StudyReader& reader, std::size_t cube,
                                                   const DiskCache& cache);

}  // namespace skinfit
