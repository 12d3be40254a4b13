#pragma once

#include <acs/plan/EngineAction.hpp>
#include <acs/plan/IPlanStore.hpp>

#include <cassert>
#include <optional>
#include <utility>

namespace ACS::Planning
{

/// Withholds the actions that depend on a batch until the store has confirmed it. No effect is visible outside before its state
/// is stored, so after a crash the next start knows everything that was visible.
class CommitGate
{
public:
    struct Transaction
    {
        StoreBatch batch;
        EngineActions dependent;
    };

private:
    std::optional<Transaction> _transaction;

public:
    [[nodiscard]] bool IsClosed() const noexcept
    {
        return _transaction.has_value();
    }

    /// Only while open.
    void Close(StoreBatch batch, EngineActions dependent)
    {
        assert(!IsClosed());
        _transaction = Transaction{std::move(batch), std::move(dependent)};
    }

    /// Only while closed. Returns the transaction, whose outcome the caller knows.
    [[nodiscard]] Transaction Open()
    {
        assert(IsClosed());
        return *std::exchange(_transaction, std::nullopt);
    }
};

} // namespace ACS::Planning
