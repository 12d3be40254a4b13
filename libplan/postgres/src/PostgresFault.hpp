#pragma once

#include <acs/core/Result.hpp>
#include <acs/plan/EPlanningError.hpp>

#include <string>
#include <string_view>

#include <libpq-fe.h>

namespace ACS::Planning
{

/// SQLSTATE that the functions of the schema raise if another process has taken the store.
inline constexpr std::string_view TAKEN_STATE = "ACS01";

/// Makes an error of a store: its name, what is expected with the remedy, and what was found.
[[nodiscard]] tl::unexpected<Core::Error> RefuseStore(
    EPlanningError error,
    const std::string& name,
    std::string expected,
    std::string found);

/// The error of a statement ("writing"), with the remedy for its SQLSTATE.
[[nodiscard]] Core::Error MakeStatementError(
    const PGresult& result,
    const std::string& name,
    std::string_view operation);

/// The error of a connection that could not be made, or was lost.
[[nodiscard]] Core::Error MakeConnectionError(
    const PGconn* connectionOrNull,
    const std::string& name,
    std::string_view operation);

/// The server did not answer in time.
[[nodiscard]] Core::Error MakeTimeoutError(const std::string& name, std::string_view operation, double seconds);

/// The statement has failed and the connection has not: nothing of its transaction is stored.
[[nodiscard]] bool IsOfStatement(const PGresult& result);

/// A transaction that fails so can succeed if it is repeated.
[[nodiscard]] bool IsWorthRepeating(const PGresult& result);

} // namespace ACS::Planning
