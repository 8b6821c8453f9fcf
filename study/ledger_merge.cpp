#include "study/ledger_merge.hpp"

#include <SQLiteCpp/SQLiteCpp.h>

#include "study/sqlite_errors.hpp"

namespace skinfit {
namespace {

constexpr const char* take_spectra = R"sql(
UPDATE spectra SET status = p.status, verdict = p.verdict, reason = p.reason, parameters = p.parameters,
    correlation = p.correlation, tissue = p.tissue, indices = p.indices, rmse = p.rmse, chi2 = p.chi2,
    degrees_of_freedom = p.degrees_of_freedom, p_value = p.p_value, seconds = p.seconds, finished_at = p.finished_at
FROM part.spectra AS p
WHERE spectra.present AND spectra.status = 'pending' AND p.status <> 'pending' AND p.source = spectra.source AND
    p.number = spectra.number AND p.name = spectra.name AND p.input_hash = spectra.input_hash AND
    p.configuration_hash = spectra.configuration_hash
)sql";

constexpr const char* take_tiles = R"sql(
UPDATE tiles SET counts = p.counts, bytes = p.bytes, seconds = p.seconds
FROM part.tiles AS p, part.cubes AS q, cubes AS c
WHERE tiles.counts IS NULL AND p.bytes IS NOT NULL AND p.source = tiles.source AND
    p.first_line = tiles.first_line AND p.lines = tiles.lines AND q.source = p.source AND c.source = tiles.source AND
    q.input_hash = c.input_hash AND q.configuration_hash = c.configuration_hash
)sql";

/// Another ledger within reach of a database, as long as it lives.
class Attached {
public:
    Attached(SQLite::Database& database, const std::filesystem::path& part) : database_(&database) {
        translated(part, [&] {
            SQLite::Statement attach(database, "ATTACH DATABASE ? AS part");
            attach.bind(1, part.string());
            attach.exec();
        });
    }
    Attached(const Attached&) = delete;
    Attached& operator=(const Attached&) = delete;
    ~Attached() { (void)database_->tryExec("DETACH DATABASE part"); }

private:
    SQLite::Database* database_;
};

}  // namespace

TakenAnswers take_answers(const Ledger& ledger, const std::filesystem::path& part) {
    (void)Ledger(part, Ledger::Access::read);  // says what is wrong with it
    SQLite::Database& database = ledger.database();
    const Attached attached(database, part);
    translated(part, [&] {
        const std::string answer = database.execAndGet("PRAGMA part.quick_check(1)").getString();
        if (answer != "ok") refuse_damaged(part, answer);
    });
    return translated(ledger.path(), [&] {
        SQLite::Transaction transaction(database);
        const TakenAnswers taken{.spectra = static_cast<std::size_t>(database.exec(take_spectra)),
                                 .tiles = static_cast<std::size_t>(database.exec(take_tiles))};
        transaction.commit();
        return taken;
    });
}

}  // namespace skinfit
