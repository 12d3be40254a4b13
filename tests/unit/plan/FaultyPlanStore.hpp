#pragma once

#include <acs/plan/EPlanningError.hpp>
#include <acs/plan/MemoryPlanStore.hpp>

namespace ACS::Testing
{

/// A store that fails when it is told to.
class FaultyPlanStore final : public Planning::IPlanStore
{
    Planning::MemoryPlanStore _store;

public:
    bool bFails = false;
    std::size_t attempts = 0;

    [[nodiscard]] Core::Result<Planning::StoredState> Load() override
    {
        return _store.Load();
    }

    [[nodiscard]] Core::Result<void> Append(const Planning::StoreBatch& batch) override
    {
        ++attempts;
        return bFails ? Core::Fail(Planning::EPlanningError::StoreFailed, "acsd.db", "room", "disk full")
                      : _store.Append(batch);
    }

    [[nodiscard]] Core::Result<void> Check() override
    {
        return bFails ? Core::Fail(Planning::EPlanningError::StoreFailed, "acsd.db", "the file", "nothing")
                      : Core::Result<void>();
    }

    [[nodiscard]] const Planning::StoredState& GetState() const
    {
        return _store.GetState();
    }
};

} // namespace ACS::Testing
