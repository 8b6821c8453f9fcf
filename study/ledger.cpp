#include "study/ledger.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <SQLiteCpp/VariadicBind.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <chrono>
#include <ctime>

#include "core/input_error.hpp"
#include "core/version.hpp"
#include "study/ledger_schema.hpp"
#include "study/sqlite_errors.hpp"

namespace skinfit {
namespace {

void bind_optional(SQLite::Statement& statement, int place, const std::optional<double>& number) {
    if (number) {
        statement.bind(place, *number);
    } else {
        statement.bind(place);
    }
}

std::optional<double> optional_number(const SQLite::Column& column) {
    return column.isNull() ? std::nullopt : std::optional(column.getDouble());
}

std::string now() {
    const std::time_t time = std::time(nullptr);
    std::tm broken{};
    ::gmtime_r(&time, &broken);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &broken);
    return text.data();
}

/// What the ledger already holds of an entry.
struct Known {
    std::int64_t id;
    std::string input_hash;
    std::string configuration_hash;
    FitStatus status;
};

struct RosterStatements {
    SQLite::Statement find;
    SQLite::Statement keep;
    SQLite::Statement remove;
    SQLite::Statement add;

    explicit RosterStatements(const SQLite::Database& database)
        : find(database,
               "SELECT id, input_hash, configuration_hash, status FROM spectra WHERE source = ? AND number = ? AND "
               "name = ?"),
          keep(database, "UPDATE spectra SET present = 1, position = ?, metadata = ? WHERE id = ?"),
          remove(database, "DELETE FROM spectra WHERE id = ?"),
          add(database,
              "INSERT INTO spectra (source, number, name, position, metadata, input_hash, configuration_hash, status, "
              "reason) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)") {}
};

template <class... Values>
int run(SQLite::Statement& statement, const Values&... values) {
    statement.reset();
    SQLite::bind(statement, values...);
    return statement.exec();
}

std::optional<Known> known(SQLite::Statement& find, const RosterEntry& entry) {
    find.reset();
    SQLite::bind(find, entry.source, static_cast<std::int64_t>(entry.number), entry.name);
    if (!find.executeStep()) return std::nullopt;
    return Known{.id = find.getColumn(0).getInt64(),
                 .input_hash = find.getColumn(1).getString(),
                 .configuration_hash = find.getColumn(2).getString(),
                 .status = fit_status_named(find.getColumn(3).getString())};
}

/// What the entry changed.
std::size_t RosterChange::*take_entry(RosterStatements& statements, const RosterEntry& entry, std::size_t position,
                                      const std::string& configuration_hash) {
    const auto place = static_cast<std::int64_t>(position);
    const std::string metadata = metadata_json(entry.metadata).dump();
    std::size_t RosterChange::*change = &RosterChange::added;
    if (const std::optional<Known> old = known(statements.find, entry)) {
        const bool same_input = old->input_hash == entry.input_hash;
        if (same_input && old->configuration_hash == configuration_hash) {
            run(statements.keep, place, metadata, old->id);
            return old->status == FitStatus::pending ? &RosterChange::added : &RosterChange::kept;
        }
        if (old->status != FitStatus::pending) {
            change = same_input ? &RosterChange::changed_settings : &RosterChange::changed_input;
        }
        run(statements.remove, old->id);
    }
    run(statements.add, entry.source, static_cast<std::int64_t>(entry.number), entry.name, place, metadata,
        entry.input_hash, configuration_hash,
        std::string(name_of(entry.refusal ? entry.refusal->status : FitStatus::pending)),
        entry.refusal ? entry.refusal->reason : std::string());
    return change;
}

LedgerRow row_in(const SQLite::Statement& query) {
    const auto text = [&](int column) { return query.getColumn(column).getString(); };
    const auto list = [&](int column) { return Json::parse(text(column)); };
    return {
        .key = {.source = text(0), .number = static_cast<std::size_t>(query.getColumn(1).getInt64()), .name = text(2)},
        .metadata = metadata_from(list(3)),
        .input_hash = text(4),
        .configuration_hash = text(5),
        .studied = {.status = fit_status_named(text(6)),
                    .verdict = text(7),
                    .reason = text(8),
                    .parameters = parameters_from_json(list(9)),
                    .correlation = list(10).get<std::vector<double>>(),
                    .tissue = tissue_from_json(list(11)),
                    .indices = indices_from_json(list(12)),
                    .rmse = optional_number(query.getColumn(13)),
                    .chi2 = optional_number(query.getColumn(14)),
                    .degrees_of_freedom = optional_number(query.getColumn(15)),
                    .p_value = optional_number(query.getColumn(16)),
                    .seconds = query.getColumn(17).getDouble()}};
}

}  // namespace

Ledger::Ledger(const std::filesystem::path& path, Access access)
    : path_(path), database_(access == Access::write ? open_ledger_to_write(path) : open_ledger_to_read(path)) {}

