#pragma once

#include "transaction/EngineState.hpp"
#include <acs/plan/StoreLog.hpp>

namespace ACS::Planning
{

/// Sets ACS-1021 while the log of the store cannot be merged and is long, or could soon fill its file system. Once set, the
/// alarm stays until the log was merged. It has no data of its own: AlarmBook has.
class StoreLogWatch
{
    const EngineOptions& _options;
    EngineTransaction& _transaction;

public:
    explicit StoreLogWatch(EngineState& engine);

    void OnStoreLog(const StoreLog& log);
};

} // namespace ACS::Planning
