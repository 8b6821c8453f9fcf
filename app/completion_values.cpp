#include "app/completion_values.hpp"

namespace skinfit {

OfferedValues offered_values(const OptionWords& option, const CompletedNames& names) {
    using Kind = OfferedValues::Kind;
    if (!option.choices.empty()) return {.kind = Kind::words, .words = option.choices};
    const std::string& argument = option.argument;
    if (argument == "KEY=VALUE") return {.kind = Kind::assignments, .words = names.settings};
    if (argument == "PARAMETER" || argument == "NAME,NAME") return {.kind = Kind::words, .words = names.parameters};
    if (argument == "FOLDER") return {.kind = Kind::folders, .words = {}};
    const bool is_file =
        argument.starts_with("FILE") || argument == "STUDY" || argument == "COHORT" || argument == "LEDGER";
    return {.kind = is_file ? Kind::files : Kind::nothing, .words = {}};
}

const std::string& main_name(const OptionWords& option) {
    return option.names.back();
}

}  // namespace skinfit
