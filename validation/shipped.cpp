#include "validation/shipped.hpp"

#include <algorithm>
#include <span>
#include <string_view>

#include "core/embedded_file.hpp"
#include "fit/json_reading.hpp"
#include "measurements/text_reader.hpp"

namespace skinfit {

namespace figure_files {
std::span<const EmbeddedFile> embedded_files();
}  // namespace figure_files

std::vector<Figure> shipped_figures() {
    std::vector<Figure> figures;
    for (const EmbeddedFile& file : figure_files::embedded_files()) {
        if (file.name.ends_with(".json")) figures.push_back(parse_figure(file.text, std::string(file.name)));
    }
    std::ranges::sort(figures, {}, &Figure::number);
    return figures;
}

std::optional<Spectrum> measured_spectrum(const std::string& name, const std::filesystem::path& shared_folder) {
    constexpr std::string_view shared = "shared/";
    if (name.starts_with(shared)) {
        const std::filesystem::path path = shared_folder / name.substr(shared.size());
        if (shared_folder.empty() || !std::filesystem::exists(path)) return std::nullopt;
        return read_spectrum(path);
    }
    std::vector<std::string_view> known;
    for (const EmbeddedFile& file : figure_files::embedded_files()) {
        if (file.name == name) return parse_spectrum(file.text, name);
        if (file.name.ends_with(".csv")) known.push_back(file.name);
    }
    refuse_unknown("measured", name, known);
}

}  // namespace skinfit
