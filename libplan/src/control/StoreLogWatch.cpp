#include "control/StoreLogWatch.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <utility>

namespace ACS::Planning
{

namespace
{

constexpr std::uint64_t MEBIBYTE = 1024U * 1024U;

Alarm MakeLogAlarm(std::string message)
{
    return MakeAlarm(OWN_ROBOT_ID, ALARM_STORE_LOG, EAlarmLevel::Light, std::move(message));
}

} // namespace

StoreLogWatch::StoreLogWatch(EngineState& engine)
    : _options(engine.options),
      _transaction(engine.transaction)
{
}

void StoreLogWatch::OnStoreLog(const StoreLog& log)
{
    if (log.blockReason.empty())
    {
        _transaction.ClearAlarm(MakeLogAlarm({}));
    }
    else if (log.bytes > _options.maximumLogBytes || log.freeBytes < _options.maximumLogBytes)
    {
        _transaction.RaiseAlarm(MakeLogAlarm(fmt::format(
            "The log of the store {} has {} MiB and cannot be merged into the database, with {} MiB free on its file system: {}",
            log.path,
            log.bytes / MEBIBYTE,
            log.freeBytes / MEBIBYTE,
            log.blockReason)));
    }
}

} // namespace ACS::Planning
