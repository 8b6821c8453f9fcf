#pragma once

#include <tbb/global_control.h>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/progress_line.hpp"
#include "app/session.hpp"
#include "fit/configuration.hpp"
#include "fit/settings.hpp"
#include "model/disk_cache.hpp"

namespace skinfit {

/// Options that commands have in common.
struct SharedOptions {
    std::string config;            ///< JSON file
    std::vector<std::string> set;  ///< key=value
    std::string format;            ///< of the output
    std::filesystem::path out;     ///< empty: stdout
    int threads = 0;               ///< 0: as many as the machine has
    bool no_cache = false;
};

/// Adds them to `command`; `formats` are the choices of --format, the first the default.
void add_shared_options(CLI::App& command, SharedOptions& options, const std::vector<std::string_view>& formats);

/// Adds --config and --set, which is explained by `example`.
void add_configuration_options(CLI::App& command, SharedOptions& options, const std::string& example);

/// Adds an option that takes names of parameters, several at once or several times.
void add_names_option(CLI::App& command, const std::string& option, std::vector<std::string>& names,
                      const std::string& meaning);

/// Adds --format with its choices, of which the first is the default.
CLI::Option* add_format_option(CLI::App& command, std::string& format, const std::vector<std::string_view>& formats,
                               const std::string& meaning = "form of the output");

/// Adds --out, a file in place of the terminal.
void add_out_option(CLI::App& command, std::filesystem::path& out);

/// Adds --threads.
void add_threads_option(CLI::App& command, int& threads);

/// Adds --no-cache.
void add_no_cache_option(CLI::App& command, bool& no_cache);

/// Adds --quiet.
CLI::Option* add_quiet_option(CLI::App& command, Session& session);

/// The end of the help of an option that is a setting too: "; 100000 if not configured".
[[nodiscard]] std::string unless_configured(const std::string& setting);

/// Adds --wavelengths; `without_it` ends the help.
void add_wavelengths_option(CLI::App& command, std::string& wavelengths,
                            const std::string& without_it = unless_configured("wavelengths"));

/// Adds --reader, which overrides the recognition of a file's form.
void add_reader_option(CLI::App& command, std::string& reader);

/// `defaults`, changed by --config, which is read once and may be a pipe, and then by each --set. Throws InputError.
[[nodiscard]] Configuration configuration_from(const SharedOptions& options,
                                               const Configuration& defaults = default_configuration());

/// `configuration` with the parameters of --free and --own adjusted, those of --own in each of several spectra, and
/// those of --fix held. Throws InputError for one named in --fix and another.
[[nodiscard]] Configuration with_free_and_fixed(const Configuration& configuration,
                                                const std::vector<std::string>& free,
                                                const std::vector<std::string>& fix,
                                                const std::vector<std::string>& own = {});

/// The exit codes of a command that has no doubtful results.
inline constexpr const char* exit_codes = "Exit code 0: done; 2: bad input; 3: internal error.";

/// Ends the help of `command` with these command lines, and `remark`, which says the exit codes.
void add_examples(CLI::App& command, const std::vector<std::string>& examples, const std::string& remark = exit_codes);

/// The cache for recorded walks as the options ask for, tidied; its messages go to `line`.
[[nodiscard]] DiskCache cache_from(const SharedOptions& options, ProgressLine& line);

/// Makes the folder of --output where there is none. Throws InputError where that is no folder that can be written.
void make_output_folder(const std::filesystem::path& folder);

/// Limits the number of threads for as long as it lives.
[[nodiscard]] std::unique_ptr<tbb::global_control> thread_limit(const SharedOptions& options);

/// `arguments` as they are typed into a shell: those with other characters than plain names have are quoted.
[[nodiscard]] std::string shell_words(const std::vector<std::string>& arguments);

/// `json` as indented text with a line end; bytes that are not UTF-8 are replaced.
[[nodiscard]] std::string json_text(const Json& json);

/// Writes `text` to stdout. Throws InputError where that cannot be done.
void write_stdout(const std::string& text);

/// The same for a report, in colours where they are shown.
void write_report_to_stdout(const std::string& text);

/// Writes `text` to --out, or to stdout, in colours where they are shown. Throws InputError where that cannot be done;
/// then nothing is half-written, and what was for --out is on stdout.
void write_output(const SharedOptions& options, const std::string& text);

/// Throws InputError when --out cannot be written, or is one of the files that are read (`inputs` and --config): before
/// the work rather than after it. Messages name `option`.
void check_output(const SharedOptions& options, const std::vector<std::filesystem::path>& inputs = {},
                  const std::string& option = "--out");

/// Throws InputError where two options name the same file to write.
void refuse_same_output(const std::pair<std::string, std::filesystem::path>& first,
                        const std::pair<std::string, std::filesystem::path>& second);

}  // namespace skinfit
