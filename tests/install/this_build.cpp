#include "tests/install/this_build.hpp"

#include <sys/stat.h>

#include "core/file.hpp"

namespace skinfit::test {
namespace {

using Words = std::vector<std::string>;

const std::string build_folder = SKINFIT_BUILD_DIR;

}  // namespace

Outcome run_words(const Words& words, const std::filesystem::path& folder) {
    return StartedProgram(words, folder).wait();
}

Outcome install_build(const std::filesystem::path& prefix, const std::string& component) {
    Words words = {SKINFIT_CMAKE, "--install", build_folder, "--prefix", prefix.string()};
    if (!component.empty()) words.insert(words.end(), {"--component", component});
    return run_words(words, prefix.parent_path());
}

Outcome build_project(const std::filesystem::path& source, const std::filesystem::path& folder,
                      const std::filesystem::path& prefix) {
    const Words settings = {"-DCMAKE_BUILD_TYPE=" SKINFIT_BUILD_TYPE, "-DCMAKE_CXX_COMPILER=" SKINFIT_COMPILER,
                            "-DCMAKE_CXX_FLAGS=" SKINFIT_COMPILER_FLAGS, "-DCMAKE_PREFIX_PATH=" + prefix.string(),
                            "-DCMAKE_FIND_PACKAGE_NO_PACKAGE_REGISTRY=ON"};
    Words configure = {SKINFIT_CMAKE, "-S", source.string(), "-B", folder.string(), "-G", SKINFIT_GENERATOR};
    configure.insert(configure.end(), settings.begin(), settings.end());
    Outcome configured = run_words(configure, folder.parent_path());
    if (configured.exit_code != 0) return configured;
    return run_words({SKINFIT_CMAKE, "--build", folder.string(), "--parallel", "2"}, folder.parent_path());
}

Outcome pack_build(const std::filesystem::path& folder) {
    const mode_t mask = ::umask(077);  // which the package must not take over
    Outcome packed =
        run_words({SKINFIT_CPACK, "-G", "DEB", "--config", build_folder + "/CPackConfig.cmake", "-B", "."}, folder);
    ::umask(mask);
    return packed;
}

bool names_this_build(const std::filesystem::path& path) {
    const std::string content = read_file(path);
    return content.find(SKINFIT_SOURCE_DIR) != std::string::npos || content.find(build_folder) != std::string::npos;
}

}  // namespace skinfit::test
