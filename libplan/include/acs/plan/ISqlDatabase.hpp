#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Result.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace ACS::Planning
{

/// Value of a parameter of a statement.
using SqlValue = std::variant<std::int64_t, std::string>;

/// Values of the columns of a row; numbers as decimal text.
using SqlRow = std::vector<std::string>;

/// What a plan store needs of an SQL database. The statements have parameters $1, $2, … in this order. Used by one thread; calls
/// block.
class ACS_API ISqlDatabase
{
public:
    ISqlDatabase() = default;
    ISqlDatabase(const ISqlDatabase&) = delete;
    ISqlDatabase& operator=(const ISqlDatabase&) = delete;
    virtual ~ISqlDatabase() = default;

    /// Executes a statement without result, within the transaction of the caller. An implementation may collect statements and
    /// execute them when the transaction is committed, and report an error then. Errors: as of IPlanStore::Append.
    [[nodiscard]] virtual Core::Result<void> Run(std::string_view text, const std::vector<SqlValue>& values) = 0;

    /// Returns all rows of a query without parameters. Errors: as of IPlanStore::Load.
    [[nodiscard]] virtual Core::Result<std::vector<SqlRow>> Query(std::string_view text) = 0;
};

} // namespace ACS::Planning
