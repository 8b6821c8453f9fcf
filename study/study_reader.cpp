#include "study/study_reader.hpp"

namespace skinfit {
namespace {

constexpr std::size_t most_numbers = (std::size_t{256} << 20U) / sizeof(double);
constexpr std::size_t most_last = 4;  // the tasks of a file follow each other

std::size_t numbers_in(const StudySpectra& read) {
    std::size_t numbers = 0;
    for (const Spectrum& spectrum : read.spectra) {
        numbers += spectrum.wavelength_nm.size() + spectrum.value.size() + spectrum.sigma.size();
        for (const std::vector<double>& repeat : spectrum.repeats) numbers += repeat.size();
    }
    return numbers;
}

}  // namespace

std::shared_ptr<const StudySpectra> StudyReader::spectra_of(std::size_t file) {
    const std::lock_guard lock(mutex_);
    if (const auto found = kept_.find(file); found != kept_.end()) return found->second;
    if (const auto found = last_.find(file); found != last_.end()) return found->second;
    const auto read = std::make_shared<const StudySpectra>(read_study_file(study_.files[file], window_));
    const std::size_t numbers = numbers_in(*read);
    if (numbers_ + numbers <= most_numbers) {
        numbers_ += numbers;
        return kept_[file] = read;
    }
    if (last_.size() >= most_last) last_.erase(last_.begin());
    return last_[file] = read;
}

EnviFiles StudyReader::files_of_cube(std::size_t cube) {
    const std::lock_guard lock(mutex_);
    if (const auto found = cubes_.find(cube); found != cubes_.end()) return found->second;
    return cubes_[cube] = find_envi_files(study_.cubes[cube].path);
}

}  // namespace skinfit