Ledger::Ledger(Ledger&&) noexcept = default;
Ledger& Ledger::operator=(Ledger&&) noexcept = default;
Ledger::~Ledger() = default;

RosterChange Ledger::take(const std::vector<RosterEntry>& roster, const std::string& configuration_hash) {
    return translated(path_, [&] {
        SQLite::Transaction transaction(*database_);
        RosterChange change;
        database_->exec("UPDATE spectra SET present = 2 WHERE present");  // until the roster names them
        RosterStatements statements(*database_);
        for (std::size_t position = 0; position < roster.size(); ++position) {
            ++(change.*understood(path_, [&] {
                   return take_entry(statements, roster[position], position, configuration_hash);
               }));
        }
        change.gone = static_cast<std::size_t>(database_->exec("UPDATE spectra SET present = 0 WHERE present = 2"));
        transaction.commit();
        return change;
    });
}

void Ledger::store(std::span<const Answer> answers) {
    translated(path_, [&] {
        SQLite::Transaction transaction(*database_);
        SQLite::Statement update(
            *database_,
            "UPDATE spectra SET status = ?, verdict = ?, reason = ?, parameters = ?, correlation "
            "= ?, tissue = ?, indices = ?, rmse = ?, chi2 = ?, degrees_of_freedom = ?, p_value = ?, seconds = "
            "?, finished_at = ? WHERE source = ? AND number = ? AND name = ?");
        const std::string time = now();
        for (const auto& [key, studied] : answers) {
            update.reset();
            update.bind(1, std::string(name_of(studied.status)));
            update.bind(2, studied.verdict);
            update.bind(3, studied.reason);
            update.bind(4, parameters_json(studied.parameters).dump());
            update.bind(5, Json(studied.correlation).dump());
            update.bind(6, tissue_json(studied.tissue).dump());
            update.bind(7, indices_json(studied.indices).dump());
            bind_optional(update, 8, studied.rmse);
            bind_optional(update, 9, studied.chi2);
            bind_optional(update, 10, studied.degrees_of_freedom);
            bind_optional(update, 11, studied.p_value);
            update.bind(12, studied.seconds);
            update.bind(13, time);
            update.bind(14, key.source);
            update.bind(15, static_cast<std::int64_t>(key.number));
            update.bind(16, key.name);
            if (update.exec() != 1) throw std::logic_error("the ledger does not hold " + key.source + " " + key.name);
        }
        transaction.commit();
    });
}

std::vector<LedgerKey> Ledger::pending(const std::string& source) const {
    return translated(path_, [&] {
        SQLite::Statement query(*database_,
                                "SELECT number, name FROM spectra WHERE present AND status = 'pending' AND source = ? "
                                "ORDER BY position");
        query.bind(1, source);
        std::vector<LedgerKey> keys;
        while (query.executeStep()) {
            keys.push_back({.source = source,
                            .number = static_cast<std::size_t>(query.getColumn(0).getInt64()),
                            .name = query.getColumn(1).getString()});
        }
        return keys;
    });
}

StatusCounts Ledger::counts() const {
    return translated(path_, [&] {
        StatusCounts counts{};
        SQLite::Statement query(*database_, "SELECT status, count(*) FROM spectra WHERE present GROUP BY status");
        while (query.executeStep()) {
            const FitStatus status =
                understood(path_, [&] { return fit_status_named(query.getColumn(0).getString()); });
            counts[static_cast<std::size_t>(status)] = static_cast<std::uint64_t>(query.getColumn(1).getInt64());
        }
        return counts;
    });
}

void Ledger::for_each(const std::function<void(const LedgerRow&)>& use) const {
    translated(path_, [&] {
        SQLite::Statement query(*database_,
                                "SELECT source, number, name, metadata, input_hash, configuration_hash, status, "
                                "verdict, reason, parameters, correlation, tissue, indices, rmse, chi2, "
                                "degrees_of_freedom, p_value, seconds FROM spectra WHERE present ORDER BY position");
        while (query.executeStep()) use(understood(path_, [&] { return row_in(query); }));
    });
}

std::vector<LedgerRow> Ledger::rows() const {
    std::vector<LedgerRow> all;
    for_each([&](const LedgerRow& row) { all.push_back(row); });
    return all;
}

std::string Ledger::note(const std::string& name) const {
    return translated(path_, [&] {
        SQLite::Statement query(*database_, "SELECT text FROM notes WHERE name = ?");
        query.bind(1, name);
        return query.executeStep() ? query.getColumn(0).getString() : std::string();
    });
}

void Ledger::set_note(const std::string& name, const std::string& text) {
    translated(path_, [&] {
        SQLite::Statement insert(*database_, "INSERT OR REPLACE INTO notes (name, text) VALUES (?, ?)");
        insert.bind(1, name);
        insert.bind(2, text);
        insert.exec();
    });
}

}  // namespace skinfit
