#include "PostgresFault.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace ACS::Planning
{

namespace
{

struct Remedy
{
    std::string_view state; ///< SQLSTATE, or its first two characters: the class.
    EPlanningError error;
    std::string_view expected;
};

/// The first that fits.
constexpr std::array REMEDIES{
    Remedy{TAKEN_STATE, EPlanningError::StoreTaken, "the lease of the store; this process is a standby from now on"},
    Remedy{
        "42501",
        EPlanningError::StoreFailed,
        "a role that may create the schema acsd in this database (GRANT CREATE ON DATABASE … TO …), or that owns the schema and its "
        "tables"},
    Remedy{
        "25006",
        EPlanningError::StoreFailed,
        "a server that accepts writes; name the primary in the URL, or all servers"},
    Remedy{
        "28",
        EPlanningError::StoreFailed,
        "the right user and password, and a line for them in pg_hba.conf of the server"},
    Remedy{
        "3D000",
        EPlanningError::StoreFailed,
        "a database of this name; create it with createdb, or correct the URL"},
    Remedy{"53100", EPlanningError::StoreFailed, "free space on the disk of the database server"},
    Remedy{
        "53300",
        EPlanningError::StoreFailed,
        "a free connection; close others, or raise max_connections of the server"},
    Remedy{"57014", EPlanningError::StoreFailed, "an answer in time; find out what slows the database server down"},
    Remedy{"55P03", EPlanningError::StoreFailed, "tables that no other program locks; end what locks them (pg_locks)"},
    Remedy{"57", EPlanningError::StoreFailed, "a server that runs; nothing to do if it is being restarted"},
    Remedy{"XX", EPlanningError::StoreCorrupt, "an undamaged database; restore a backup"},
    Remedy{
        "42",
        EPlanningError::StoreCorrupt,
        "the tables of a plan store; restore a backup, or give an empty database"}};

constexpr std::string_view OTHER_REMEDY = "a database that can be read and written; see the log of its server";

std::string_view GetState(const PGresult& result)
{
    const char* const state = PQresultErrorField(&result, PG_DIAG_SQLSTATE);
    return state == nullptr ? std::string_view() : std::string_view(state);
}

/// The first line: further ones are for the developers of PostgreSQL.
std::string MakeOneLine(std::string text)
{
    text.erase(std::find(text.begin(), text.end(), '\n'), text.end());
    return text;
}

const Remedy* FindRemedyOrNull(std::string_view state)
{
    const auto* const found =
        std::ranges::find_if(REMEDIES, [state](const Remedy& entry) { return state.starts_with(entry.state); });
    return found == REMEDIES.end() ? nullptr : &*found;
}

/// In "FATAL:  28P01: password authentication failed"; empty: the server has not answered.
std::string_view FindState(std::string_view text)
{
    constexpr std::size_t LENGTH = 5;
    constexpr std::string_view BEFORE = ":  ";
    const std::size_t before = text.find(BEFORE);
    if (before == std::string_view::npos)
    {
        return {};
    }
    const std::string_view rest = text.substr(before + BEFORE.size());
    return rest.size() > LENGTH && rest[LENGTH] == ':' ? rest.substr(0, LENGTH) : std::string_view();
}

/// The refusal of a server has an SQLSTATE, the text of libpq is English.
std::string_view FindConnectionRemedy(std::string_view text)
{
    if (const Remedy* const remedyOrNull = FindRemedyOrNull(FindState(text)); remedyOrNull != nullptr)
    {
        return remedyOrNull->expected;
    }
    constexpr std::array<std::pair<std::string_view, std::string_view>, 3> TEXTS{{
        {"no password supplied", "the password of the user; give the file that has it"},
        {"read-only", "a server that accepts writes; name the primary in the URL, or all servers"},
        {"certificate", "a certificate that can be verified; give its issuer as sslrootcert in the URL"},
    }};
    const auto* const found = std::ranges::find_if(TEXTS, [text](const auto& entry) {
        return text.find(entry.first) != std::string_view::npos;
    });
    return found == TEXTS.end() ? "a database server that can be reached; check the URL, the network and the server"
                                : found->second;
}

} // namespace

tl::unexpected<Core::Error> RefuseStore(
    EPlanningError error,
    const std::string& name,
    std::string expected,
    std::string found)
{
    return Core::Fail(make_error_code(error), name, std::move(expected), std::move(found));
}

Core::Error MakeStatementError(const PGresult& result, const std::string& name, std::string_view operation)
{
    const std::string_view state = GetState(result);
    const char* const message = PQresultErrorField(&result, PG_DIAG_MESSAGE_PRIMARY);
    std::string found = fmt::format("{} failed: {} ({})", operation, message == nullptr ? "no reason" : message, state);
    const auto* const remedy =
        std::ranges::find_if(REMEDIES, [state](const Remedy& entry) { return state.starts_with(entry.state); });
    const EPlanningError error = remedy == REMEDIES.end() ? EPlanningError::StoreFailed : remedy->error;
    return {
        make_error_code(error),
        name,
        std::string(remedy == REMEDIES.end() ? OTHER_REMEDY : remedy->expected),
        MakeOneLine(std::move(found))};
}

Core::Error MakeConnectionError(const PGconn* connectionOrNull, const std::string& name, std::string_view operation)
{
    std::string text =
        MakeOneLine(connectionOrNull == nullptr ? "the connection was lost before" : PQerrorMessage(connectionOrNull));
    return {
        make_error_code(EPlanningError::StoreFailed),
        name,
        std::string(FindConnectionRemedy(text)),
        fmt::format("{} failed: {}", operation, text.empty() ? "the connection was closed" : text)};
}

Core::Error MakeTimeoutError(const std::string& name, std::string_view operation, double seconds)
{
    return {
        make_error_code(EPlanningError::StoreFailed),
        name,
        "an answer in time; check the network and what slows the database server down",
        fmt::format("{} failed: no answer for {:.1f} s", operation, seconds)};
}

bool IsOfStatement(const PGresult& result)
{
    const char* const severity = PQresultErrorField(&result, PG_DIAG_SEVERITY_NONLOCALIZED);
    return severity != nullptr && std::string_view(severity) == "ERROR";
}

bool IsWorthRepeating(const PGresult& result)
{
    constexpr std::string_view SERIALIZATION_FAILURE = "40001";
    constexpr std::string_view DEADLOCK_DETECTED = "40P01";
    return GetState(result) == SERIALIZATION_FAILURE || GetState(result) == DEADLOCK_DETECTED;
}

} // namespace ACS::Planning
