#include "app/shared_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>

#include "app/option_limits.hpp"
#include "app/terminal.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "fit/configuration_json.hpp"
#include "fit/settings.hpp"
#include "measurements/spectrum_file.hpp"

namespace skinfit {

namespace {

/// Throws InputError where writing to `out` would replace `input`.
void refuse_replacing(const std::string& option, const std::filesystem::path& out, const std::filesystem::path& input) {
    std::error_code error;
    if (input.empty() || !std::filesystem::is_regular_file(input, error)) return;
    if (!std::filesystem::equivalent(out, input, error) || error) return;
    throw InputError({.where = fmt::format("{} {}", option, out.string()),
                      .problem = "is a file that is read",
                      .why = "the output would replace it",
                      .remedy = "name another file"});
}

}  // namespace

void add_shared_options(CLI::App& command, SharedOptions& options, const std::vector<std::string_view>& formats) {
    add_configuration_options(command, options, "melanosome_fraction=0.1");
    add_format_option(command, options.format, formats);
    add_out_option(command, options.out);
    add_threads_option(command, options.threads);
    add_no_cache_option(command, options.no_cache);
}

void add_configuration_options(CLI::App& command, SharedOptions& options, const std::string& example) {
    command.add_option("--config", options.config, "JSON file of settings; see `skinfit config show`")
        ->type_name("FILE");
    repeated(command.add_option("--set", options.set, "change one setting or parameter, as in " + example))
        ->type_name("KEY=VALUE");
}

void add_names_option(CLI::App& command, const std::string& option, std::vector<std::string>& names,
                      const std::string& meaning) {
    repeated(command.add_option(option, names, meaning))->type_name("NAME,NAME");
}

CLI::Option* add_format_option(CLI::App& command, std::string& format, const std::vector<std::string_view>& formats,
                               const std::string& meaning) {
    format = formats.front();
    return one_of(command.add_option("--format", format, meaning), formats)->capture_default_str();
}

void add_out_option(CLI::App& command, std::filesystem::path& out) {
    command.add_option("--out", out, "write to this file instead of to the terminal")->type_name("FILE");
}

void add_threads_option(CLI::App& command, int& threads) {
    whole_number(command.add_option("--threads", threads,
                                    "use at most so many, else all of the machine; the result does not depend on it"),
                 1, 1024);
}

void add_no_cache_option(CLI::App& command, bool& no_cache) {
    command.add_flag("--no-cache", no_cache, "neither use recorded walks and emulators of earlier runs nor keep any");
}

CLI::Option* add_quiet_option(CLI::App& command, Session& session) {
    return command.add_flag("--quiet", session.quiet, "no progress, notes or warnings on the terminal: only errors");
}

std::string unless_configured(const std::string& setting) {
    const auto found = std::ranges::find(setting_table(), setting, &Setting::name);
    if (found == setting_table().end()) throw std::logic_error(setting + " is not a setting");
    const Json value = found->write(default_configuration());
    return fmt::format("; {} if not configured", value.is_string() ? value.get<std::string>() : value.dump());
}

void add_wavelengths_option(CLI::App& command, std::string& wavelengths, const std::string& without_it) {
    command
        .add_option("--wavelengths", wavelengths,
                    "in nm: first:last:step as in 400:700:20, or a list as in 450,540,660" + without_it)
        ->type_name("LIST");
}

void add_reader_option(CLI::App& command, std::string& reader) {
    command
        .add_option("--reader", reader,
                    "read FILE in this form, whatever it looks like; recognised by its content if not given")
        ->type_name(choices(reader_names()));
}

Configuration configuration_from(const SharedOptions& options, const Configuration& defaults) {
    const auto is_preset = [](const std::string& assignment) {
        return trimmed(assignment.substr(0, assignment.find('='))) == "preset";
    };
    Configuration configuration = defaults;
    for (const std::string& assignment : options.set) {  // all else stands on it
        if (is_preset(assignment)) configuration = configured_by_assignment(configuration, assignment);
    }
    const Preset stated = configuration.preset;
    if (!options.config.empty()) {
        configuration = configured_by_text(configuration, read_input(options.config), options.config);
    }
    if (configuration.preset != stated && std::ranges::any_of(options.set, is_preset)) {
        throw InputError({.where = options.config,
                          .problem = "states another preset than --set does",
                          .why = "its other settings are meant for its own",
                          .remedy = "leave one of the two out"});
    }
    for (const std::string& assignment : options.set) {
        if (!is_preset(assignment)) configuration = configured_by_assignment(configuration, assignment);
    }
    return configuration;
}

Configuration with_free_and_fixed(const Configuration& configuration, const std::vector<std::string>& free,
                                  const std::vector<std::string>& fix, const std::vector<std::string>& own) {
    Configuration nothing = configuration;
    nothing.free.fill(false);
    const auto with_freed = [&](Configuration changed) {
        for (const std::string& names : free) changed = with_freedom(changed, names, true, "--free");
        for (const std::string& names : own) changed = with_own(changed, names, "--own");
        return changed;
    };
    const Configuration named = with_freed(nothing);
    Configuration changed = with_freed(configuration);
    for (const std::string& names : fix) {
        changed = with_freedom(changed, names, false, "--fix");
        if (with_freedom(named, names, false, "--fix").free == named.free) continue;
        throw InputError({.where = fmt::format("--fix {}", names),
                          .problem = fmt::format("names a parameter of {}", own.empty() ? "--free" : "--free or --own"),
                          .why = "it cannot be adjusted and held at once",
                          .remedy = "leave it out of one of the two"});
    }
    return changed;
}

void add_examples(CLI::App& command, const std::vector<std::string>& examples, const std::string& remark) {
    command.footer(fmt::format("Examples:\n  {}\n\n{}", fmt::join(examples, "\n  "), remark));
}

DiskCache cache_from(const SharedOptions& options, ProgressLine& line) {
    DiskCache cache{.folder = options.no_cache ? std::nullopt : default_cache_folder(),
                    .warn = [&line](const std::string& text) { line.warn(text); },
                    .inform = [&line](const std::string& text) { line.show({.what = text}); }};
    if (cache.folder) tidy(cache);
    return cache;
}

void make_output_folder(const std::filesystem::path& folder) {
    make_folder(folder, fmt::format("--output {}", folder.string()));
}

std::unique_ptr<tbb::global_control> thread_limit(const SharedOptions& options) {
    if (options.threads == 0) return nullptr;
    return std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                 static_cast<std::size_t>(options.threads));
}

std::string shell_words(const std::vector<std::string>& arguments) {
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+.,:/@%";
    std::string line;
    for (const std::string& argument : arguments) {
        if (!line.empty()) line += ' ';
        if (!argument.empty() && argument.find_first_not_of(plain) == std::string::npos) {
            line += argument;
            continue;
        }
        line += '\'';
        for (const char c : argument) c == '\'' ? line += "'\\''" : line += c;
        line += '\'';
    }
    return line;
}

std::string json_text(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_stdout(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return;
    throw InputError({.where = "standard output",
                      .problem = "cannot be written",
                      .why = std::strerror(errno),
                      .remedy = "check where it leads, or name a file with --out"});
}

void write_report_to_stdout(const std::string& text) {
    write_stdout(shows_colour(STDOUT_FILENO) ? coloured(text) : text);
}

void write_output(const SharedOptions& options, const std::string& text) {
    if (options.out.empty()) {
        write_report_to_stdout(text);
        return;
    }
    try {
        write_file_atomically(options.out, text);
    } catch (const InputError&) {
        try {
            write_report_to_stdout(text);
        } catch (const InputError&) {  // what is wrong with --out is said
        }
        throw;
    }
}

void refuse_same_output(const std::pair<std::string, std::filesystem::path>& first,
                        const std::pair<std::string, std::filesystem::path>& second) {
    std::error_code error;
    if (first.second.empty() || second.second.empty()) return;
    const auto place = [&](const std::filesystem::path& path) {
        return std::filesystem::weakly_canonical(std::filesystem::absolute(path, error), error);
    };
    if (place(first.second) != place(second.second)) return;
    throw InputError({.where = fmt::format("{} {}", second.first, second.second.string()),
                      .problem = fmt::format("is the file of {} too", first.first),
                      .why = "the one would replace the other",
                      .remedy = "name another file"});
}

void check_output(const SharedOptions& options, const std::vector<std::filesystem::path>& inputs,
                  const std::string& option) {
    if (options.out.empty()) return;
    if (options.out == "-") {
        throw InputError({.where = option + " -",
                          .problem = "is no file",
                          .why = "standard output is what is written to without the option",
                          .remedy = "leave it out, or name a file"});
    }
    std::error_code error;
    for (const std::filesystem::path& input : inputs) refuse_replacing(option, options.out, input);
    refuse_replacing(option, options.out, options.config);
    if (std::filesystem::is_directory(options.out, error)) {
        throw InputError({.where = options.out.string(),
                          .problem = "cannot be written",
                          .why = "it is a folder",
                          .remedy = "name a file in it"});
    }
    check_writable(options.out);
}

}  // namespace skinfit
